// The page: panels, colour bars and table, and what happens when state, size or theme change.

const PANELS = [
  { caption: "mesh over the interpolant", draw: drawMesh, table: VIRIDIS, ends: (s) => s.limits },
  { caption: "lines of constant value", draw: drawLines, table: VIRIDIS, ends: (s) => s.limits },
  { caption: "error |u − u\u2095|", draw: drawError, table: CIVIDIS, ends: (s) => [0, s.worst] },
  { caption: "surface, turned by dragging or arrow keys", draw: drawSurface, table: VIRIDIS,
    ends: (s) => s.limits, turns: true },
];

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function panel({ caption, table, turns }) {
  const canvas = element("canvas", { className: turns ? "turns" : "", tabIndex: turns ? 0 : -1 });
  canvas.setAttribute("role", "img");
  const bar = element("span", { className: "bar" });
  bar.style.background = `linear-gradient(to right, ${table.join(", ")})`;
  const scale = element("div", { className: "scale" }, element("span"), bar, element("span"));
  const below = element("figcaption", { textContent: caption });
  const figure = element("figure", {}, canvas, scale, below);
  return { figure, canvas, ends: [scale.firstChild, scale.lastChild] };
}

function fillTable(table, rows, shown) {
  const cells = (texts) => texts.map((text, k) =>
    element("td", { textContent: text, className: k === shown ? "shown" : "" }));
  const heads = ["measure", "start", "adapted"].map((text, k) =>
    element("th", { textContent: text, scope: "col", className: k === shown + 1 ? "shown" : "" }));
  const body = rows.map(([label, ...texts]) =>
    element("tr", {}, element("th", { textContent: label, scope: "row" }), ...cells(texts)));
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
  const keys = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0],
                 ArrowUp: [0, -STEP], ArrowDown: [0, STEP] };
  canvas.addEventListener("keydown", (event) => {
    if (!(event.key in keys)) return;
    event.preventDefault();
    turn(...keys[event.key]);
  });
}

function watchTheme(redraw) {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const attributeFilter = ["data-theme", "data-jp-theme-name"];
  const observer = new MutationObserver(redraw);
  for (const root of [document.documentElement, document.body]) {
    observer.observe(root, { attributes: true, attributeFilter });
  }
  dark.addEventListener("change", redraw);
  return () => (observer.disconnect(), dark.removeEventListener("change", redraw));
}

// Three digits of the larger end; the smaller one may be 1e-9 and mean 0.
function short(value, [low, high]) {
  const digits = 2 - Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high))));
  return String(Number(value.toFixed(Math.min(Math.max(digits, 0), 9))) + 0);
}

function build() {
  const panels = PANELS.map(panel), table = element("table");
  const title = element("p", { className: "title" });
  title.setAttribute("role", "status");  // read aloud
  const grid = element("div", { className: "panels" }, ...panels.map((p) => p.figure), table);
  const root = element("div", { className: "mesh-explorer" }, title, grid);
  return { root, title, panels, table };
}

function describe({ panels, table, title }, state, stage, shown) {
  title.textContent = state.title;
  fillTable(table, state.rows, shown);
  panels.forEach(({ canvas, ends }, k) => {
    PANELS[k].ends(state).forEach((value, n, both) => (ends[n].textContent = short(value, both)));
    canvas.setAttribute("aria-label", `${PANELS[k].caption}, ${stage.name} mesh of `
      + `${stage.points.length} nodes and ${stage.triangles.length} elements`);
  });
}

function render({ model, el }) {
  const page = build(), eye = { ...EYE };
  let state, stages, shown;  // what the model holds, decoded

  const draw = (k) => {
    const { canvas } = page.panels[k], ink = getComputedStyle(page.root).color;
    if (state && canvas.clientWidth) PANELS[k].draw(canvas, stages[shown], state, ink, eye);
  };
  const drawAll = () => PANELS.forEach((_, k) => draw(k));
  const load = () => {
    shown = model.get("shown");
    if (!model.get("state").stages) return;
    state = model.get("state");
    stages = state.stages.map(decode);
    describe(page, state, stages[shown], shown);
    drawAll();
  };

  page.panels.forEach(({ canvas }, k) => {
    if (PANELS[k].turns) makeTurnable(canvas, eye, () => draw(k));
  });
  const sizes = new ResizeObserver(drawAll), forgetTheme = watchTheme(drawAll);
  sizes.observe(page.root);
  el.append(page.root);
  model.on("change:state change:shown", load);
  load();
  return () => (sizes.disconnect(), forgetTheme(), model.off("change:state change:shown", load));
}

export default { render };
