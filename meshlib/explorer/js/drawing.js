// Draws one frame of a scene into four square panels, with any pen of pens.js.

// Tenths of matplotlib's tables, which readers with any kind of colour vision can follow;
// the last colour of viridis is left out, being too bright for lines on white.
const VIRIDIS = ["#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c",
                 "#22a884", "#44bf70", "#7ad151", "#bddf26"];
const CIVIDIS = ["#00224e", "#083370", "#35456c", "#4f576c", "#666970", "#7d7c78",
                 "#948e77", "#aea371", "#c8b866", "#e5cf52", "#fee838"];
const SHADES = 256;
const LEVELS = 10;                                   // lines of constant value
const MARGIN = 6;                                    // pixels around the domain
const ROOMY = 20, THINNEST = 0.4;                    // pixels between edges of full width; least share of it
const HEIGHT = 0.45;                                 // of the surface, in widths of the domain
const LIGHT = [0.15, -0.45, 0.88];                   // towards the lamp
const SHADOW = 0.4;
const RIM = "rgb(0, 0, 0)", TRIED = "#d55e00", SIDES = "#56b4e9";

// -- colours ---------------------------------------------------------------------------

const channels = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
const [viridis, cividis] = [VIRIDIS, CIVIDIS].map((table) =>
  Array.from({ length: SHADES }, (_, k) => mixed(table, k / (SHADES - 1))));

function mixed(table, share) {
  const place = share * (table.length - 1), k = Math.min(Math.floor(place), table.length - 2);
  const [a, b] = [channels(table[k]), channels(table[k + 1])];
  return a.map((c, i) => Math.round(c + (place - k) * (b[i] - c)));
}

const shade = (table, share) => table[Math.round(Math.min(Math.max(share, 0), 1) * (SHADES - 1))];
const css = (rgb, light = 1) => `rgb(${rgb.map((c) => Math.round(light * c)).join(", ")})`;
const shareOf = (value, [low, high]) => (value - low) / (high - low);

// Away from the limits, where plateaux are.
const levelsOf = ([low, high]) =>
  Array.from({ length: LEVELS }, (_, k) => low + (high - low) * (k + 0.5) / LEVELS);

// -- paths -------------------------------------------------------------------------------

function flat({ low, high, size }, side) {
  const scale = (side - 2 * MARGIN) / size;
  const left = (side - scale * (low[0] + high[0])) / 2, bottom = (side + scale * (low[1] + high[1])) / 2;
  return { px: (x) => left + scale * x, py: (y) => bottom - scale * y,
           back: (px, py) => [(px - left) / scale, (bottom - py) / scale], scale };
}

function strokeEdges(pen, { mesh, place }, colour, width, edges = null) {
  const { x, y, ends } = mesh;
  pen.beginPath();
  const line = (p, q) => {
    pen.moveTo(place.px(x[p]), place.py(y[p]));
    pen.lineTo(place.px(x[q]), place.py(y[q]));
  };
  if (edges) edges.forEach(([p, q]) => line(p, q));
  else for (let k = 0; k < ends.length; k += 2) line(ends[k], ends[k + 1]);
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke();
}

function pathOf(pen, elements, t, px, py) {
  for (let k = 3 * t; k < 3 * t + 3; k++) {
    if (k % 3) pen.lineTo(px(elements[k]), py(elements[k]));
    else pen.moveTo(px(elements[k]), py(elements[k]));
  }
  pen.closePath();
}

// Calls above(points) with the part of each element where u >= level, and line(points) with
// the line where u = level; points are x, y, x, y ... on the page.
function cut({ mesh, place }, level, above, line) {
  const { x, y, u, elements } = mesh;
  for (let t = 0; t < elements.length; t += 3) {
    const part = [], ends = [];
    for (let k = 0; k < 3; k++) {
      const p = elements[t + k], q = elements[t + (k + 1) % 3], [px, py] = [place.px(x[p]), place.py(y[p])];
      if (u[p] >= level) part.push(px, py);
      if ((u[p] >= level) === (u[q] >= level)) continue;
      const share = (level - u[p]) / (u[q] - u[p]);
      const at = [px + share * (place.px(x[q]) - px), py + share * (place.py(y[q]) - py)];
      part.push(...at);
      ends.push(...at);
    }
    if (part.length && above) above(part);
    if (ends.length && line) line(ends);
  }
}

