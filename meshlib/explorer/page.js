// On a page without a kernel: native controls for the precomputed scenes of an atlas.

const TICK = 350;                                    // milliseconds between frames of a film
const READY = "explorer-ready";                      // told to the page once an explorer is there

// Menu or slider for one control of an atlas; `value` is the number of its option.
function makeControl({ label, kind, texts, values }, initial, id) {
  const said = element("output", { htmlFor: id }), first = Math.max(values.indexOf(initial), 0);
  const input = kind === "menu"
    ? element("select", { id }, ...texts.map((textContent, value) => element("option", { textContent, value })))
    : element("input", { id, type: "range", min: 0, max: texts.length - 1, step: 1 });
  input.value = first;
  const tell = () => {
    said.textContent = texts[input.value];
    input.setAttribute("aria-valuetext", texts[input.value]);
  };
  if (kind !== "menu") {
    tell();
    input.addEventListener("input", tell);
  }
  const caption = element("label", { textContent: label, htmlFor: id });
  return { input, row: element("div", { className: `control ${kind}` }, caption, input, kind === "menu" ? "" : said) };
}

// Slider with a button that plays the film, or with reduced motion goes on by one frame.
function makeFilm(film, id) {
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const { input, row } = makeControl({ label: film || "mesh", kind: "slider", texts: ["0"], values: ["0"] }, "0", id);
  const button = element("button", { type: "button", className: "play" }), said = row.querySelector("output");
  let timer = null;
  const name = () => {
    button.textContent = timer ? "Pause" : still.matches ? "Next" : "Play";
  };
  const go = (frame) => {
    input.value = frame;
    input.dispatchEvent(new Event("input", { bubbles: true }));
  };
  const stop = () => (clearInterval(timer), timer = null, name());
  const advance = () => (Number(input.value) < Number(input.max) ? go(Number(input.value) + 1) : stop());
  button.addEventListener("click", () => {
    if (timer) return stop();
    if (Number(input.value) === Number(input.max)) go(0);
    if (still.matches) return advance();
    timer = setInterval(advance, TICK);
    name();
  });
  still.addEventListener("change", stop);
  name();
  const tell = () => {
    said.textContent = film ? `${input.value} of ${input.max}` : ["start", "adapted"][input.value];
    input.setAttribute("aria-valuetext", said.textContent);
  };
  input.addEventListener("input", tell);
  if (film) {
    row.classList.add("film");
    row.insertBefore(button, input);
  }
  return { input, row, stop, tell };
}

// All controls of an atlas, the view below them, and what joins them.
function makePage(atlas) {
  const { name, controls, initial, film } = atlas.header, view = makeView();
  const made = controls.map((c) => makeControl(c, initial[c.name], `${name}-${c.name}`));
  const frames = makeFilm(film, `${name}-frame`);
  const form = element("form", { className: "mesh-controls" }, ...made.map((m) => m.row), frames.row);
  form.setAttribute("aria-label", "Settings of the explorer");
  form.addEventListener("submit", (event) => event.preventDefault());
  let scene, atEnd = true;                           // an adapted mesh stays one when settings change
  const choose = () => {
    const place = made.reduce((sum, { input }, k) => sum * controls[k].values.length + Number(input.value), 0);
    scene = sceneAt(atlas, atlas.index[place]);
    frames.input.max = scene.frames - 1;
    frames.input.value = atEnd ? scene.frames - 1 : Math.min(Number(frames.input.value), scene.frames - 1);
    frames.tell();
    view.show(scene, Number(frames.input.value));
  };
  made.forEach(({ input }) => input.addEventListener("input", () => (frames.stop(), choose())));
  frames.input.addEventListener("input", () => {
    atEnd = frames.input.value === frames.input.max;
    view.show(scene, Number(frames.input.value));
  });
  choose();
  return element("div", { className: "mesh-page" }, form, view.root);
}

async function unpacked(text) {
  const packed = atob(text), bytes = new Uint8Array(packed.length);
  for (let k = 0; k < packed.length; k++) bytes[k] = packed.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

// An atlas puts its explorer into every cell with its tag, in place of the picture there.
async function open(name, text) {
  const atlas = decode(await unpacked(text));
  for (const cell of document.querySelectorAll(`.tag_explorer-${name} .cell_output`)) {
    const page = makePage(atlas);
    cell.replaceChildren(page);
    page.dispatchEvent(new Event(READY, { bubbles: true }));
  }
}

// The atlases of the explorers on this page, from files beside this script.
function load(script) {
  const tags = Array.from(document.querySelectorAll("[class*=tag_explorer-]"),
    (cell) => Array.from(cell.classList).find((tag) => tag.startsWith("tag_explorer-")));
  for (const tag of new Set(tags)) {
    const name = tag.slice("tag_explorer-".length);
    document.head.append(element("script", { src: new URL(`explorers/${name}.js`, script) }));
  }
}

window.meshExplorers = { open };
load(document.currentScript.src);
