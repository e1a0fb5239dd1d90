// The mesh of a frame, made from its elements alone: edges, angles, gradients and the bounding box.

/** @import { Box, Edges, Frame, Mesh, Pair, Points, Scene, Triple } from "./types" */

export const DEGREE = Math.PI / 180;                 // radians
const MOST_POINTS = 2 ** 26;                         // two numbers below it make one that is still exact

/** Sum of some numbers.
 * @type {(numbers: number[]) => number} */
export const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);

/** The mesh of a frame; its nodes are numbers of points of the atlas.
 * @type {(scene: Scene, frame: Frame) => Mesh} */
export function meshOf({ atlas: { x, y, u } }, frame) {
  const { elements } = frame;
  return { ...frame, x, y, u, ...edgesOf(elements),
           nodes: Uint32Array.from(new Set(elements)), size: elements.length / 3 };
}

/** The edges of some elements: two ends each, and the one or two elements at their sides.
 * @type {(elements: Uint32Array) => Edges} */
export function edgesOf(elements) {
  /** @type {Map<number, number>} */
  const numbers = new Map();
  /** @type {number[]} */
  const ends = [];
  /** @type {number[]} */
  const sides = [];
  for (let h = 0; h < elements.length; h++) {
    const t = Math.floor(h / 3), p = elements[h], q = elements[3 * t + (h + 1) % 3];
    const key = Math.min(p, q) * MOST_POINTS + Math.max(p, q), known = numbers.get(key);
    if (known === undefined) {
      numbers.set(key, sides.length / 2);
      ends.push(p, q);
      sides.push(t, -1);
    } else sides[2 * known + 1] = t;
  }
  return { ends, sides, edges: sides.length / 2 };
}

/** The three nodes of element t.
 * @type {(mesh: Pick<Mesh, "elements">, t: number) => Uint32Array} */
export const cornersOf = ({ elements }, t) => elements.subarray(3 * t, 3 * t + 3);

/** The two nodes of edge e.
 * @type {(mesh: Edges, e: number) => Pair} */
export const endsOf = ({ ends }, e) => [ends[2 * e], ends[2 * e + 1]];

/** The two elements at edge e; on the boundary the second is -1.
 * @type {(mesh: Edges, e: number) => Pair} */
export const sidesOf = ({ sides }, e) => [sides[2 * e], sides[2 * e + 1]];

/** The node of element t that is neither p nor q.
 * @type {(mesh: Mesh, t: number, p: number, q: number) => number} */
export const opposite = (mesh, t, p, q) =>
  /** @type {number} */ (cornersOf(mesh, t).find((n) => n !== p && n !== q));

/** Smallest rectangle around the nodes, and the length of its longer side.
 * @type {(mesh: Mesh) => Box} */
export function boxOf({ x, y, nodes }) {
  /** @type {Pair} */
  const low = [Infinity, Infinity];
  /** @type {Pair} */
  const high = [-Infinity, -Infinity];
  for (const n of nodes) {
    [x[n], y[n]].forEach((value, k) => {
      low[k] = Math.min(low[k], value);
      high[k] = Math.max(high[k], value);
    });
  }
  return { low, high, size: Math.max(high[0] - low[0], high[1] - low[1]) };
}

/** Gradient of the plane through three points (x, y, u).
 * @type {(points: Points, p: number, q: number, r: number) => Pair} */
export function gradient({ x, y, u }, p, q, r) {
  const [ex, ey, du] = [x[q] - x[p], y[q] - y[p], u[q] - u[p]];
  const [fx, fy, dv] = [x[r] - x[p], y[r] - y[p], u[r] - u[p]];
  const area = ex * fy - ey * fx;
  return [(du * fy - dv * ey) / area, (dv * ex - du * fx) / area];
}

/** The three angles of element t, in radians.
 * @type {(mesh: Mesh, t: number) => Triple} */
export function anglesOf({ x, y, elements }, t) {
  const corner = (/** @type {number} */ k) => {
    const [p, q, r] = [0, 1, 2].map((m) => elements[3 * t + (k + m) % 3]);
    const [e, f] = [[x[q] - x[p], y[q] - y[p]], [x[r] - x[p], y[r] - y[p]]];
    return Math.atan2(Math.abs(e[0] * f[1] - e[1] * f[0]), e[0] * f[0] + e[1] * f[1]);
  };
  return [corner(0), corner(1), corner(2)];
}
