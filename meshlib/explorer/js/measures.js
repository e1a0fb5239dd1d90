// What a mesh is worth: edges, costs, errors and shapes, as in meshlib, from the elements alone.

const EQUILATERAL = Math.PI / 3, DEGREE = Math.PI / 180;
const ON_EDGE = 1e-9;                                // a grid point so far outside is on the edge
const FLAT = 1e-12;                                  // area over squared size, of rounding alone

const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);

// The mesh of a frame: coordinates of the atlas, elements, and edges with their two elements.
function meshOf({ atlas }, { elements, swaps, tried }) {
  const { x, y, u } = atlas;
  return { x, y, u, elements, swaps, tried, ...edgesOf(elements),
           nodes: Uint32Array.from(new Set(elements)), size: elements.length / 3 };
}

function edgesOf(elements) {
  const numbers = new Map(), ends = [], sides = [];
  for (let h = 0; h < elements.length; h++) {
    const t = Math.floor(h / 3), p = elements[h], q = elements[3 * t + (h + 1) % 3];
    const key = Math.min(p, q) * 2 ** 26 + Math.max(p, q), known = numbers.get(key);
    if (known === undefined) {
      numbers.set(key, sides.length / 2);
      ends.push(p, q);
      sides.push(t, -1);
    } else sides[2 * known + 1] = t;
  }
  return { ends, sides, edges: sides.length / 2 };
}

const cornersOf = ({ elements }, t) => elements.subarray(3 * t, 3 * t + 3);
const opposite = (mesh, t, p, q) => cornersOf(mesh, t).find((n) => n !== p && n !== q);

// -- errors on the grid -------------------------------------------------------------------

function boxOf({ x, y, nodes }) {
  const box = { low: [Infinity, Infinity], high: [-Infinity, -Infinity] };
  for (const n of nodes) {
    [x[n], y[n]].forEach((value, k) => {
      box.low[k] = Math.min(box.low[k], value);
      box.high[k] = Math.max(box.high[k], value);
    });
  }
  return { ...box, size: Math.max(box.high[0] - box.low[0], box.high[1] - box.low[1]) };
}

// |u - u_h| at the points of the grid, row by row from below.
function errorOf(mesh, truth, { low, high }) {
  const error = new Float64Array(truth.length);
  const [dx, dy] = [0, 1].map((k) => (high[k] - low[k]) / (GRID - 1));
  for (let t = 0; t < mesh.size; t++) {
    const { x, y, u } = mesh, [p, q, r] = cornersOf(mesh, t), [g, h] = gradient(mesh, p, q, r);
    if (isFlat(mesh, p, q, r)) continue;             // its neighbours have its points
    const xs = [x[p], x[q], x[r]], ys = [y[p], y[q], y[r]];
    const last = Math.min(GRID - 1, Math.floor((Math.max(...ys) - low[1]) / dy + ON_EDGE));
    for (let j = Math.max(0, Math.ceil((Math.min(...ys) - low[1]) / dy - ON_EDGE)); j <= last; j++) {
      const v = low[1] + j * dy, [left, right] = crossing(xs, ys, v, ON_EDGE * dy);
      const end = Math.min(GRID - 1, Math.floor((right - low[0]) / dx + ON_EDGE));
      for (let i = Math.max(0, Math.ceil((left - low[0]) / dx - ON_EDGE)); i <= end; i++) {
        const value = u[p] + g * (low[0] + i * dx - x[p]) + h * (v - y[p]);
        error[j * GRID + i] = Math.abs(truth[j * GRID + i] - value);
      }
    }
  }
  return error;
}

function isFlat({ x, y }, p, q, r) {
  const [ex, ey, fx, fy] = [x[q] - x[p], y[q] - y[p], x[r] - x[p], y[r] - y[p]];
  return Math.abs(ex * fy - ey * fx) < FLAT * (ex * ex + ey * ey + fx * fx + fy * fy);
}

