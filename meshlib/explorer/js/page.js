// On a page without a kernel: the precomputed scenes of an atlas, by native controls.

import { decode, sceneAt } from "./atlas.js";
import { makeControl, makeFilm } from "./controls.js";
import { element } from "./dom.js";
import { parsed, typesetAfter, unpacked } from "./loading.js";
import { makeView } from "./view.js";

/** @import { Atlas, Control, Item, Made, Scene } from "./types" */

const PREFIX = "#explorer-";                         // of links to a state
const TAG = "tag_explorer-";                         // of cells in whose place an explorer comes

/** Puts the controls of an atlas, and the view that follows them, in place of what is in a cell.
 * @type {(atlas: Atlas, cell: Element) => void} */
function makePage(atlas, cell) {
  const { name, controls, initial, film } = atlas.header, view = makeView();
  const made = controls.map((c) => makeControl(c, initial[c.name], `${name}-${c.name}`));
  const frames = makeFilm(film, `${name}-frame`), link = makeLink();
  /** @type {Scene} */
  let scene;
  let atEnd = true;                                  // an adapted mesh stays one when settings change
  const show = () => {
    view.show(scene, Number(frames.input.value));
    link.hash = hashOf(name, controls, made, atEnd ? null : frames.input.value);
  };
  const choose = () => {
    scene = sceneAt(atlas, atlas.index[placeOf(controls, made)]);
    frames.input.max = String(scene.frames - 1);     // where the slider stops, if it was beyond
    if (atEnd) frames.input.value = frames.input.max;
    frames.tell();
    disableIdle(atlas, controls, made);
    show();
  };
  const follow = () => {
    const wanted = wantedIn(location.hash, name);
    if (!wanted) return false;
    controls.forEach((c, k) => made[k].set(wanted.get(c.name)));
    const frame = wanted.get("frame");
    atEnd = frame === null;
    choose();
    if (frame !== null) {
      frames.input.value = frame;
      frames.tell();
      show();
    }
    return true;
  };
  made.forEach(({ input }) => input.addEventListener("input", () => {
    frames.stop();
    choose();
  }));
  frames.input.addEventListener("input", () => {
    atEnd = frames.input.value === frames.input.max;
    show();
  });
  view.tools.append(link);
  const root = element("div", { className: "mesh-page" }, formOf([...made, frames]), view.root);
  cell.replaceChildren(root);                        // before it is drawn, as it has a size only there
  window.addEventListener("hashchange", follow);
  if (follow()) root.scrollIntoView({ behavior: "instant" });
  else choose();
}

/** @type {(parts: { row: HTMLElement }[]) => HTMLFormElement} */
function formOf(parts) {
  const form = element("form", { className: "mesh-controls" }, ...parts.map(({ row }) => row));
  form.setAttribute("aria-label", "Settings of the explorer");
  form.addEventListener("submit", (event) => event.preventDefault());
  return form;
}

/** Number of the settings in the list of all, in which the last control changes fastest; the option
 * of one control may be replaced.
 * @type {(controls: Control[], made: Made[], other?: number | null, value?: number) => number} */
function placeOf(controls, made, other = null, value = 0) {
  return made.reduce((place, { input }, k) =>
    place * controls[k].values.length + (k === other ? value : Number(input.value)), 0);
}

/** Greys out what has no effect: all options of the control lead to the same scene.
 * @type {(atlas: Atlas, controls: Control[], made: Made[]) => void} */
function disableIdle(atlas, controls, made) {
  made.forEach(({ input }, k) => {
    const scenes = controls[k].values.map((_, value) => atlas.index[placeOf(controls, made, k, value)]);
    input.disabled = scenes.every((scene) => scene === scenes[0]);
  });
}

// -- links to a state -------------------------------------------------------------------------

/** The fragment of an address that leads to these settings; no frame means the last one.
 * @type {(name: string, controls: Control[], made: Made[], frame: string | null) => string} */
function hashOf(name, controls, made, frame) {
  const settings = controls.map((c, k) => [c.name, c.values[Number(made[k].input.value)]]);
  if (frame !== null) settings.push(["frame", frame]);
  return `${PREFIX}${name}?${new URLSearchParams(settings)}`;
}

/** The settings in a fragment, if it is about the explorer of that name.
 * @type {(hash: string, name: string) => URLSearchParams | null} */
function wantedIn(hash, name) {
  const start = `${PREFIX}${name}?`;
  return hash.startsWith(start) ? new URLSearchParams(hash.slice(start.length)) : null;
}

/** Leads to the state that is shown; a click also puts the address where it can be pasted.
 * @type {() => HTMLAnchorElement} */
function makeLink() {
  const link = element("a", { textContent: "Link to this state", href: "#" });
  link.addEventListener("click", () => navigator.clipboard?.writeText(link.href).catch(() => {}));
  return link;
}

// -- loading -----------------------------------------------------------------------------------

/** An atlas puts its explorer into the cells with its tag, in place of the picture there.
 * @type {(item: Item) => Promise<void>} */
async function open([name, text]) {
  const atlas = decode(await unpacked(text));
  await parsed;
  document.querySelectorAll(`.${TAG}${name} .cell_output`).forEach((cell) => makePage(atlas, cell));
}

// Scripts of atlases come before or after this one, and leave what they have in a queue.
const waiting = Array.isArray(window.meshExplorers) ? window.meshExplorers : [];
const opened = waiting.map(open);
window.meshExplorers = { push: (item) => opened.push(open(item)) };
typesetAfter(opened);