function tracer(pen, closed) {
  return (points) => {
    pen.moveTo(points[0], points[1]);
    for (let k = 2; k < points.length; k += 2) pen.lineTo(points[k], points[k + 1]);
    if (closed) pen.closePath();
  };
}

// -- the four panels ------------------------------------------------------------------------
// `shown` has the mesh, its place on the page, error, limits, worst error, ink and eye.

function drawMesh(pen, shown) {
  const { mesh, limits, place } = shown, levels = levelsOf(limits);
  const { px, py } = placed(mesh, place);
  pen.beginPath();
  for (let t = 0; t < mesh.size; t++) pathOf(pen, mesh.elements, t, px, py);
  pen.fillStyle = css(viridis[0]);
  pen.fill();
  levels.forEach((level, k) => {
    pen.beginPath();                                 // one path: pieces would leave hairlines between
    cut(shown, level, tracer(pen, true));
    pen.fillStyle = css(shade(viridis, (k + 1) / LEVELS));
    pen.fill();
  });
  // White on a dark rim can be seen on every colour of the table, which it must not cover.
  const room = shown.side / Math.sqrt(mesh.size), width = Math.min(Math.max(room / ROOMY, THINNEST), 1);
  pen.globalAlpha = 0.45;
  strokeEdges(pen, shown, RIM, 2.2 * width);
  pen.globalAlpha = 1;
  strokeEdges(pen, shown, "white", width);
  if (mesh.tried) drawTried(pen, shown);
}

const placed = ({ x, y }, place) => ({ px: (n) => place.px(x[n]), py: (n) => place.py(y[n]) });

// As in Figure 3.3: the edge, the other diagonal dashed, and the four sides around them.
function drawTried(pen, shown) {
  const { a, b, c, d, accepted } = shown.mesh.tried, old = [a, b], other = [c, d];
  const sides = [[a, c], [c, b], [b, d], [d, a]];
  strokeEdges(pen, shown, RIM, 5, sides);
  strokeEdges(pen, shown, SIDES, 3, sides);
  const [solid, dashed] = accepted ? [other, old] : [old, other];
  strokeEdges(pen, shown, "white", 5.5, [solid]);
  strokeEdges(pen, shown, TRIED, 3.5, [solid]);
  pen.setLineDash([5, 5]);
  strokeEdges(pen, shown, TRIED, 2, [dashed]);
  pen.setLineDash([]);
}

function drawLines(pen, shown) {
  const { limits, ink } = shown;
  pen.globalAlpha = 0.2;
  strokeEdges(pen, shown, ink, 0.8);
  pen.globalAlpha = 1;
  for (const level of levelsOf(limits)) {
    pen.beginPath();
    cut(shown, level, null, tracer(pen, false));
    // Some ink, so that either end of the table stands out from dark and from light paper.
    const colour = shade(viridis, shareOf(level, limits)), tint = inkChannels(ink);
    pen.strokeStyle = css(colour.map((c, k) => 0.7 * c + 0.3 * tint[k]));
    pen.lineWidth = 1.8;
    pen.stroke();
  }
}

const inkChannels = (ink) => ink.match(/[\d.]+/g).slice(0, 3).map(Number);

function drawError(pen, shown) {
  const { box: { low, high }, place, error, worst } = shown;
  const [left, top] = [place.px(low[0]), place.py(high[1])];
  // Grid points are the middles of pixels: the outer ones reach half a pixel over the edge.
  pen.drawImage(picture(error, worst), 0.5, 0.5, GRID - 1, GRID - 1, left, top,
                place.px(high[0]) - left, place.py(low[1]) - top);
  pen.globalAlpha = 0.3;
  strokeEdges(pen, shown, "white", 0.8);
  pen.globalAlpha = 1;
}

