// The parts of the view: panels with colour bars, the table, and what is said of a frame.

import { CIVIDIS, VIRIDIS } from "./colours.js";
import { triedCosts } from "./costs.js";
import { element } from "./dom.js";
import { drawError, drawLines, drawMesh } from "./drawing.js";
import { DEGREE } from "./mesh.js";
import { drawSurface } from "./surface.js";

/** @import { Eye, Layout, Mesh, Pair, Panel, PanelParts, Scene, Try } from "./types" */

const STEP = 5 * DEGREE;                             // radians by which an arrow key turns the surface
export const HINT = "Point at an edge or an element, or use the arrow keys, to see its cost.";
/** @type {Eye} */
export const EYE = { azimuth: -60 * DEGREE, elevation: 32 * DEGREE };

// The parts of a mesh whose costs a swap changes.
const AROUND = { edge: "five edges", element: "two elements", node: "four nodes" };

/** @type {Panel[]} */
export const PANELS = [
  { name: "mesh", caption: "mesh over the interpolant", draw: drawMesh, table: VIRIDIS,
    ends: (shown) => shown.limits },
  { name: "lines", caption: "lines of constant value", draw: drawLines, table: VIRIDIS,
    ends: (shown) => shown.limits },
  { name: "error", caption: "error |u − u\u2095|", draw: drawError, table: CIVIDIS,
    ends: (shown) => [0, shown.worst] },
  { name: "surface", caption: "surface: drag or use arrow keys", draw: drawSurface, table: VIRIDIS,
    ends: (shown) => shown.limits, turns: true },
];

// -- panels and table --------------------------------------------------------------------------

/** All parts of a view, empty.
 * @type {() => Layout} */
export function layout() {
  const panels = PANELS.map(panel), table = element("table");
  const title = element("p", { className: "title" }), note = element("p", { className: "note" });
  const readout = element("p", { className: "readout" });
  for (const said of [title, readout]) said.setAttribute("role", "status");  // read aloud
  const grid = element("div", { className: "panels" }, ...panels.map((p) => p.figure), table);
  const tools = element("div", { className: "tools" });
  const root = element("div", { className: "mesh-explorer" }, title, note, grid, readout, tools);
  return { root, title, note, panels, table, readout, tools };
}

/** A canvas with its colour bar and caption.
 * @type {(panel: Panel) => PanelParts} */
function panel({ name, caption, table, turns }) {
  const canvas = element("canvas", { className: turns ? "turns" : "", tabIndex: 0 });
  canvas.setAttribute("role", "img");
  const bar = element("span", { className: "bar" });
  bar.style.background = `linear-gradient(to right, ${table.join(", ")})`;
  const ends = [element("span"), element("span")];
  const scale = element("div", { className: "scale" }, bar, ...ends);
  const below = element("figcaption", { textContent: caption });
  const figure = element("figure", { className: name }, canvas, scale, below);
  return { figure, canvas, ends };
}

/** Rows of a label and its number at the start and in the frame shown, whose heading is given.
 * @type {(table: HTMLTableElement, rows: [string, string, string][], heading: string) => void} */
export function fillTable(table, rows, heading) {
  const heads = ["measure", "start", heading].map((textContent) =>
    element("th", { textContent, scope: "col" }));
  const body = rows.map(([label, ...texts]) =>
    element("tr", {}, element("th", { textContent: label, scope: "row" }),
            ...texts.map((textContent) => element("td", { textContent }))));
  table.replaceChildren(element("caption", { textContent: "Quality" }),
    element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...body));
}

/** A number at one end of a colour bar, with three digits of the larger of both; the smaller may be
 * 1e-9 and mean 0.
 * @type {(value: number, ends: Pair) => string} */
export function short(value, [low, high]) {
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (size < 1e-3) return value ? value.toExponential(1) : "0";
  const digits = 2 - Math.floor(Math.log10(size));
  return String(Number(value.toFixed(Math.max(digits, 0))) + 0);
}

/** What was tried in this frame, with the local cost before and after.
 * @type {(mesh: Mesh, tried: Try, scene: Scene, frame: number) => string} */
export function triedText(mesh, tried, scene, frame) {
  const [old, other] = tried.accepted ? ["dashed", "solid"] : ["solid", "dashed"];
  const [before, after] = triedCosts(mesh, tried, scene).map((cost) => cost.toPrecision(4));
  return `Try ${frame}: the ${old} edge against the ${other} one. Cost of the ${AROUND[scene.on]}: `
    + `${before} before, ${after} after. ${tried.accepted ? "Swapped." : "Kept."}`;
}

// -- turning, and the theme --------------------------------------------------------------------

/** Has pointer and arrow keys turn the eye.
 * @type {(canvas: HTMLCanvasElement, eye: Eye, redraw: () => void) => void} */
export function makeTurnable(canvas, eye, redraw) {
  const turn = (/** @type {number} */ right, /** @type {number} */ up) => {
    eye.azimuth -= right;
    eye.elevation = Math.min(Math.max(eye.elevation + up, 0), 90 * DEGREE);
    redraw();
  };
  /** @type {Pair | null} */
  let last = null;                                   // no browser tells how far a finger has moved
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    last = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointermove", ({ buttons, clientX, clientY }) => {
    if (!buttons || !last) return;
    turn((clientX - last[0]) * DEGREE, (clientY - last[1]) * DEGREE);
    last = [clientX, clientY];
  });
  /** @type {Record<string, Pair>} */
  const keys = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] };
  canvas.addEventListener("keydown", (event) => {
    if (!(event.key in keys)) return;
    event.preventDefault();
    turn(...keys[event.key]);
  });
}

/** Redraws when the page turns dark or light; returns a function that ends this.
 * @type {(redraw: () => void) => () => void} */
export function watchTheme(redraw) {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const attributeFilter = ["data-theme", "data-jp-theme-name"], observer = new MutationObserver(redraw);
  for (const root of [document.documentElement, document.body]) {
    observer.observe(root, { attributes: true, attributeFilter });
  }
  dark.addEventListener("change", redraw);
  return () => {
    observer.disconnect();
    dark.removeEventListener("change", redraw);
  };
}