// Where the line y = v enters and leaves a triangle.
function crossing(xs, ys, v, slack) {
  let left = Infinity, right = -Infinity;
  for (let k = 0; k < 3; k++) {
    const m = (k + 1) % 3, low = Math.min(ys[k], ys[m]), high = Math.max(ys[k], ys[m]);
    if (v < low - slack || v > high + slack) continue;
    const share = high - low > slack ? Math.min(Math.max((v - ys[k]) / (ys[m] - ys[k]), 0), 1) : 0;
    const at = xs[k] + share * (xs[m] - xs[k]), other = high - low > slack ? at : xs[m];
    left = Math.min(left, at, other);
    right = Math.max(right, at, other);
  }
  return [left, right];
}

// By the trapezium rule.
function l2Of(error, { low, high }) {
  const area = (high[0] - low[0]) * (high[1] - low[1]) / (GRID - 1) ** 2, edge = [0, GRID - 1];
  let sum = 0;
  error.forEach((e, k) => {
    const halves = edge.includes(k % GRID) + edge.includes(Math.floor(k / GRID));
    sum += e * e / 2 ** halves;
  });
  return Math.sqrt(sum * area);
}

// -- costs ----------------------------------------------------------------------------------

function gradient({ x, y, u }, p, q, r) {
  const [ex, ey, du] = [x[q] - x[p], y[q] - y[p], u[q] - u[p]];
  const [fx, fy, dv] = [x[r] - x[p], y[r] - y[p], u[r] - u[p]];
  const area = ex * fy - ey * fx;
  return [(du * fy - dv * ey) / area, (dv * ex - du * fx) / area];
}

// Costs of an edge p-q with elements to the left (l) and right (r), as in costs.py.
const EDGE_COSTS = {
  jnd({ x, y }, p, q, g, h) {
    const along = [x[q] - x[p], y[q] - y[p]], jump = [g[0] - h[0], g[1] - h[1]];
    return Math.abs(along[1] * jump[0] - along[0] * jump[1]) / Math.hypot(...along);
  },
  abn(mesh, p, q, g, h) {
    const cross = Math.hypot(h[1] - g[1], g[0] - h[0], g[0] * h[1] - g[1] * h[0]);
    return Math.atan2(cross, g[0] * h[0] + g[1] * h[1] + 1);
  },
  dlp: (...arguments_) => Math.hypot(...misses(...arguments_)),
  dfp(mesh, p, q, g, h, l, r) {
    const [over, under] = misses(mesh, p, q, g, h, l, r);
    return Math.hypot(over / Math.hypot(1, ...g), under / Math.hypot(1, ...h));
  },
};

// How far the plane of each element misses the opposite node of the other.
function misses({ x, y, u }, p, q, g, h, l, r) {
  return [[g, r], [h, l]].map(([[a, b], n]) => u[p] + a * (x[n] - x[p]) + b * (y[n] - y[p]) - u[n]);
}

const ELEMENT_COSTS = {
  "smallest-angle": (mesh, t) => Math.max(EQUILATERAL - Math.min(...anglesOf(mesh, t)), 0),
  "largest-angle": (mesh, t) => Math.max(Math.max(...anglesOf(mesh, t)) - EQUILATERAL, 0),
};

// Of an inner edge by the elements that meet there; 0 on the boundary.
function edgeCost(mesh, name, e) {
  const [p, q] = [mesh.ends[2 * e], mesh.ends[2 * e + 1]];
  const [s, t] = [mesh.sides[2 * e], mesh.sides[2 * e + 1]];
  return t < 0 ? 0 : costBetween(mesh, name, p, q, opposite(mesh, s, p, q), opposite(mesh, t, p, q));
}

function costBetween(mesh, name, p, q, l, r) {
  return EDGE_COSTS[name](mesh, p, q, gradient(mesh, p, q, l), gradient(mesh, q, p, r), l, r);
}

// Cost vectors as the norms measure them; of the lexicographic order the first entry.
const largest = (costs) => Math.max(...costs);
const NORMS = { 1: sum, 2: (costs) => sum(costs.map((cost) => cost * cost)), max: largest,
                lexicographic: largest };

