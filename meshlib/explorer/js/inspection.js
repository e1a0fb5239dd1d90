// The edge or element under the pointer, or chosen by arrow keys, and its cost.

import { edgeCost, elementCost, meanOfNodes, meanOfSides, nodeCost } from "./costs.js";
import { strokeEdges, TRIED } from "./drawing.js";
import { anglesOf, cornersOf, DEGREE, endsOf, sidesOf } from "./mesh.js";

/** @import { Mesh, Pair, Pen, Points, Shown, Target } from "./types" */

const NEAR = 7;                                      // pixels: a pointer nearer to an edge means the edge
const DIGITS = 4;                                    // significant digits of costs and angles

// -- what is meant ---------------------------------------------------------------------------

/** The edge nearest to a place on the panel, if it is near; else the element there.
 * @type {(shown: Shown, px: number, py: number) => Target} */
function targetAt({ mesh, place }, px, py) {
  let edge = -1, least = NEAR;
  for (let e = 0; e < mesh.edges; e++) {
    const [p, q] = endsOf(mesh, e).map((n) => [place.px(mesh.x[n]), place.py(mesh.y[n])]);
    const distance = toSegment(px, py, p, q);
    if (distance < least) [edge, least] = [e, distance];
  }
  if (edge >= 0) return { edge };
  const [x, y] = place.back(px, py);
  for (let t = 0; t < mesh.size; t++) if (isInside(mesh, t, x, y)) return { element: t };
  return {};
}

/** Distance of a point from the segment between a and b.
 * @type {(px: number, py: number, a: number[], b: number[]) => number} */
function toSegment(px, py, [ax, ay], [bx, by]) {
  const [ux, uy] = [bx - ax, by - ay], along = ((px - ax) * ux + (py - ay) * uy) / (ux * ux + uy * uy);
  const share = Math.min(Math.max(along, 0), 1);
  return Math.hypot(px - ax - share * ux, py - ay - share * uy);
}

/** @type {(mesh: Mesh, t: number, px: number, py: number) => boolean} */
function isInside({ x, y, elements }, t, px, py) {
  return [0, 1, 2].every((k) => {
    const p = elements[3 * t + k], q = elements[3 * t + (k + 1) % 3];
    return (x[q] - x[p]) * (py - y[p]) >= (px - x[p]) * (y[q] - y[p]);
  });
}

// -- what is said of it ----------------------------------------------------------------------

/** What there is to say of an edge or element.
 * @type {(shown: Shown, target: Target) => string} */
function textOf(shown, { edge, element }) {
  if (edge !== undefined) return edgeText(shown, edge);
  return element === undefined ? "" : elementText(shown, element);
}

/** The cost of an edge, or the costs of the elements or nodes that it joins.
 * @type {(shown: Shown, e: number) => string} */
function edgeText({ mesh, scene }, e) {
  const at = endsOf(mesh, e).map((n) => pointText(mesh, n)).join(" to ");
  const name = nameOf(scene.cost), onBoundary = sidesOf(mesh, e)[1] < 0;
  if (onBoundary && scene.on !== "node") return `Edge ${at}, on the boundary.`;
  return `Edge ${at}: ${name} ` + {
    edge: () => `${digits(edgeCost(mesh, scene, e))}.`,
    element: () => `of its elements ${both(sidesOf(mesh, e), (t) => elementCost(mesh, scene, t))}.`,
    node: () => `of its nodes ${both(endsOf(mesh, e), (n) => nodeCost(mesh, n))}.`,
  }[scene.on]();
}

/** @type {(numbers: Pair, cost: (number: number) => number) => string} */
const both = (numbers, cost) => numbers.map((n) => digits(cost(n))).join(" and ");

/** The cost of an element, or the mean cost of its edges or nodes.
 * @type {(shown: Shown, t: number) => string} */
function elementText({ mesh, scene }, t) {
  const largest = digits(Math.max(...anglesOf(mesh, t)) / DEGREE), name = nameOf(scene.cost);
  return `Element with an angle of ${largest}°: ` + {
    edge: () => `mean ${name} of its edges ${digits(meanOfSides(mesh, scene, t))}.`,
    element: () => `${name} ${digits(elementCost(mesh, scene, t))}.`,
    node: () => `mean ${name} of its nodes ${digits(meanOfNodes(mesh, t))}.`,
  }[scene.on]();
}

/** Abbreviations such as "jnd" are written in capitals, names such as "smallest-angle" are not.
 * @type {(cost: string) => string} */
const nameOf = (cost) => (cost.includes("-") ? cost : cost.toUpperCase());

/** @type {(value: number) => number} */
const digits = (value) => Number(value.toPrecision(DIGITS));

/** @type {(points: Points, n: number) => string} */
const pointText = ({ x, y }, n) => `(${x[n].toFixed(2)}, ${y[n].toFixed(2)})`;

/** Marks an edge or element.
 * @type {(pen: Pen, shown: Shown, target: Target) => void} */
export function drawTarget(pen, shown, { edge, element }) {
  /** @type {Pair[]} */
  const lines = [];
  if (edge !== undefined) lines.push(endsOf(shown.mesh, edge));
  if (element !== undefined) {
    const [p, q, r] = cornersOf(shown.mesh, element);
    lines.push([p, q], [q, r], [r, p]);
  }
  strokeEdges(pen, shown, "white", 6, lines);
  strokeEdges(pen, shown, TRIED, 3.5, lines);
}

// -- pointer and keys --------------------------------------------------------------------------

/** Has a canvas tell what it shows: `current` gives what is on it, `tell` takes target and text.
 * @type {(canvas: HTMLCanvasElement, current: () => Shown | null,
 *         tell: (target: Target, text: string) => void) => void} */
export function makeInspectable(canvas, current, tell) {
  let last = "", edge = -1;
  const say = (/** @type {Target} */ target) => {
    const shown = current(), text = shown ? textOf(shown, target) : "";
    if (text !== last) tell(target, last = text);
  };
  canvas.addEventListener("pointermove", ({ offsetX, offsetY }) => {
    const shown = current();
    if (shown) say(targetAt(shown, offsetX, offsetY));
  });
  canvas.addEventListener("pointerleave", () => say({}));
  canvas.addEventListener("blur", () => say({}));
  canvas.addEventListener("keydown", (event) => {
    const step = Number(event.key === "ArrowRight") - Number(event.key === "ArrowLeft"), shown = current();
    if (!step || !shown) return;
    event.preventDefault();
    edge = (edge + step + shown.mesh.edges) % shown.mesh.edges;
    say({ edge });
  });
}
