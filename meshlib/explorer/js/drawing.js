// Draws one frame of a scene into the three flat panels, with any pen of pens.js.

import { GRID } from "./atlas.js";
import { channelsOf, cividis, css, LEVELS, levelsOf, shade, shareOf, viridis } from "./colours.js";
import { contextOf } from "./pens.js";

/** @import { Box, Draw, Pair, Pen, Place, Shown, Try } from "./types" */

export const MARGIN = 6;                             // pixels around the domain
const ROOMY = 20;                                    // pixels between edges that are drawn at full width
const THINNEST = 0.4;                                // least width of an edge, as a share of the full one
export const RIM = "rgb(0, 0, 0)";
export const TRIED = "#d55e00";
const SIDES = "#56b4e9";

// -- paths -------------------------------------------------------------------------------

/** From the domain to a square panel and back; `scale` is in pixels for a unit of the domain.
 * @type {(box: Box, side: number) => Place} */
export function flat({ low, high, size }, side) {
  const scale = (side - 2 * MARGIN) / size;
  const left = (side - scale * (low[0] + high[0])) / 2, bottom = (side + scale * (low[1] + high[1])) / 2;
  return { px: (x) => left + scale * x, py: (y) => bottom - scale * y,
           back: (px, py) => [(px - left) / scale, (bottom - py) / scale], scale };
}

/** Strokes some edges, or all of the mesh.
 * @type {(pen: Pen, shown: Shown, colour: string, width: number, edges?: Pair[] | null) => void} */
export function strokeEdges(pen, { mesh, place }, colour, width, edges = null) {
  const { x, y, ends } = mesh;
  pen.beginPath();
  const line = (/** @type {number} */ p, /** @type {number} */ q) => {
    pen.moveTo(place.px(x[p]), place.py(y[p]));
    pen.lineTo(place.px(x[q]), place.py(y[q]));
  };
  if (edges) edges.forEach(([p, q]) => line(p, q));
  else for (let k = 0; k < ends.length; k += 2) line(ends[k], ends[k + 1]);
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke();
}

/** Adds the outline of element t to the path; px and py give the place of a node.
 * @type {(pen: Pen, elements: Uint32Array, t: number, px: (node: number) => number,
 *         py: (node: number) => number) => void} */
export function pathOf(pen, elements, t, px, py) {
  for (let k = 3 * t; k < 3 * t + 3; k++) {
    if (k % 3) pen.lineTo(px(elements[k]), py(elements[k]));
    else pen.moveTo(px(elements[k]), py(elements[k]));
  }
  pen.closePath();
}

/** Calls above(points) with the part of each element where u >= level, and line(points) with the
 * line where u = level; points are x, y, x, y ... on the panel.
 * @type {(shown: Shown, level: number, above: ((points: number[]) => void) | null,
 *         line?: (points: number[]) => void) => void} */
function cut({ mesh, place }, level, above, line) {
  const { x, y, u, elements } = mesh;
  for (let t = 0; t < elements.length; t += 3) {
    const part = [], ends = [];
    for (let k = 0; k < 3; k++) {
      const p = elements[t + k], q = elements[t + (k + 1) % 3], [px, py] = [place.px(x[p]), place.py(y[p])];
      if (u[p] >= level) part.push(px, py);
      if ((u[p] >= level) === (u[q] >= level)) continue;
      const share = (level - u[p]) / (u[q] - u[p]);
      const at = [px + share * (place.px(x[q]) - px), py + share * (place.py(y[q]) - py)];
      part.push(...at);
      ends.push(...at);
    }
    if (part.length && above) above(part);
    if (ends.length && line) line(ends);
  }
}

/** A function that adds the polygon, or the open line, through some points to the path.
 * @type {(pen: Pen, closed: boolean) => (points: number[]) => void} */
export function tracer(pen, closed) {
  return (points) => {
    pen.moveTo(points[0], points[1]);
    for (let k = 2; k < points.length; k += 2) pen.lineTo(points[k], points[k + 1]);
    if (closed) pen.closePath();
  };
}

// -- the mesh over its interpolant -------------------------------------------------------------