function picture(error, worst) {
  const canvas = Object.assign(document.createElement("canvas"), { width: GRID, height: GRID });
  const pen = canvas.getContext("2d"), image = pen.createImageData(GRID, GRID);
  error.forEach((value, k) => {
    const start = 4 * ((GRID - 1 - Math.floor(k / GRID)) * GRID + (k % GRID));
    const [red, green, blue] = shade(cividis, worst ? value / worst : 0);
    image.data[start] = red;
    image.data[start + 1] = green;
    image.data[start + 2] = blue;
    image.data[start + 3] = 255;
  });
  pen.putImageData(image, 0, 0);
  return canvas;
}

function drawSurface(pen, shown) {
  const { mesh, limits, ink, box: { low, high } } = shown, { elements, u } = mesh;
  const eye = solid(shown), at = new Map();          // each node: right, down, distance
  for (const n of mesh.nodes) at.set(n, eye(mesh.x[n], mesh.y[n], u[n]));
  pen.globalAlpha = 0.35;
  pen.beginPath();
  tracer(pen, true)([[0, 0], [1, 0], [1, 1], [0, 1]].flatMap(([i, j]) =>
    eye([low, high][i][0], [low, high][j][1], limits[0]).slice(0, 2)));
  pen.strokeStyle = ink;
  pen.lineWidth = 1;
  pen.stroke();
  pen.globalAlpha = 1;
  const distance = (t) => [0, 1, 2].reduce((sum, k) => sum + at.get(elements[3 * t + k])[2], 0);
  const far = Array.from({ length: mesh.size }, (_, t) => [distance(t), t]).sort((a, b) => b[0] - a[0]);
  for (const [, t] of far) drawFacet(pen, shown, t, at);
}

function drawFacet(pen, { mesh, limits, unit }, t, at) {
  const nodes = cornersOf(mesh, t), mean = (mesh.u[nodes[0]] + mesh.u[nodes[1]] + mesh.u[nodes[2]]) / 3;
  pen.beginPath();
  pathOf(pen, mesh.elements, t, (n) => at.get(n)[0], (n) => at.get(n)[1]);
  pen.fillStyle = css(shade(viridis, shareOf(mean, limits)), 1 - SHADOW * (1 - lit(mesh, nodes, unit)));
  pen.fill();
  pen.strokeStyle = RIM;
  pen.lineWidth = 0.4;
  pen.stroke();
}

// A point in space as the eye sees it from far away: right, down, and distance.
function solid({ unit, side, eye: { azimuth, elevation } }) {
  const scale = (side - 2 * MARGIN) / 1.5, [c, s] = [Math.cos(azimuth), Math.sin(azimuth)];
  const [cosine, sine] = [Math.cos(elevation), Math.sin(elevation)];
  return (...point) => {
    const [x, y, z] = unit(...point), towards = c * x + s * y;
    return [side / 2 + scale * (c * y - s * x), side / 2 - scale * (cosine * z - sine * towards),
            -cosine * towards - sine * z];
  };
}

// Into a box around the origin, the same for all frames of a scene.
function normalised({ low, high, size }, limits) {
  return (x, y, u) => [(x - (low[0] + high[0]) / 2) / size, (y - (low[1] + high[1]) / 2) / size,
                       HEIGHT * (shareOf(u, limits) - 0.5)];
}

function lit({ x, y, u }, nodes, unit) {
  const [a, b, c] = Array.from(nodes, (n) => unit(x[n], y[n], u[n]));
  const [e, f] = [b, c].map((p) => p.map((v, k) => v - a[k]));
  const normal = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
  const dot = normal.reduce((sum, v, k) => sum + v * LIGHT[k], 0);
  return Math.max(0, dot / Math.hypot(...normal) / Math.hypot(...LIGHT));
}
