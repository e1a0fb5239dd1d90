// Costs of edges, elements and nodes: by the formulas of the built-in criteria, as in
// meshlib/criteria/cost_functions.py, or those that an atlas has for a user-defined criterion.

import { partOf, swap } from "./atlas.js";
import { anglesOf, cornersOf, edgesOf, endsOf, gradient, opposite, sidesOf, sum } from "./mesh.js";

/** @import { Costs, Criterion, EdgeCost, ElementCost, Mesh, Pair, Points, Try } from "./types" */

export const EQUILATERAL = Math.PI / 3;              // radians

/** Costs of the edge p-q with gradients g and h of the elements to its left and right, and their
 * nodes l and r opposite the edge.
 * @type {Record<string, EdgeCost>} */
const EDGE_COSTS = {
  jnd({ x, y }, p, q, g, h) {
    const along = [x[q] - x[p], y[q] - y[p]], jump = [g[0] - h[0], g[1] - h[1]];
    return Math.abs(along[1] * jump[0] - along[0] * jump[1]) / Math.hypot(...along);
  },
  abn(points, p, q, g, h) {
    const cross = Math.hypot(h[1] - g[1], g[0] - h[0], g[0] * h[1] - g[1] * h[0]);
    return Math.atan2(cross, g[0] * h[0] + g[1] * h[1] + 1);
  },
  dlp: (points, p, q, g, h, l, r) => Math.hypot(...misses(points, p, g, h, l, r)),
  dfp(points, p, q, g, h, l, r) {
    const [over, under] = misses(points, p, g, h, l, r);
    return Math.hypot(over / Math.hypot(1, ...g), under / Math.hypot(1, ...h));
  },
};

/** How far the plane of each element at an edge misses the opposite node of the other; p is an end
 * of the edge.
 * @type {(points: Points, p: number, g: Pair, h: Pair, l: number, r: number) => Pair} */
function misses({ x, y, u }, p, g, h, l, r) {
  const miss = (/** @type {Pair} */ [a, b], /** @type {number} */ n) =>
    u[p] + a * (x[n] - x[p]) + b * (y[n] - y[p]) - u[n];
  return [miss(g, r), miss(h, l)];
}

/** @type {Record<string, ElementCost>} */
const ELEMENT_COSTS = {
  "smallest-angle": (mesh, t) => Math.max(EQUILATERAL - Math.min(...anglesOf(mesh, t)), 0),
  "largest-angle": (mesh, t) => Math.max(Math.max(...anglesOf(mesh, t)) - EQUILATERAL, 0),
};

// -- costs of a mesh ----------------------------------------------------------------------------

/** Cost of edge e; 0 on the boundary.
 * @type {(mesh: Mesh, criterion: Criterion, e: number) => number} */
export function edgeCost(mesh, { cost }, e) {
  const [p, q] = endsOf(mesh, e), [s, t] = sidesOf(mesh, e);
  if (mesh.costs) return givenCost(mesh.costs, [p, q]);
  if (t < 0) return 0;
  const l = opposite(mesh, s, p, q), r = opposite(mesh, t, p, q);
  return EDGE_COSTS[cost](mesh, p, q, gradient(mesh, p, q, l), gradient(mesh, q, p, r), l, r);
}

/** Cost of element t.
 * @type {(mesh: Mesh, criterion: Criterion, t: number) => number} */
export const elementCost = (mesh, { cost }, t) =>
  (mesh.costs ? givenCost(mesh.costs, cornersOf(mesh, t)) : ELEMENT_COSTS[cost](mesh, t));

/** Cost of node n; there is no formula for any criterion on nodes.
 * @type {(mesh: Mesh, n: number) => number} */
export const nodeCost = ({ costs = new Map() }, n) => givenCost(costs, [n]);

/** @type {(costs: Costs, points: Iterable<number>) => number} */
const givenCost = (costs, points) => costs.get(partOf(points)) ?? 0;

/** Mean cost of the three sides of element t.
 * @type {(mesh: Mesh, criterion: Criterion, t: number) => number} */
export function meanOfSides(mesh, criterion, t) {
  let total = 0;
  for (let e = 0; e < mesh.edges; e++) {
    if (sidesOf(mesh, e).includes(t)) total += edgeCost(mesh, criterion, e);
  }
  return total / 3;
}

/** Mean cost of the three nodes of element t.
 * @type {(mesh: Mesh, t: number) => number} */
export const meanOfNodes = (mesh, t) => sum(Array.from(cornersOf(mesh, t), (n) => nodeCost(mesh, n))) / 3;

// -- swaps --------------------------------------------------------------------------------------

/** @type {(costs: number[]) => number} */
const largest = (costs) => Math.max(...costs);

/** What a norm compares; of the lexicographic order it is the first entry. */
const NORMS = { 1: sum, 2: (/** @type {number[]} */ costs) => sum(costs.map((cost) => cost * cost)),
                max: largest, lexicographic: largest };

/** What the norm compares of the five edges, or two elements, of a quadrilateral.
 * @type {(mesh: Mesh, criterion: Criterion, corners: number[]) => number} */
function localCost(mesh, criterion, corners) {
  /** @type {(nodes: Pair | Uint32Array) => boolean} */
  const inside = (nodes) => Array.from(nodes).every((n) => corners.includes(n));
  /** @type {number[]} */
  const costs = [];
  if (criterion.on === "edge") {
    for (let e = 0; e < mesh.edges; e++) {
      if (inside(endsOf(mesh, e))) costs.push(edgeCost(mesh, criterion, e));
    }
  } else {
    for (let t = 0; t < mesh.size; t++) {
      if (inside(cornersOf(mesh, t))) costs.push(elementCost(mesh, criterion, t));
    }
  }
  return NORMS[criterion.norm](costs);
}

/** The local cost with the old edge of what was tried, and with the new one.
 * @type {(mesh: Mesh, tried: Try, criterion: Criterion) => Pair} */
export function triedCosts(mesh, { a, b, c, d, accepted }, criterion) {
  if (mesh.local) return mesh.local;
  const elements = mesh.elements.slice();
  swap(elements, accepted ? { a: c, b: d, c: a, d: b } : { a, b, c, d }, mesh);
  const [here, there] = [mesh, { ...mesh, elements, ...edgesOf(elements) }]
    .map((m) => localCost(m, criterion, [a, b, c, d]));
  return accepted ? [there, here] : [here, there];
}
