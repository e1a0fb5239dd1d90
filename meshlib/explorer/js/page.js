// On a page without a kernel: the precomputed scenes of an atlas, by native controls.

const PREFIX = "#explorer-", TAG = "tag_explorer-";
const GROUP = 60;                                    // formulas at a time

// All controls of an atlas, the view below them, and what joins them, in place of what is in the cell.
function makePage(atlas, cell) {
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
  view.tools.append(link);
  const root = element("div", { className: "mesh-page" }, formOf([...made, frames]), view.root);
  cell.replaceChildren(root);                        // before it is drawn, as it has a size only there
  window.addEventListener("hashchange", follow);
  if (follow()) root.scrollIntoView({ behavior: "instant" });
  else choose();
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

// The stream is written and read here, which takes no turn of the event loop: a blob or a
// response in its place would wait behind all other scripts of the page.
async function unpacked(text) {
  const { readable, writable } = new DecompressionStream("gzip"), writer = writable.getWriter();
  const reader = readable.getReader(), parts = [];
  writer.write(bytesOf(atob(text)));
  writer.close();
  for (let read = await reader.read(); !read.done; read = await reader.read()) parts.push(read.value);
  return joined(parts).buffer;
}

function bytesOf(packed) {
  const bytes = new Uint8Array(packed.length);       // by a loop: Uint8Array.from takes seven times as long
  for (let k = 0; k < packed.length; k++) bytes[k] = packed.charCodeAt(k);
  return bytes;
}

function joined(parts) {
  const whole = new Uint8Array(sum(parts.map((part) => part.length)));
  parts.reduce((start, part) => (whole.set(part, start), start + part.length), 0);
  return whole;
}

// Once all cells are there, before scripts that wait for that, MathJax among them.
const parsed = new Promise((resolve) => {
  const check = () => document.readyState !== "loading" && resolve();
  document.addEventListener("readystatechange", check);
  check();
});

// An atlas puts its explorer into the cell with its tag, in place of the picture there.
async function open([name, text]) {
  const atlas = decode(await unpacked(text));
  await parsed;
  for (const cell of document.querySelectorAll(`.${TAG}${name} .cell_output`)) {
    makePage(atlas, cell);
  }
}

// Scripts of atlases come before or after this one, and leave what they have in a queue.
const opened = (window.meshExplorers || []).map(open);
window.meshExplorers = { push: (item) => opened.push(open(item)) };

// MathJax, which keeps a page busy for long, begins once the explorers can be seen, and takes
// one group of formulas after the other, so that controls answer in between.
parsed.then(() => {
  const settings = window.MathJax;
  if (!settings || settings.version) return;         // it is not wanted, or has begun
  settings.startup = { pageReady: async () => {
    await Promise.allSettled(opened).then(pause);
    const formulas = Array.from(document.querySelectorAll(".math"));
    for (let k = 0; k < formulas.length; k += GROUP) {
      await window.MathJax.typesetPromise(formulas.slice(k, k + GROUP)).then(pause);
    }
    return window.MathJax.startup.defaultPageReady(); // what is elsewhere
  } };
});

// Until the page has been painted and what waits is done; nothing is painted while it is hidden.
const pause = () => new Promise((resolve) => {
  if (document.hidden) setTimeout(resolve);
  else requestAnimationFrame(() => setTimeout(resolve));
});
