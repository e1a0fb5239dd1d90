// How well a mesh represents the function, and how well its elements are shaped, as in meshlib.

import { GRID } from "./atlas.js";
import { EQUILATERAL } from "./costs.js";
import { anglesOf, cornersOf, DEGREE, gradient, sum } from "./mesh.js";

/** @import { Box, Mesh, Numbered, Pair, Points, Shape, Triple } from "./types" */

const ON_EDGE = 1e-9;                                // spacings of the grid between an edge and a point on it
const FLAT = 1e-12;                                  // area over squared sides that is rounding alone

// -- errors on the grid -------------------------------------------------------------------

/** |u - u_h| at the points of the grid, row by row from below.
 * @type {(mesh: Mesh, truth: Float32Array, box: Box) => Float64Array} */
export function errorOf(mesh, truth, { low, high }) {
  const error = new Float64Array(truth.length), { x, y, u } = mesh;
  const [dx, dy] = [0, 1].map((k) => (high[k] - low[k]) / (GRID - 1));
  for (let t = 0; t < mesh.size; t++) {
    const [p, q, r] = cornersOf(mesh, t), [g, h] = gradient(mesh, p, q, r);
    if (isFlat(mesh, p, q, r)) continue;             // its points lie in its neighbours too
    /** @type {[Triple, Triple]} */
    const [xs, ys] = [[x[p], x[q], x[r]], [y[p], y[q], y[r]]];
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

/** @type {(points: Points, p: number, q: number, r: number) => boolean} */
function isFlat({ x, y }, p, q, r) {
  const [ex, ey, fx, fy] = [x[q] - x[p], y[q] - y[p], x[r] - x[p], y[r] - y[p]];
  return Math.abs(ex * fy - ey * fx) < FLAT * (ex * ex + ey * ey + fx * fx + fy * fy);
}

/** Where the line y = v enters and leaves the triangle with corners xs, ys.
 * @type {(xs: Triple, ys: Triple, v: number, slack: number) => Pair} */
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

/** L2 norm of an error on the grid, by the trapezium rule: half weight on an edge of the box, a
 * quarter in a corner.
 * @type {(error: Float64Array, box: Box) => number} */
function l2Of(error, { low, high }) {
  const area = (high[0] - low[0]) * (high[1] - low[1]) / (GRID - 1) ** 2;
  const onEdge = (/** @type {number} */ k) => Number(k === 0 || k === GRID - 1);
  let total = 0;
  error.forEach((e, k) => {
    total += e * e / 2 ** (onEdge(k % GRID) + onEdge(Math.floor(k / GRID)));
  });
  return Math.sqrt(total * area);
}

/** @type {(error: Float64Array) => number} */
export const largestOf = (error) => error.reduce((most, e) => Math.max(most, e), 0);

// -- shapes ---------------------------------------------------------------------------------

/** 1 for an equilateral element, 0 for a flat one.
 * @type {(mesh: Mesh, t: number) => number} */
function aspectRatio({ x, y, elements }, t) {
  const [p, q, r] = elements.subarray(3 * t, 3 * t + 3);
  const area = (x[q] - x[p]) * (y[r] - y[p]) - (x[r] - x[p]) * (y[q] - y[p]);
  const squares = sum([[p, q], [q, r], [r, p]].map(([m, n]) => (x[m] - x[n]) ** 2 + (y[m] - y[n]) ** 2));
  return 2 * Math.sqrt(3) * area / squares;
}

/** Label, decimals, and the measure of element t, whose angles are known.
 * @type {Shape[]} */
const SHAPES = [
  ["Maximum angle (°)", 1, (angles) => Math.max(...angles) / DEGREE],
  ["Skewness", 3, (angles) => sum(angles.map((a) => Math.abs(a - EQUILATERAL))) / 3],
  ["Aspect ratio", 3, (angles, mesh, t) => aspectRatio(mesh, t)],
];

/** The numbers of the quality table.
 * @type {(mesh: Mesh, error: Float64Array, box: Box) => Numbered[]} */
export function numbersOf(mesh, error, box) {
  const counts = { Nodes: mesh.nodes.length, Edges: mesh.edges, Elements: mesh.size, Swaps: mesh.swaps };
  const errors = { "L2 error": l2Of(error, box), "Largest error": largestOf(error) };
  return [...Object.entries(counts).map(([label, n]) => /** @type {Numbered} */ ([label, n, String(n)])),
          ...Object.entries(errors).map(([label, e]) => /** @type {Numbered} */ ([label, e, significant(e)])),
          ...shapesOf(mesh)];
}

/** Mean and maximum of each measure of shape.
 * @type {(mesh: Mesh) => Numbered[]} */
function shapesOf(mesh) {
  const angles = Array.from({ length: mesh.size }, (_, t) => anglesOf(mesh, t));
  return SHAPES.flatMap(([label, digits, measure]) => {
    const values = angles.map((three, t) => measure(three, mesh, t));
    const found = { mean: sum(values) / mesh.size, max: Math.max(...values) };
    return Object.entries(found).map(([kind, value]) =>
      /** @type {Numbered} */ ([`${label}, ${kind}`, value, value.toFixed(digits)]));
  });
}

/** An error with four decimals, or three digits where four decimals would say less, as in scene.py.
 * @type {(error: number) => string} */
function significant(error) {
  if (error >= 0.01 || error === 0) return error.toFixed(4);
  return error.toExponential(2).replace(/([+-])(\d)$/, "$10$2");
}
