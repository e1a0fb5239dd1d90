// The edge or element under the pointer, or chosen by arrow keys, and its cost.

const NEAR = 7;                                      // pixels from an edge that are on it
const DIGITS = 4;

// The edge of a mesh nearest to a place on the page, if it is near; else the element there.
function targetAt({ mesh, place }, px, py) {
  let edge = -1, least = NEAR;
  for (let e = 0; e < mesh.edges; e++) {
    const distance = toSegment(px, py, ...endsOf(mesh, place, e));
    if (distance < least) [edge, least] = [e, distance];
  }
  if (edge >= 0) return { edge };
  const [x, y] = place.back(px, py);
  for (let t = 0; t < mesh.size; t++) if (isInside(mesh, t, x, y)) return { element: t };
  return {};
}

function endsOf({ x, y, ends }, place, e) {
  const [p, q] = [ends[2 * e], ends[2 * e + 1]];
  return [place.px(x[p]), place.py(y[p]), place.px(x[q]), place.py(y[q])];
}

function toSegment(px, py, ax, ay, bx, by) {
  const [ux, uy] = [bx - ax, by - ay], along = ((px - ax) * ux + (py - ay) * uy) / (ux * ux + uy * uy);
  const share = Math.min(Math.max(along, 0), 1);
  return Math.hypot(px - ax - share * ux, py - ay - share * uy);
}

function isInside({ x, y, elements }, t, px, py) {
  return [0, 1, 2].every((k) => {
    const p = elements[3 * t + k], q = elements[3 * t + (k + 1) % 3];
    return (x[q] - x[p]) * (py - y[p]) >= (px - x[p]) * (y[q] - y[p]);
  });
}

// What there is to say of a target; costs of edges are averaged over the sides of an element.
function textOf({ mesh, scene }, { edge, element: t }) {
  const { cost, on } = scene, name = cost.includes("-") ? cost : cost.toUpperCase();
  const digits = (value) => Number(value.toPrecision(DIGITS));
  if (edge !== undefined) {
    const at = [0, 1].map((k) => pointText(mesh, mesh.ends[2 * edge + k])).join(" to ");
    if (mesh.sides[2 * edge + 1] < 0) return `Edge ${at}, on the boundary.`;
    const beside = on === "edge" ? [] : elementsAt(mesh, edge).map((s) => digits(ELEMENT_COSTS[cost](mesh, s)));
    return `Edge ${at}: ` + (on === "edge" ? `${name} ${digits(edgeCost(mesh, cost, edge))}.`
                                           : `${name} of its elements ${beside.join(" and ")}.`);
  }
  if (t === undefined) return "";
  const largest = digits(Math.max(...anglesOf(mesh, t)) / DEGREE);
  return `Element with an angle of ${largest}°: `
    + (on === "edge" ? `mean ${name} of its edges ${digits(meanOfSides(mesh, cost, t))}.`
                     : `${name} ${digits(ELEMENT_COSTS[cost](mesh, t))}.`);
}

const pointText = ({ x, y }, n) => `(${x[n].toFixed(2)}, ${y[n].toFixed(2)})`;
const elementsAt = ({ sides }, e) => [sides[2 * e], sides[2 * e + 1]];

function meanOfSides(mesh, cost, t) {
  let total = 0;
  for (let e = 0; e < mesh.edges; e++) if (elementsAt(mesh, e).includes(t)) total += edgeCost(mesh, cost, e);
  return total / 3;
}

function drawTarget(pen, shown, { edge, element: t }) {
  const { mesh } = shown, lines = [];
  if (edge !== undefined) lines.push([mesh.ends[2 * edge], mesh.ends[2 * edge + 1]]);
  if (t !== undefined) {
    const [p, q, r] = cornersOf(mesh, t);
    lines.push([p, q], [q, r], [r, p]);
  }
  strokeEdges(pen, shown, "white", 6, lines);
  strokeEdges(pen, shown, TRIED, 3.5, lines);
}

// Has a canvas tell what it shows: `current` gives the mesh on it, `tell` takes target and text.
function makeInspectable(canvas, current, tell) {
  let last = "", edge = -1;
  const say = (target) => {
    const text = current() ? textOf(current(), target) : "";
    if (text !== last) tell(target, last = text);
  };
  canvas.addEventListener("pointermove", ({ offsetX, offsetY }) =>
    current() && say(targetAt(current(), offsetX, offsetY)));
  canvas.addEventListener("pointerleave", () => say({}));
  canvas.addEventListener("blur", () => say({}));
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step || !current()) return;
    event.preventDefault();
    edge = (edge + step + current().mesh.edges) % current().mesh.edges;
    say({ edge });
  });
}
