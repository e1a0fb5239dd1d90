// Draws one frame of a scene as a surface in space, seen from far away.

import { css, shade, shareOf, viridis } from "./colours.js";
import { MARGIN, pathOf, RIM, tracer } from "./drawing.js";
import { cornersOf } from "./mesh.js";

/** @import { Box, Draw, Mesh, Pair, Pen, Shown, Triple, Unit } from "./types" */

const HEIGHT = 0.45;                                 // height of the surface, in widths of the domain
const REACH = 1.5;                                   // widths of the domain that fit into the panel
const LIGHT = [0.15, -0.45, 0.88];                   // direction from the surface to the lamp
const SHADOW = 0.4;                                  // share of its light that a facet in the shade loses

/** @type {Draw} */
export function drawSurface(pen, shown) {
  const { mesh } = shown, { elements, u } = mesh, eye = seen(shown);
  /** @type {Map<number, Triple>} */
  const at = new Map();                              // each node: right, down, distance
  for (const n of mesh.nodes) at.set(n, eye(mesh.x[n], mesh.y[n], u[n]));
  const place = (/** @type {number} */ n) => /** @type {Triple} */ (at.get(n));
  drawFloor(pen, shown, eye);
  const distance = (/** @type {number} */ t) =>
    [0, 1, 2].reduce((sum, k) => sum + place(elements[3 * t + k])[2], 0);
  const far = Array.from({ length: mesh.size }, (_, t) => [distance(t), t]).sort((a, b) => b[0] - a[0]);
  for (const [, t] of far) drawFacet(pen, shown, t, place);
}

/** The rectangle below the surface.
 * @type {(pen: Pen, shown: Shown, eye: Unit) => void} */
function drawFloor(pen, { limits, ink, box: { low, high } }, eye) {
  const corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
  pen.globalAlpha = 0.35;
  pen.beginPath();
  tracer(pen, true)(corners.flatMap(([x, y]) => eye(x, y, limits[0]).slice(0, 2)));
  pen.strokeStyle = ink;
  pen.lineWidth = 1;
  pen.stroke();
  pen.globalAlpha = 1;
}

/** @type {(pen: Pen, shown: Shown, t: number, place: (node: number) => Triple) => void} */
function drawFacet(pen, { mesh, limits, unit }, t, place) {
  const nodes = cornersOf(mesh, t), mean = (mesh.u[nodes[0]] + mesh.u[nodes[1]] + mesh.u[nodes[2]]) / 3;
  pen.beginPath();
  pathOf(pen, mesh.elements, t, (n) => place(n)[0], (n) => place(n)[1]);
  pen.fillStyle = css(shade(viridis, shareOf(mean, limits)), 1 - SHADOW * (1 - lit(mesh, nodes, unit)));
  pen.fill();
  pen.strokeStyle = RIM;
  pen.lineWidth = 0.4;
  pen.stroke();
}

/** A point in space as the eye sees it from far away: right, down, and distance.
 * @type {(shown: Shown) => Unit} */
function seen({ unit, side, eye: { azimuth, elevation } }) {
  const scale = (side - 2 * MARGIN) / REACH, [c, s] = [Math.cos(azimuth), Math.sin(azimuth)];
  const [cosine, sine] = [Math.cos(elevation), Math.sin(elevation)];
  return (...point) => {
    const [x, y, z] = unit(...point), towards = c * x + s * y;
    return [side / 2 + scale * (c * y - s * x), side / 2 - scale * (cosine * z - sine * towards),
            -cosine * towards - sine * z];
  };
}

/** Moves points into a box around the origin that is the same for all frames of a scene.
 * @type {(box: Box, limits: Pair) => Unit} */
export function normalised({ low, high, size }, limits) {
  return (x, y, u) => [(x - (low[0] + high[0]) / 2) / size, (y - (low[1] + high[1]) / 2) / size,
                       HEIGHT * (shareOf(u, limits) - 0.5)];
}

/** The share of the light that a facet gets.
 * @type {(mesh: Mesh, nodes: Uint32Array, unit: Unit) => number} */
function lit({ x, y, u }, nodes, unit) {
  const [a, b, c] = Array.from(nodes, (n) => unit(x[n], y[n], u[n]));
  const [e, f] = [b, c].map((p) => p.map((v, k) => v - a[k]));
  const normal = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
  const dot = normal.reduce((sum, v, k) => sum + v * LIGHT[k], 0);
  return Math.max(0, dot / Math.hypot(...normal) / Math.hypot(...LIGHT));
}
