// Draws one stage of a packed state (see view.py) on canvases. Joined with view.js into one
// module by view.py, since a widget has a single file.

// Tenths of matplotlib's tables, which readers with any kind of colour vision can follow;
// the last colour of viridis is left out, being too bright for lines on white.
const VIRIDIS = ["#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c",
                 "#22a884", "#44bf70", "#7ad151", "#bddf26"];
const CIVIDIS = ["#00224e", "#083370", "#35456c", "#4f576c", "#666970", "#7d7c78",
                 "#948e77", "#aea371", "#c8b866", "#e5cf52", "#fee838"];
const MARGIN = 6;                                    // pixels around the domain
const HEIGHT = 0.62;                                 // of the surface, in widths of the domain
const LIGHT = [-0.37, -0.21, 0.9];                   // towards the lamp
const SHADOW = 0.5;
const DEGREE = Math.PI / 180, STEP = 5 * DEGREE;     // of turning by an arrow key
const EYE = { azimuth: -60 * DEGREE, elevation: 32 * DEGREE };

// -- the packed state ------------------------------------------------------------------

function decode(stage) {
  // A slice, since a typed array must begin at a multiple of its item's size.
  const array = (Type, view) =>
    new Type(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));
  const [nodes, values, error] = ["nodes", "values", "error"]
    .map((k) => array(Float32Array, stage[k]));
  const [elements, edges] = ["elements", "edges"].map((k) => array(Uint16Array, stage[k]));
  const points = Array.from(values, (u, n) => [nodes[2 * n], nodes[2 * n + 1], u]);
  const rows = (flat, width) => Array.from({ length: flat.length / width },
    (_, i) => Array.from(flat.subarray(i * width, (i + 1) * width), (n) => points[n]));
  return { name: stage.name, error, points, triangles: rows(elements, 3), edges: rows(edges, 2),
           box: box(points) };
}

function box(points) {
  const [x, y] = [0, 1].map((k) => points.map((p) => p[k]));
  const low = [Math.min(...x), Math.min(...y)], high = [Math.max(...x), Math.max(...y)];
  return { low, high, size: Math.max(high[0] - low[0], high[1] - low[1]) };
}

// -- colours ---------------------------------------------------------------------------

const channels = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));

function mixed(table, share, light = 1) {
  const place = Math.min(Math.max(share, 0), 1) * (table.length - 1);
  const k = Math.min(Math.floor(place), table.length - 2);
  const [a, b] = [channels(table[k]), channels(table[k + 1])];
  return a.map((c, i) => Math.round(light * (c + (place - k) * (b[i] - c))));
}

const css = (rgb) => `rgb(${rgb.join(" ")})`;
const shareOf = (value, [low, high]) => (value - low) / (high - low);

// -- geometry of one element, three points [x, y, u] --------------------------------------

function between(p, q, level) {
  const t = (level - p[2]) / (q[2] - p[2]);
  return [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), level];
}

// The part where u >= level, a polygon; and the line where u = level, none or two points.
function cut(triangle, level) {
  const part = [], line = [];
  triangle.forEach((p, k) => {
    const q = triangle[(k + 1) % 3];
    if (p[2] >= level) part.push(p);
    if ((p[2] >= level) !== (q[2] >= level)) {
      line.push(between(p, q, level));
      part.push(line[line.length - 1]);
    }
  });
  return { part, line };
}

// -- canvas ------------------------------------------------------------------------------

function prepared(canvas) {
  const scale = window.devicePixelRatio || 1, side = canvas.clientWidth;
  canvas.width = canvas.height = Math.round(side * scale);
  const pen = canvas.getContext("2d");
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, side, side);
  pen.lineJoin = pen.lineCap = "round";
  return { pen, side };
}

function flat({ low, high, size }, side) {
  const scale = (side - 2 * MARGIN) / size;
  const left = (side - scale * (low[0] + high[0])) / 2;
  const bottom = (side + scale * (low[1] + high[1])) / 2;
  return ([x, y]) => [left + scale * x, bottom - scale * y];
}

function trace(pen, points, place, closed = false) {
  points.map(place).forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  if (closed) pen.closePath();
}

function stroke(pen, lines, place, colour, width) {
  pen.beginPath();
  lines.forEach((line) => trace(pen, line, place));
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke();
}

// One path for all elements: pieces filled one by one would leave hairlines between them.
function fill(pen, polygons, place, colour) {
  pen.beginPath();
  polygons.forEach((polygon) => trace(pen, polygon, place, true));
  pen.fillStyle = colour;
  pen.fill();
}

// -- the four panels ------------------------------------------------------------------------

