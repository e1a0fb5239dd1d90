// What the scripts of the explorer hand to each other, for editors and the type checker.

export type Pair = [number, number];
export type Triple = [number, number, number];
export type Numbers = Uint8Array | Uint16Array | Uint32Array;

// -- an atlas, as atlas.py writes it ------------------------------------------------------------

export interface Header {
  name: string;
  /** What a frame is, such as "sweep"; empty if there are only start and adapted mesh. */
  film: string;
  scenes: Caption[];
  /** The value of each control that is shown first. */
  initial: Record<string, string>;
  controls: Control[];
}

/** The criterion whose costs are told, and the norm by which tried swaps were compared. */
export interface Criterion {
  cost: string;
  on: "edge" | "element" | "node";
  norm: "1" | "2" | "max" | "lexicographic";
  /** Whether the atlas has the costs, for which there is no formula in costs.js. */
  given?: boolean;
}

export interface Caption extends Criterion {
  title: string;
}

export interface Control {
  name: string;
  label: string;
  kind: "menu" | "slider";
  values: string[];
  texts: string[];
}

/** Points in space, of which all meshes of an atlas have their nodes. */
export interface Points {
  x: Float64Array;
  y: Float64Array;
  u: Float64Array;
}

export interface Atlas extends Points, Partial<GivenCosts> {
  header: Header;
  /** The function of each scene on a grid of 101 x 101 points, row by row from below. */
  grids: Float32Array;
  /** Three points for each element. */
  elements: Numbers;
  /** Where the members of each mesh begin, and where the last ones end. */
  meshes: Numbers;
  /** Element numbers, as differences 0, -1, 1, -2, ... that are written as 0, 1, 2, 3, ... */
  members: Numbers;
  /** Where the film of each scene begins, and where the last one ends. */
  films: Numbers;
  /** Mesh numbers. */
  film: Numbers;
  /** Where the tries of each scene begin, and where the last ones end. */
  traces: Numbers;
  /** For each try: the points of the old edge a-b and of the new one c-d, and whether it was swapped. */
  a: Numbers;
  b: Numbers;
  c: Numbers;
  d: Numbers;
  accepted: Numbers;
  /** For each scene: number of its grid, of its start mesh, and of swaps. */
  truth: Numbers;
  start: Numbers;
  swaps: Numbers;
  /** Number of the scene for each setting of a page. */
  index: Numbers;
}

/** Costs of user-defined criteria, from cost_changes.py; in an atlas if any of its scenes has such. */
export interface GivenCosts {
  /** Where the rows of each scene begin, and where the last ones end. */
  changes: Numbers;
  /** For each row: the mesh of the scene from which on the cost holds, the points p <= q <= r of an
   * element, an edge (q = r) or a node (p = q = r), and the cost. */
  stage: Numbers;
  p: Numbers;
  q: Numbers;
  r: Numbers;
  cost: Float64Array;
  /** Where the tries of each scene begin, and where the last ones end. */
  tries: Numbers;
  /** For each try: what the norm compares of the costs with the old and with the new edge. */
  old: Float64Array;
  new: Float64Array;
}

// -- a scene and its frames -----------------------------------------------------------------------

export interface Scene extends Caption {
  atlas: Atlas;
  /** The function on the grid. */
  truth: Float32Array;
  start: number;
  film: Numbers;
  /** Number of the first try. */
  first: number;
  swaps: number;
  frames: number;
  /** Whether a frame is a try. */
  traced: boolean;
  /** Number of the scene in the atlas. */
  number: number;
}

/** A swap that was tried: of the edge a-b for c-d. */
export interface Try {
  a: number;
  b: number;
  c: number;
  d: number;
  accepted: boolean;
}

/** Cost of each edge, element or node by its points; those that are missing have cost 0. */
export type Costs = Map<string, number>;

export interface Frame {
  /** Three points of the atlas for each element, counter-clockwise. */
  elements: Uint32Array;
  /** Swaps made since the start mesh. */
  swaps: number;
  tried?: Try;
  /** Costs for which there is no formula. */
  costs?: Costs;
  /** Those around the try: with the old edge, and with the new one. */
  local?: Pair;
}

export interface Edges {
  /** Two nodes for each edge. */
  ends: number[];
  /** Two elements for each edge; on the boundary the second is -1. */
  sides: number[];
  /** Number of edges. */
  edges: number;
}

