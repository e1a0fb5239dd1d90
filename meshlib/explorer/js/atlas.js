// Reads an atlas (see atlas.py): its scenes, and the elements of each frame.

/** @import { Atlas, Costs, Frame, GivenCosts, Numbers, Pair, Points, Scene, Try } from "./types" */

const KINDS = { f8: Float64Array, f4: Float32Array, u1: Uint8Array, u2: Uint16Array, u4: Uint32Array };
const HEAD = 4;                                      // bytes in front, with the length of the header
export const GRID = 101;                             // points along each side, as in scene.py

/** The atlas in a buffer.
 * @type {(buffer: ArrayBuffer) => Atlas} */
export function decode(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, HEAD, length)));
  /** @type {[string, [keyof typeof KINDS, number, number]][]} */
  const listed = Object.entries(header.arrays);
  const arrays = listed.map(([name, [kind, offset, size]]) =>
    [name, new KINDS[kind](buffer, HEAD + length + offset, size)]);
  return { header, ...Object.fromEntries(arrays) };
}

/** Row k of a table whose rows are joined into one array.
 * @type {(joined: Numbers, starts: Numbers, k: number) => Numbers} */
const row = (joined, starts, k) => joined.subarray(starts[k], starts[k + 1]);

/** Scene number k of an atlas.
 * @type {(atlas: Atlas, k: number) => Scene} */
export function sceneAt(atlas, k) {
  const size = GRID * GRID, grid = atlas.truth[k], film = row(atlas.film, atlas.films, k);
  const [first, end] = [atlas.traces[k], atlas.traces[k + 1]];
  return { ...atlas.header.scenes[k], atlas, number: k, film, first,
           start: atlas.start[k], swaps: atlas.swaps[k],
           truth: atlas.grids.subarray(grid * size, (grid + 1) * size),
           frames: 1 + (end - first || film.length), traced: end > first };
}

// -- frames --------------------------------------------------------------------------------------

/** Frame 0 is the start mesh; those after it are the tries of a trace, or else the meshes of the film.
 * @type {(scene: Scene, frame: number) => Frame} */
export function frameAt(scene, frame) {
  const { atlas, start, film } = scene;
  if (scene.traced && frame) return tryAt(scene, frame);
  const elements = elementsOf(atlas, frame ? film[frame - 1] : start);
  return { elements, swaps: frame ? scene.swaps : 0, costs: costsAt(scene, frame) };
}

/** The mesh after a try, which follows from the start mesh by all swaps so far.
 * @type {(scene: Scene, frame: number) => Frame} */
function tryAt(scene, frame) {
  const { atlas, first } = scene, elements = elementsOf(atlas, scene.start), last = first + frame - 1;
  let swaps = 0;
  for (let k = first; k <= last; k++) {
    if (!atlas.accepted[k]) continue;
    swap(elements, triedAt(atlas, k), atlas);
    swaps += 1;
  }
  return { elements, swaps, tried: triedAt(atlas, last),
           costs: costsAt(scene, swaps), local: localAt(scene, frame - 1) };
}

/** The elements of a mesh, three nodes each.
 * @type {(atlas: Atlas, mesh: number) => Uint32Array} */
function elementsOf(atlas, mesh) {
  const steps = row(atlas.members, atlas.meshes, mesh), elements = new Uint32Array(3 * steps.length);
  let number = 0;
  for (let t = 0; t < steps.length; t++) {
    number += steps[t] % 2 ? -(steps[t] + 1) / 2 : steps[t] / 2;
    elements.set(atlas.elements.subarray(3 * number, 3 * number + 3), 3 * t);
  }
  return elements;
}

/** Try number k of the atlas: to replace the edge a-b by c-d.
 * @type {(atlas: Atlas, k: number) => Try} */
function triedAt({ a, b, c, d, accepted }, k) {
  return { a: a[k], b: b[k], c: c[k], d: d[k], accepted: Boolean(accepted[k]) };
}

/** Replaces, in place, the two elements at the edge a-b by the two at c-d.
 *
 *         a                  a
 *       / | \              /   \
 *      c  |  d    -->     c --- d
 *       \ | /              \   /
 *         b                  b
 *
 * @type {(elements: Uint32Array, edges: Omit<Try, "accepted">, points: Points) => void} */
export function swap(elements, { a, b, c, d }, points) {
  const ends = [a, b];
  for (let t = 0; t < elements.length && ends.length; t += 3) {
    const nodes = elements.subarray(t, t + 3);
    if (nodes.includes(a) && nodes.includes(b)) {
      nodes.set(counterClockwise([c, d, /** @type {number} */ (ends.pop())], points));
    }
  }
}

/** The three nodes of an element, counter-clockwise.
 * @type {(nodes: number[], points: Points) => number[]} */
function counterClockwise([p, q, r], { x, y }) {
  const turn = (x[q] - x[p]) * (y[r] - y[p]) - (x[r] - x[p]) * (y[q] - y[p]);
  return turn > 0 ? [p, q, r] : [p, r, q];
}

// -- costs for which there is no formula -------------------------------------------------------

/** Name of an edge, element or node in `Costs`, by its points.
 * @type {(points: Iterable<number>) => string} */
export const partOf = (points) => Array.from(new Set(points)).sort((p, q) => p - q).join();

/** Costs of mesh number `mesh` of a scene; none if there is a formula for them.
 * @type {(scene: Scene, mesh: number) => Costs | undefined} */
function costsAt({ atlas, given, number }, mesh) {
  if (!given) return undefined;
  const { changes, stage, p, q, r, cost } = /** @type {GivenCosts} */ (atlas), costs = new Map();
  for (let k = changes[number]; k < changes[number + 1] && stage[k] <= mesh; k++) {
    costs.set(partOf([p[k], q[k], r[k]]), cost[k]);
  }
  return costs;
}

/** What the norm compares of the costs around try number k of a scene; nothing if there is a formula.
 * @type {(scene: Scene, k: number) => Pair | undefined} */
function localAt({ atlas, given, number }, k) {
  if (!given) return undefined;
  const { tries, old, new: other } = /** @type {GivenCosts} */ (atlas), at = tries[number] + k;
  return [old[at], other[at]];
}