function drawMesh(canvas, stage, { levels }) {
  const { pen, side } = prepared(canvas), place = flat(stage.box, side);
  fill(pen, stage.triangles, place, css(mixed(VIRIDIS, 0)));
  levels.forEach((level, k) => {
    const parts = stage.triangles.map((t) => cut(t, level).part).filter((part) => part.length);
    fill(pen, parts, place, css(mixed(VIRIDIS, (k + 1) / levels.length)));
  });
  // White on a dark rim can be seen on every colour of the table.
  stroke(pen, stage.edges, place, "rgb(0 0 0 / 0.45)", 2.2);
  stroke(pen, stage.edges, place, "white", 1);
}

function drawLines(canvas, stage, { levels, limits }, ink) {
  const { pen, side } = prepared(canvas), place = flat(stage.box, side);
  pen.globalAlpha = 0.18;
  stroke(pen, stage.edges, place, ink, 0.8);
  pen.globalAlpha = 1;
  for (const level of levels) {
    const lines = stage.triangles.map((t) => cut(t, level).line).filter((line) => line.length);
    const colour = css(mixed(VIRIDIS, shareOf(level, limits)));
    // Some ink, so that either end of the table stands out from dark and from light paper.
    stroke(pen, lines, place, `color-mix(in srgb, ${colour} 70%, ${ink})`, 1.8);
  }
}

function drawError(canvas, stage, { worst }) {
  const { pen, side } = prepared(canvas), place = flat(stage.box, side);
  const [left, bottom] = place(stage.box.low), [right, top] = place(stage.box.high);
  const count = Math.sqrt(stage.error.length), image = picture(stage.error, count, worst);
  // Grid points are the middles of pixels: the outer ones reach half a pixel over the edge.
  const [dx, dy] = [(right - left) / (count - 1), (bottom - top) / (count - 1)];
  pen.save();
  pen.beginPath();
  pen.rect(left, top, right - left, bottom - top);
  pen.clip();
  pen.drawImage(image, left - dx / 2, top - dy / 2, count * dx, count * dy);
  pen.restore();
  stroke(pen, stage.edges, place, "rgb(255 255 255 / 0.3)", 0.8);
}

function picture(error, count, worst) {
  const canvas = Object.assign(document.createElement("canvas"), { width: count, height: count });
  const pen = canvas.getContext("2d"), image = pen.createImageData(count, count);
  error.forEach((value, k) => {
    const row = count - 1 - Math.floor(k / count), start = 4 * (row * count + (k % count));
    image.data.set([...mixed(CIVIDIS, worst ? value / worst : 0), 255], start);
  });
  pen.putImageData(image, 0, 0);
  return canvas;
}

function drawSurface(canvas, stage, { limits }, ink, eye) {
  const { pen, side } = prepared(canvas), place = solid(stage.box, limits, side, eye);
  const { low, high } = stage.box, u = limits[0];
  const floor = [[low, low], [high, low], [high, high], [low, high], [low, low]]
    .map(([x, y]) => [x[0], y[1], u]);
  pen.globalAlpha = 0.35;
  stroke(pen, [floor], place, ink, 1);
  pen.globalAlpha = 1;
  const depth = (t) => t.reduce((sum, p) => sum + place(p)[2], 0);
  const facets = stage.triangles.map((t) => [depth(t), t]).sort((a, b) => b[0] - a[0]);
  for (const [, triangle] of facets) {
    const mean = triangle.reduce((sum, p) => sum + p[2], 0) / 3;
    const light = 1 - SHADOW * (1 - lit(triangle, stage.box, limits));
    fill(pen, [triangle], place, css(mixed(VIRIDIS, shareOf(mean, limits), light)));
    stroke(pen, [[...triangle, triangle[0]]], place, "rgb(0 0 0 / 0.55)", 0.6);
  }
}

// A point in space as the eye sees it from far away: right, down, and distance.
function solid(box, limits, side, { azimuth, elevation }) {
  const unit = normalised(box, limits), scale = (side - 2 * MARGIN) / 1.5;
  const [c, s] = [Math.cos(azimuth), Math.sin(azimuth)];
  const [cosine, sine] = [Math.cos(elevation), Math.sin(elevation)];
  return (point) => {
    const [x, y, z] = unit(point), towards = c * x + s * y;
    return [side / 2 + scale * (c * y - s * x), side / 2 - scale * (cosine * z - sine * towards),
            -cosine * towards - sine * z];
  };
}

function normalised({ low, high, size }, limits) {
  return ([x, y, u]) => [(x - (low[0] + high[0]) / 2) / size, (y - (low[1] + high[1]) / 2) / size,
                         HEIGHT * (shareOf(u, limits) - 0.5)];
}

function lit(triangle, box, limits) {
  const [a, b, c] = triangle.map(normalised(box, limits));
  const [e, f] = [b, c].map((p) => p.map((v, k) => v - a[k]));
  const normal = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
  const dot = normal.reduce((sum, v, k) => sum + v * LIGHT[k], 0);
  return Math.max(0, dot / Math.hypot(...normal) / Math.hypot(...LIGHT));
}
