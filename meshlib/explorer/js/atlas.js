// Reads an atlas (see atlas.py): its scenes, and the elements of each frame.

const KINDS = { f8: Float64Array, f4: Float32Array, u1: Uint8Array, u2: Uint16Array, u4: Uint32Array };
const HEAD = 4;                                      // bytes of the length of the header
const GRID = 101;                                    // points along each side, as in scene.py

function decode(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const atlas = { header: JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, HEAD, length))) };
  for (const [name, [kind, offset, size]] of Object.entries(atlas.header.arrays)) {
    atlas[name] = new KINDS[kind](buffer, HEAD + length + offset, size);
  }
  return atlas;
}

// A row of a table of rows that are joined into one array.
const row = (joined, starts, k) => joined.subarray(starts[k], starts[k + 1]);

function sceneAt(atlas, k) {
  const size = GRID * GRID, number = atlas.truth[k], film = row(atlas.film, atlas.films, k);
  const [first, end] = [atlas.traces[k], atlas.traces[k + 1]];
  return { ...atlas.header.scenes[k], atlas, film, first, start: atlas.start[k], swaps: atlas.swaps[k],
           truth: atlas.grids.subarray(number * size, (number + 1) * size),
           frames: 1 + (end - first || film.length), traced: end > first };
}

// The frame of a scene: three nodes for each element, what was tried, and swaps so far.
function frameAt(scene, frame) {
  const { atlas } = scene;
  if (!frame) return { elements: elementsOf(atlas, scene.start), swaps: 0 };
  if (!scene.traced) return { elements: elementsOf(atlas, scene.film[frame - 1]), swaps: scene.swaps };
  const elements = elementsOf(atlas, scene.start), end = scene.first + frame;
  let swaps = 0;
  for (let k = scene.first; k < end; k++) {
    if (atlas.accepted[k]) swaps += swap(elements, triedAt(atlas, k), atlas);
  }
  return { elements, swaps, tried: triedAt(atlas, end - 1) };
}

function elementsOf(atlas, mesh) {
  const steps = row(atlas.members, atlas.meshes, mesh), elements = new Uint32Array(3 * steps.length);
  let number = 0;
  steps.forEach((step, t) => {
    number += step % 2 ? -(step + 1) / 2 : step / 2;
    elements.set(atlas.elements.subarray(3 * number, 3 * number + 3), 3 * t);
  });
  return elements;
}

// Swap number k: the edge a-b, or in its place c-d.
function triedAt({ a, b, c, d, accepted }, k) {
  return { a: a[k], b: b[k], c: c[k], d: d[k], accepted: Boolean(accepted[k]) };
}

// The two elements at a-b become those at c-d; returns 1, the number of swaps.
function swap(elements, { a, b, c, d }, { x, y }) {
  const corners = [a, b];
  for (let t = 0; t < elements.length; t += 3) {
    const nodes = elements.subarray(t, t + 3);
    if (nodes.includes(a) && nodes.includes(b)) nodes.set(ordered([c, d, corners.pop()], x, y));
    if (!corners.length) break;
  }
  return 1;
}

function ordered([p, q, r], x, y) {
  const turn = (x[q] - x[p]) * (y[r] - y[p]) - (x[r] - x[p]) * (y[q] - y[p]);
  return turn > 0 ? [p, q, r] : [p, r, q];
}