// Of the five edges, or the two elements, of a quadrilateral.
function localCost(mesh, { cost, on, norm }, corners) {
  const inside = (...nodes) => nodes.every((n) => corners.includes(n)), costs = [];
  if (on === "edge") {
    for (let e = 0; e < mesh.edges; e++) {
      if (inside(mesh.ends[2 * e], mesh.ends[2 * e + 1])) costs.push(edgeCost(mesh, cost, e));
    }
  } else {
    for (let t = 0; t < mesh.size; t++) {
      if (inside(...cornersOf(mesh, t))) costs.push(ELEMENT_COSTS[cost](mesh, t));
    }
  }
  return NORMS[norm](costs);
}

// The local cost with the old edge of what was tried, and with the new one.
function triedCosts(mesh, scene) {
  const { a, b, c, d, accepted } = mesh.tried, elements = mesh.elements.slice();
  swap(elements, accepted ? { a: c, b: d, c: a, d: b } : mesh.tried, mesh);
  const pair = [mesh, { ...mesh, elements, ...edgesOf(elements) }]
    .map((m) => localCost(m, scene, [a, b, c, d]));
  return accepted ? pair.reverse() : pair;
}

// -- shapes ---------------------------------------------------------------------------------

function anglesOf({ x, y, elements }, t) {
  return [0, 1, 2].map((k) => {
    const [p, q, r] = [0, 1, 2].map((m) => elements[3 * t + (k + m) % 3]);
    const [e, f] = [[x[q] - x[p], y[q] - y[p]], [x[r] - x[p], y[r] - y[p]]];
    return Math.atan2(Math.abs(e[0] * f[1] - e[1] * f[0]), e[0] * f[0] + e[1] * f[1]);
  });
}

function aspectRatio({ x, y, elements }, t) {
  const [p, q, r] = elements.subarray(3 * t, 3 * t + 3);
  const area = (x[q] - x[p]) * (y[r] - y[p]) - (x[r] - x[p]) * (y[q] - y[p]);
  const squares = sum([[p, q], [q, r], [r, p]].map(([m, n]) => (x[m] - x[n]) ** 2 + (y[m] - y[n]) ** 2));
  return 2 * Math.sqrt(3) * area / squares;
}

// Label, decimals and measure of an element, whose angles are known.
const SHAPES = [
  ["Maximum angle (°)", 1, (angles) => Math.max(...angles) / DEGREE],
  ["Skewness", 3, (angles) => angles.reduce((s, a) => s + Math.abs(a - EQUILATERAL), 0) / 3],
  ["Aspect ratio", 3, (angles, mesh, t) => aspectRatio(mesh, t)],
];

// The numbers of the table: rows of label, value, and text as in scene.py.
function numbersOf(mesh, error, box) {
  const counts = { Nodes: mesh.nodes.length, Edges: mesh.edges, Elements: mesh.size, Swaps: mesh.swaps };
  const errors = { "L2 error": l2Of(error, box), "Largest error": error.reduce((m, e) => Math.max(m, e), 0) };
  const angles = Array.from({ length: mesh.size }, (_, t) => anglesOf(mesh, t));
  const shapes = SHAPES.flatMap(([label, digits, measure]) => {
    const values = angles.map((three, t) => measure(three, mesh, t));
    const mean = values.reduce((s, v) => s + v, 0) / mesh.size;
    return [["mean", mean], ["max", Math.max(...values)]]
      .map(([kind, value]) => [`${label}, ${kind}`, value, value.toFixed(digits)]);
  });
  return [...Object.entries(counts).map(([label, n]) => [label, n, String(n)]),
          ...Object.entries(errors).map(([label, e]) => [label, e, significant(e)]), ...shapes];
}

function significant(error) {
  if (error >= 0.01 || error === 0) return error.toFixed(4);
  return error.toExponential(2).replace(/([+-])(\d)$/, "$10$2");
}
