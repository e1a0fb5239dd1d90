// On a page without a kernel: the precomputed scenes of an atlas, by native controls.

const PREFIX = "#explorer-", TAG = "tag_explorer-";

// All controls of an atlas, the view below them, and what joins them.
function makePage(atlas) {
  const { name, controls, initial, film } = atlas.header, view = makeView();
  const made = controls.map((c) => makeControl(c, initial[c.name], `${name}-${c.name}`));
  const frames = makeFilm(film, `${name}-frame`), link = makeLink();
  let scene, atEnd = true;                           // an adapted mesh stays one when settings change
  const show = () => {
    view.show(scene, Number(frames.input.value));
    link.hash = hashOf(name, controls, made, atEnd ? null : frames.input.value);
  };
  const choose = () => {
    scene = sceneAt(atlas, atlas.index[placeOf(controls, made)]);
    frames.input.max = scene.frames - 1;             // where the slider stops, if it was beyond
    if (atEnd) frames.input.value = scene.frames - 1;
    frames.tell();
    disableIdle(atlas, controls, made);
    show();
  };
  made.forEach(({ input }) => input.addEventListener("input", () => (frames.stop(), choose())));
  frames.input.addEventListener("input", () => (atEnd = frames.input.value === frames.input.max, show()));
  const follow = () => {
    const wanted = wantedIn(location.hash, name);
    if (!wanted) return false;
    controls.forEach((c, k) => made[k].set(wanted.get(c.name)));
    atEnd = !wanted.has("frame");
    choose();
    if (!atEnd) (frames.input.value = wanted.get("frame"), frames.tell(), show());
    return true;
  };
  choose();
  window.addEventListener("hashchange", follow);
  view.tools.append(link);
  return { root: element("div", { className: "mesh-page" }, formOf([...made, frames]), view.root), follow };
}

function formOf(parts) {
  const form = element("form", { className: "mesh-controls" }, ...parts.map(({ row }) => row));
  form.setAttribute("aria-label", "Settings of the explorer");
  form.addEventListener("submit", (event) => event.preventDefault());
  return form;
}

// The place of the settings among all, the last control the fastest; one of them may differ.
function placeOf(controls, made, other = null, value = 0) {
  return made.reduce((place, { input }, k) =>
    place * controls[k].values.length + (k === other ? value : Number(input.value)), 0);
}

// Greys out what has no effect: all options of the control lead to the same scene.
function disableIdle(atlas, controls, made) {
  made.forEach(({ input }, k) => {
    const scenes = controls[k].values.map((_, value) => atlas.index[placeOf(controls, made, k, value)]);
    input.disabled = scenes.every((scene) => scene === scenes[0]);
  });
}

// -- links to a state -------------------------------------------------------------------------

function hashOf(name, controls, made, frame) {
  const settings = controls.map((c, k) => [c.name, c.values[made[k].input.value]]);
  if (frame !== null) settings.push(["frame", frame]);
  return `${PREFIX}${name}?${new URLSearchParams(settings)}`;
}

function wantedIn(hash, name) {
  const start = `${PREFIX}${name}?`;
  return hash.startsWith(start) ? new URLSearchParams(hash.slice(start.length)) : null;
}

// Leads to the state that is shown; a click also puts the address where it can be pasted.
function makeLink() {
  const link = element("a", { textContent: "Link to this state", href: "#" });
  link.addEventListener("click", () => navigator.clipboard?.writeText(link.href).catch(() => {}));
  return link;
}

// -- loading -----------------------------------------------------------------------------------

async function unpacked(text) {
  const packed = atob(text), bytes = new Uint8Array(packed.length);
  for (let k = 0; k < packed.length; k++) bytes[k] = packed.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

// An atlas puts its explorer into the cell with its tag, in place of the picture there.
async function open(name, text) {
  const atlas = decode(await unpacked(text));
  for (const cell of document.querySelectorAll(`.${TAG}${name} .cell_output`)) {
    const { root, follow } = makePage(atlas);
    cell.replaceChildren(root);
    if (follow()) root.scrollIntoView();
  }
}

// The atlases of the explorers on this page, from files beside this script.
function load(script) {
  const tags = Array.from(document.querySelectorAll(`[class*=${TAG}]`),
    (cell) => Array.from(cell.classList).find((tag) => tag.startsWith(TAG)));
  for (const tag of new Set(tags)) {
    const src = new URL(`explorers/${tag.slice(TAG.length)}.js`, script);
    document.head.append(element("script", { src }));
  }
}

window.meshExplorers = { open };
load(document.currentScript.src);
