// The view: what happens when scene, frame, size or theme change, and when it is pointed at.

import { frameAt } from "./atlas.js";
import { element } from "./dom.js";
import { flat } from "./drawing.js";
import { drawTarget, makeInspectable } from "./inspection.js";
import { errorOf, largestOf, numbersOf } from "./measures.js";
import { boxOf, meshOf } from "./mesh.js";
import {
  EYE, fillTable, HINT, layout, makeTurnable, PANELS, short, triedText, watchTheme,
} from "./panels.js";
import { canvasPen } from "./pens.js";
import { savePng, saveSvg, svgOf } from "./saving.js";
import { normalised } from "./surface.js";

/** @import { Common, Layout, Pair, Prepared, Scene, Shown, Target, View, Visible } from "./types" */

/** A view of one scene at a time; `show` draws a frame, `stop` ends it.
 * @type {() => View} */
export function makeView() {
  const page = layout(), eye = { ...EYE };
  /** @type {Prepared | undefined} */
  let prepared;
  /** @type {Target} */
  let target = {};                                   // what is pointed at
  /** @type {(k: number) => Shown | null} */
  const shownOn = (k) => {
    const side = page.panels[k].canvas.clientWidth, ink = getComputedStyle(page.root).color;
    return prepared && side ? { ...prepared, ink, side, place: flat(prepared.box, side), eye } : null;
  };
  const draw = (/** @type {number} */ k) => {
    const shown = shownOn(k);
    if (!shown) return;
    const pen = canvasPen(page.panels[k].canvas);
    PANELS[k].draw(pen, shown);
    if (!PANELS[k].turns) drawTarget(pen, shown, target);
  };
  const drawAll = () => PANELS.forEach((_, k) => draw(k));
  const tell = (/** @type {Target} */ pointedAt, /** @type {string} */ text) => {
    target = pointedAt;
    page.readout.textContent = text || HINT;
    drawAll();
  };
  const show = (/** @type {Scene} */ scene, /** @type {number} */ frame) => {
    [prepared, target] = [prepare(scene, frame, prepared), {}];
    describe(page, prepared);
    drawAll();
  };
  page.panels.forEach(({ canvas }, k) => {
    if (PANELS[k].turns) makeTurnable(canvas, eye, () => draw(k));
    else makeInspectable(canvas, () => shownOn(k), tell);
  });
  page.tools.append(...saveButtons(() => prepared && { ...prepared, eye }));
  const sizes = new ResizeObserver(drawAll), forgetTheme = watchTheme(drawAll);
  page.panels.forEach(({ canvas }) => sizes.observe(canvas));
  Object.assign(page.root, { shown: () => prepared }); // for other scripts, and tests
  const stop = () => {
    sizes.disconnect();
    forgetTheme();
  };
  return { root: page.root, tools: page.tools, show, stop };
}

/** Buttons that save what is seen.
 * @type {(visible: () => Visible | undefined) => HTMLButtonElement[]} */
function saveButtons(visible) {
  return Object.entries({ SVG: saveSvg, PNG: savePng }).map(([name, save]) => {
    const button = element("button", { type: "button", textContent: `Save as ${name}` });
    button.addEventListener("click", () => {
      const shown = visible();
      if (shown) save(svgOf(shown, headingOf(shown)), fileName(shown));
    });
    return button;
  });
}

// -- what a frame has to show ------------------------------------------------------------------

/** A frame with all that is computed from it; what its scene has in common is kept from the frame before.
 * @type {(scene: Scene, frame: number, before?: Prepared) => Prepared} */
function prepare(scene, frame, before) {
  const common = before && before.scene === scene ? before.common : commonOf(scene);
  const mesh = meshOf(scene, frameAt(scene, frame)), error = errorOf(mesh, scene.truth, common.box);
  return { ...common, common, scene, frame, mesh, error, numbers: numbersOf(mesh, error, common.box) };
}

/** What all frames of a scene share, so that colours mean the same in each.
 * @type {(scene: Scene) => Common} */
function commonOf(scene) {
  const start = meshOf(scene, frameAt(scene, 0)), last = meshOf(scene, frameAt(scene, scene.frames - 1));
  const box = boxOf(start), errors = [start, last].map((mesh) => errorOf(mesh, scene.truth, box));
  const limits = limitsOf(scene.truth), worst = Math.max(...errors.map(largestOf));
  return { box, worst, limits, unit: normalised(box, limits), atStart: numbersOf(start, errors[0], box) };
}

/** Least and largest value of the function; a constant one lies in the middle of an interval of length 1.
 * @type {(truth: Float32Array) => Pair} */
function limitsOf(truth) {
  const low = Math.min(...truth), high = Math.max(...truth);
  return low === high ? [low - 0.5, high + 0.5] : [low, high];
}

// -- what is said of it ------------------------------------------------------------------------

/** @type {(shown: Prepared) => string} */
function stageName({ scene, frame }) {
  const { film } = scene.atlas.header;
  return !frame ? "start" : film ? `${film} ${frame}` : "adapted";
}

/** @type {(shown: Prepared) => string} */
const headingOf = (shown) => `${shown.scene.title}: ${stageName(shown)}`;

/** @type {(shown: Prepared) => string} */
const fileName = (shown) => headingOf(shown).replace(/[^\p{L}\p{N}]+/gu, "-");

/** Writes title, note, table and the ends of the colour bars.
 * @type {(page: Layout, shown: Prepared) => void} */
function describe({ panels, table, title, note, readout }, shown) {
  const { scene, mesh, numbers, atStart } = shown, name = stageName(shown);
  readout.textContent = HINT;
  title.textContent = scene.title;
  note.hidden = !scene.atlas.header.film;
  note.classList.toggle("long", scene.traced);
  note.textContent = noteOf(shown);
  fillTable(table, numbers.map(([label, , text], k) => [label, atStart[k][2], text]), name);
  panels.forEach(({ canvas, ends }, k) => {
    const [low, high] = PANELS[k].ends(shown);
    ends[0].textContent = short(low, [low, high]);
    ends[1].textContent = short(high, [low, high]);
    canvas.setAttribute("aria-label",
      `${PANELS[k].caption}, ${name}: ${mesh.nodes.length} nodes and ${mesh.size} elements`);
  });
}

/** What was done in a frame of a film.
 * @type {(shown: Prepared) => string} */
function noteOf({ scene, frame, mesh }) {
  if (!frame) return "The start mesh.";
  if (!mesh.tried) return `After ${scene.atlas.header.film} ${frame}.`;
  return triedText(mesh, mesh.tried, scene, frame);
}