/** @type {Draw} */
export function drawMesh(pen, shown) {
  const { mesh, limits } = shown;
  fillBands(pen, shown, levelsOf(limits));
  // White on a dark rim can be seen on every colour of the table, which it must not cover.
  const room = shown.side / Math.sqrt(mesh.size), width = Math.min(Math.max(room / ROOMY, THINNEST), 1);
  pen.globalAlpha = 0.45;
  strokeEdges(pen, shown, RIM, 2.2 * width);
  pen.globalAlpha = 1;
  strokeEdges(pen, shown, "white", width);
  if (mesh.tried) drawTried(pen, shown, mesh.tried);
}

/** Fills the whole mesh with the lowest colour, and the part above each level with its own.
 * @type {(pen: Pen, shown: Shown, levels: number[]) => void} */
function fillBands(pen, shown, levels) {
  const { mesh: { x, y, elements, size }, place } = shown;
  pen.beginPath();
  for (let t = 0; t < size; t++) pathOf(pen, elements, t, (n) => place.px(x[n]), (n) => place.py(y[n]));
  pen.fillStyle = css(viridis[0]);
  pen.fill();
  levels.forEach((level, k) => {
    pen.beginPath();                                 // one path: pieces would leave hairlines between
    cut(shown, level, tracer(pen, true));
    pen.fillStyle = css(shade(viridis, (k + 1) / LEVELS));
    pen.fill();
  });
}

/** As in Figure 3.3: the edge, the other diagonal dashed, and the four sides around them.
 * @type {(pen: Pen, shown: Shown, tried: Try) => void} */
function drawTried(pen, shown, { a, b, c, d, accepted }) {
  /** @type {Pair[]} */
  const sides = [[a, c], [c, b], [b, d], [d, a]];
  strokeEdges(pen, shown, RIM, 5, sides);
  strokeEdges(pen, shown, SIDES, 3, sides);
  /** @type {[Pair, Pair]} */
  const [solid, dashed] = accepted ? [[c, d], [a, b]] : [[a, b], [c, d]];
  strokeEdges(pen, shown, "white", 5.5, [solid]);
  strokeEdges(pen, shown, TRIED, 3.5, [solid]);
  pen.setLineDash([5, 5]);
  strokeEdges(pen, shown, TRIED, 2, [dashed]);
  pen.setLineDash([]);
}

// -- lines of constant value, and the error ----------------------------------------------------

/** @type {Draw} */
export function drawLines(pen, shown) {
  const { limits, ink } = shown;
  pen.globalAlpha = 0.2;
  strokeEdges(pen, shown, ink, 0.8);
  pen.globalAlpha = 1;
  for (const level of levelsOf(limits)) {
    pen.beginPath();
    cut(shown, level, null, tracer(pen, false));
    // Some ink, so that either end of the table stands out from dark and from light paper.
    const colour = shade(viridis, shareOf(level, limits)), tint = channelsOf(ink);
    pen.strokeStyle = css(colour.map((c, k) => 0.7 * c + 0.3 * tint[k]));
    pen.lineWidth = 1.8;
    pen.stroke();
  }
}

/** @type {Draw} */
export function drawError(pen, shown) {
  const { box: { low, high }, place, error, worst } = shown;
  const [left, top] = [place.px(low[0]), place.py(high[1])];
  // Grid points are the middles of pixels: the outer ones reach half a pixel over the edge.
  pen.drawImage(picture(error, worst), 0.5, 0.5, GRID - 1, GRID - 1, left, top,
                place.px(high[0]) - left, place.py(low[1]) - top);
  pen.globalAlpha = 0.3;
  strokeEdges(pen, shown, "white", 0.8);
  pen.globalAlpha = 1;
}

/** A pixel for each point of the grid.
 * @type {(error: Float64Array, worst: number) => HTMLCanvasElement} */
function picture(error, worst) {
  const canvas = Object.assign(document.createElement("canvas"), { width: GRID, height: GRID });
  const pen = contextOf(canvas), image = pen.createImageData(GRID, GRID);
  error.forEach((value, k) => {
    const start = 4 * ((GRID - 1 - Math.floor(k / GRID)) * GRID + (k % GRID));
    const [red, green, blue] = shade(cividis, worst ? value / worst : 0);
    image.data[start] = red;
    image.data[start + 1] = green;
    image.data[start + 2] = blue;
    image.data[start + 3] = 255;
  });
  pen.putImageData(image, 0, 0);
  return canvas;
}