export interface Mesh extends Points, Frame, Edges {
  /** The points that are nodes. */
  nodes: Uint32Array;
  /** Number of elements. */
  size: number;
}

export type EdgeCost =
  (points: Points, p: number, q: number, g: Pair, h: Pair, l: number, r: number) => number;
export type ElementCost = (mesh: Mesh, t: number) => number;

/** Label, decimals, and a measure of element t. */
export type Shape = [string, number, (angles: Triple, mesh: Mesh, t: number) => number];
/** A row of the quality table: label, number, and the text of the number. */
export type Numbered = [string, number, string];

// -- what is drawn --------------------------------------------------------------------------------

/** A rectangle, and the length of its longer side. */
export interface Box {
  low: Pair;
  high: Pair;
  size: number;
}

/** Moves a point in space. */
export type Unit = (x: number, y: number, u: number) => Triple;

/** What all frames of a scene share. */
export interface Common {
  box: Box;
  /** Largest error, of the start or of the adapted mesh. */
  worst: number;
  /** Least and largest value of the function. */
  limits: Pair;
  unit: Unit;
  atStart: Numbered[];
}

export interface Prepared extends Common {
  common: Common;
  scene: Scene;
  frame: number;
  mesh: Mesh;
  error: Float64Array;
  numbers: Numbered[];
}

/** From where the surface is seen, in radians. */
export interface Eye {
  azimuth: number;
  elevation: number;
}

export interface Visible extends Prepared {
  eye: Eye;
}

/** Coordinates on a panel, in pixels to the right and down. */
export interface Place {
  px: (x: number) => number;
  py: (y: number) => number;
  back: (px: number, py: number) => Pair;
  scale: number;
}

/** All that a panel draws. */
export interface Shown extends Visible {
  place: Place;
  /** Pixels along each side of the panel. */
  side: number;
  /** Colour of the text of the page. */
  ink: string;
}

/** The part of a canvas's context that drawings need. */
export interface Pen {
  fillStyle: string | CanvasGradient | CanvasPattern;
  strokeStyle: string | CanvasGradient | CanvasPattern;
  globalAlpha: number;
  lineWidth: number;
  beginPath(): void;
  closePath(): void;
  moveTo(x: number, y: number): void;
  lineTo(x: number, y: number): void;
  setLineDash(dashes: number[]): void;
  fill(): void;
  stroke(): void;
  drawImage(image: HTMLCanvasElement, sx: number, sy: number, sw: number, sh: number,
            x: number, y: number, width: number, height: number): void;
}

export type Draw = (pen: Pen, shown: Shown) => void;

/** The edge or element that is pointed at, if any. */
export interface Target {
  edge?: number;
  element?: number;
}

// -- parts of a page --------------------------------------------------------------------------------

export interface Panel {
  name: string;
  caption: string;
  draw: Draw;
  /** Colours of its bar. */
  table: string[];
  /** Values at the ends of its bar. */
  ends: (shown: Prepared) => Pair;
  turns?: boolean;
}

export interface PanelParts {
  figure: HTMLElement;
  canvas: HTMLCanvasElement;
  ends: HTMLElement[];
}

export interface Layout {
  root: HTMLElement;
  title: HTMLElement;
  note: HTMLElement;
  panels: PanelParts[];
  table: HTMLTableElement;
  readout: HTMLElement;
  tools: HTMLElement;
}

export interface View {
  root: HTMLElement;
  tools: HTMLElement;
  show: (scene: Scene, frame: number) => void;
  stop: () => void;
}

export type Input = HTMLInputElement | HTMLSelectElement;

/** A native control. */
export interface Made {
  input: Input;
  set: (value: string | null) => void;
  row: HTMLElement;
}

/** The slider of the frames. */
export interface FilmSlider {
  input: HTMLInputElement;
  row: HTMLElement;
  /** Writes the number of the frame. */
  tell: () => void;
  stop: () => void;
}

/** The model of an anywidget: traits of view.py. */
export interface Model {
  get(name: "frame"): number;
  get(name: "atlas"): DataView<ArrayBuffer>;
  on(event: string, act: () => void): void;
  off(event: string, act: () => void): void;
}

/** A name and its atlas, compressed by gzip and written in base 64. */
export type Item = [name: string, packed: string];

declare global {
  interface Window {
    meshExplorers?: { push(item: Item): unknown };
    /** MathJax or, before it begins, its settings. */
    MathJax?: any;
  }
}
