// The parts of the view: panels with colour bars, the table, and what is said of a frame.

const STEP = 5 * DEGREE;                             // of turning by an arrow key
const HINT = "Point at an edge or an element, or use the arrow keys, to see its cost.";
const EYE = { azimuth: -60 * DEGREE, elevation: 32 * DEGREE };
const PANELS = [
  { name: "mesh", caption: "mesh over the interpolant", draw: drawMesh, table: VIRIDIS,
    ends: (s) => s.limits },
  { name: "lines", caption: "lines of constant value", draw: drawLines, table: VIRIDIS,
    ends: (s) => s.limits },
  { name: "error", caption: "error |u − u\u2095|", draw: drawError, table: CIVIDIS,
    ends: (s) => [0, s.worst] },
  { name: "surface", caption: "surface: drag or use arrow keys", draw: drawSurface, table: VIRIDIS,
    ends: (s) => s.limits, turns: true },
];

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

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

// Rows of label and number at the start and in the frame shown, whose heading is given.
function fillTable(table, rows, heading) {
  const heads = ["measure", "start", heading].map((textContent) =>
    element("th", { textContent, scope: "col" }));
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
  let last = null;                                   // of a finger no browser tells how far it moved
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    last = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointermove", ({ buttons, clientX, clientY }) => {
    if (!buttons || !last) return;
    turn((clientX - last[0]) * DEGREE, (clientY - last[1]) * DEGREE);
    last = [clientX, clientY];
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
  const readout = element("p", { className: "readout" });
  for (const said of [title, readout]) said.setAttribute("role", "status");  // read aloud
  const grid = element("div", { className: "panels" }, ...panels.map((p) => p.figure), table);
  const tools = element("div", { className: "tools" });
  const root = element("div", { className: "mesh-explorer" }, title, note, grid, readout, tools);
  return { root, title, note, panels, table, readout, tools };
}

// What was tried in this frame, with the local cost before and after.
function triedText(mesh, scene, frame) {
  const { accepted } = mesh.tried, [old, other] = accepted ? ["dashed", "solid"] : ["solid", "dashed"];
  const costs = triedCosts(mesh, scene).map((cost) => cost.toPrecision(4));
  const where = scene.on === "edge" ? "five edges" : "two elements";
  return `Try ${frame}: the ${old} edge against the ${other} one. Cost of the ${where}: ${costs[0]} before, `
    + `${costs[1]} after. ${accepted ? "Swapped." : "Kept."}`;
}

