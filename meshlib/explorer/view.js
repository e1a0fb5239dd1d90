// The view: panels, colour bars and table, and what happens when scene, size or theme change.

const STEP = 5 * DEGREE;                             // of turning by an arrow key
const EYE = { azimuth: -60 * DEGREE, elevation: 32 * DEGREE };
const PANELS = [
  { name: "mesh", caption: "mesh over the interpolant", draw: drawMesh, table: VIRIDIS, ends: (s) => s.limits },
  { name: "lines", caption: "lines of constant value", draw: drawLines, table: VIRIDIS, ends: (s) => s.limits },
  { name: "error", caption: "error |u − u\u2095|", draw: drawError, table: CIVIDIS, ends: (s) => [0, s.worst] },
  { name: "surface", caption: "surface, turned by dragging or arrow keys", draw: drawSurface, table: VIRIDIS,
    ends: (s) => s.limits, turns: true },
];

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function panel({ name, caption, table, turns }) {
  const canvas = element("canvas", { className: turns ? "turns" : "", tabIndex: turns ? 0 : -1 });
  canvas.setAttribute("role", "img");
  const bar = element("span", { className: "bar" });
  bar.style.background = `linear-gradient(to right, ${table.join(", ")})`;
  const scale = element("div", { className: "scale" }, element("span"), bar, element("span"));
  const below = element("figcaption", { textContent: caption });
  const figure = element("figure", { className: name }, canvas, scale, below);
  return { figure, canvas, ends: [scale.firstChild, scale.lastChild] };
}

// Rows of label and number at the start and in the frame shown, whose heading is given.
function fillTable(table, rows, heading) {
  const heads = ["measure", "start", heading].map((text) => element("th", { textContent: text, scope: "col" }));
  const body = rows.map(([label, ...texts]) =>
    element("tr", {}, element("th", { textContent: label, scope: "row" }),
            ...texts.map((textContent) => element("td", { textContent }))));
  table.replaceChildren(element("caption", { textContent: "Quality" }),
    element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...body));
}

function makeTurnable(canvas, eye, redraw) {
  const turn = (right, up) => {
    eye.azimuth -= right;
    eye.elevation = Math.min(Math.max(eye.elevation + up, 0), 90 * DEGREE);
    redraw();
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons) turn(event.movementX * DEGREE, event.movementY * DEGREE);
  });
  const keys = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] };
  canvas.addEventListener("keydown", (event) => {
    if (!(event.key in keys)) return;
    event.preventDefault();
    turn(...keys[event.key]);
  });
}

function watchTheme(redraw) {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const attributeFilter = ["data-theme", "data-jp-theme-name"], observer = new MutationObserver(redraw);
  for (const root of [document.documentElement, document.body]) {
    observer.observe(root, { attributes: true, attributeFilter });
  }
  dark.addEventListener("change", redraw);
  return () => (observer.disconnect(), dark.removeEventListener("change", redraw));
}

// Three digits of the larger end; the smaller one may be 1e-9 and mean 0.
function short(value, [low, high]) {
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (size < 1e-3) return value ? value.toExponential(1) : "0";
  const digits = 2 - Math.floor(Math.log10(size));
  return String(Number(value.toFixed(Math.max(digits, 0))) + 0);
}

function layout() {
  const panels = PANELS.map(panel), table = element("table");
  const title = element("p", { className: "title" }), note = element("p", { className: "note" });
  title.setAttribute("role", "status");              // read aloud
  const grid = element("div", { className: "panels" }, ...panels.map((p) => p.figure), table);
  return { root: element("div", { className: "mesh-explorer" }, title, note, grid), title, note, panels, table };
}

// What was tried in this frame, with the local cost before and after.
function triedText(mesh, scene, frame) {
  const { accepted } = mesh.tried, [old, other] = accepted ? ["dashed", "solid"] : ["solid", "dashed"];
  const costs = triedCosts(mesh, scene).map((cost) => cost.toPrecision(4));
  const where = scene.on === "edge" ? "five edges" : "two elements";
  return `Try ${frame}: the ${old} edge against the ${other} one. Cost of the ${where}: ${costs[0]} before, `
    + `${costs[1]} after. ${accepted ? "Swapped." : "Kept."}`;
}

// A view of one scene at a time; `show` draws a frame, `stop` ends it.
function makeView() {
  const page = layout(), eye = { ...EYE };
  let shown;                                         // all that the panels draw
  const draw = (k) => {
    const { canvas } = page.panels[k], side = canvas.clientWidth;
    if (!shown || !side) return;
    const ink = getComputedStyle(page.root).color, place = flat(shown.box, side);
    PANELS[k].draw(canvasPen(canvas), { ...shown, ink, place, eye, side });
  };
  const drawAll = () => PANELS.forEach((_, k) => draw(k));
  const show = (scene, frame) => {
    shown = prepared(scene, frame, shown);
    describe(page, shown);
    drawAll();
  };
  page.panels.forEach(({ canvas }, k) => PANELS[k].turns && makeTurnable(canvas, eye, () => draw(k)));
  const sizes = new ResizeObserver(drawAll), forgetTheme = watchTheme(drawAll);
  page.panels.forEach(({ canvas }) => sizes.observe(canvas));
  page.root.shown = () => shown;                     // for other scripts, and tests
  return { root: page.root, show, stop: () => (sizes.disconnect(), forgetTheme()) };
}

function prepared(scene, frame, before) {
  const known = before && before.scene === scene ? before.common : commonOf(scene);
  const mesh = meshOf(scene, frameAt(scene, frame)), error = errorOf(mesh, scene.truth, known.box);
  return { ...known, common: known, scene, frame, mesh, error, numbers: numbersOf(mesh, error, known.box) };
}

// What all frames of a scene share, so that colours mean the same in each.
function commonOf(scene) {
  const start = meshOf(scene, frameAt(scene, 0)), last = meshOf(scene, frameAt(scene, scene.frames - 1));
  const box = boxOf(start), errors = [start, last].map((mesh) => errorOf(mesh, scene.truth, box));
  const worst = Math.max(...errors.map((error) => error.reduce((m, e) => Math.max(m, e), 0)));
  let limits = scene.truth.reduce(([low, high], u) => [Math.min(low, u), Math.max(high, u)], [Infinity, -Infinity]);
  if (limits[0] === limits[1]) limits = [limits[0] - 0.5, limits[1] + 0.5];
  return { box, worst, limits, unit: normalised(box, limits), atStart: numbersOf(start, errors[0], box) };
}

function describe({ panels, table, title, note }, shown) {
  const { scene, frame, mesh, numbers, atStart } = shown, film = scene.atlas.header.film;
  const name = !frame ? "start" : film ? `${film} ${frame}` : "adapted";
  title.textContent = scene.title;
  note.hidden = !film;
  note.classList.toggle("long", scene.traced);
  note.textContent = !frame ? "The start mesh." : mesh.tried ? triedText(mesh, scene, frame)
    : `After ${film} ${frame}.`;
  fillTable(table, numbers.map(([label, , text], k) => [label, atStart[k][2], text]), name);
  panels.forEach(({ canvas, ends }, k) => {
    PANELS[k].ends(shown).forEach((value, n, both) => (ends[n].textContent = short(value, both)));
    canvas.setAttribute("aria-label",
      `${PANELS[k].caption}, ${name}: ${mesh.nodes.length} nodes and ${mesh.size} elements`);
  });
}
