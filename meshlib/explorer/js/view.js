// The view: what happens when scene, frame, size or theme change, and when it is pointed at.

// A view of one scene at a time; `show` draws a frame, `stop` ends it.
function makeView() {
  const page = layout(), eye = { ...EYE };
  let shown, target = {};                            // all that the panels draw, and what is pointed at
  const placed = (k) => {
    const { canvas } = page.panels[k], side = canvas.clientWidth, ink = getComputedStyle(page.root).color;
    return shown && side ? { ...shown, ink, side, place: flat(shown.box, side), eye } : null;
  };
  const draw = (k) => {
    const all = placed(k);
    if (!all) return;
    const pen = canvasPen(page.panels[k].canvas);
    PANELS[k].draw(pen, all);
    if (!PANELS[k].turns) drawTarget(pen, all, target);
  };
  const drawAll = () => PANELS.forEach((_, k) => draw(k));
  const tell = (pointedAt, text) => {
    target = pointedAt;
    page.readout.textContent = text || HINT;
    drawAll();
  };
  const show = (scene, frame) => {
    [shown, target] = [prepared(scene, frame, shown), {}];
    describe(page, shown);
    drawAll();
  };
  page.panels.forEach(({ canvas }, k) => (PANELS[k].turns ? makeTurnable(canvas, eye, () => draw(k))
                                                           : makeInspectable(canvas, () => placed(k), tell)));
  for (const [name, save] of [["SVG", saveSvg], ["PNG", savePng]]) {
    const button = element("button", { type: "button", textContent: `Save as ${name}` });
    button.addEventListener("click", () => save(svgOf({ ...shown, eye }, headingOf(shown)), fileName(shown)));
    page.tools.append(button);
  }
  const sizes = new ResizeObserver(drawAll), forgetTheme = watchTheme(drawAll);
  page.panels.forEach(({ canvas }) => sizes.observe(canvas));
  page.root.shown = () => shown;                     // for other scripts, and tests
  return { root: page.root, tools: page.tools, show, stop: () => (sizes.disconnect(), forgetTheme()) };
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
  let limits = [Math.min(...scene.truth), Math.max(...scene.truth)];
  if (limits[0] === limits[1]) limits = [limits[0] - 0.5, limits[1] + 0.5];
  return { box, worst, limits, unit: normalised(box, limits), atStart: numbersOf(start, errors[0], box) };
}

function stageName({ scene, frame }) {
  const { film } = scene.atlas.header;
  return !frame ? "start" : film ? `${film} ${frame}` : "adapted";
}

const headingOf = (shown) => `${shown.scene.title}: ${stageName(shown)}`;
const fileName = (shown) => headingOf(shown).replace(/[^\p{L}\p{N}]+/gu, "-");

function describe({ panels, table, title, note, readout }, shown) {
  const { scene, frame, mesh, numbers, atStart } = shown, { film } = scene.atlas.header;
  const name = stageName(shown);
  readout.textContent = HINT;
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
