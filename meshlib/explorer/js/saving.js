// A frame as a file: SVG by the pens of pens.js, and PNG made from it.

import { element } from "./dom.js";
import { flat, MARGIN } from "./drawing.js";
import { PANELS } from "./panels.js";
import { contextOf, SvgPen } from "./pens.js";

/** @import { Visible } from "./types" */

const SIDE = 360;                                    // length of a panel
const GAP = 24;                                      // between panels
const LINE = 22;                                     // height of a line of text
const TOLD = 6;                                      // numbers of the quality table that are told
const DENSITY = 2;                                   // pixels of a PNG for each unit of the SVG
const LATER = 1000;                                  // milliseconds until the browser has taken a file

/** @type {Record<string, string>} */
const ENTITIES = { "&": "&#38;", "<": "&#60;", ">": "&#62;" };

/** @type {(text: string) => string} */
const escaped = (text) => text.replace(/[&<>]/g, (c) => ENTITIES[c]);

/** @type {(x: number, y: number, text: string, weight?: number) => string} */
const textAt = (x, y, text, weight = 400) =>
  `<text x="${x}" y="${y}" font-weight="${weight}" fill="black">${escaped(text)}</text>`;

/** The four panels as SVG, below a heading and the first numbers.
 * @type {(shown: Visible, heading: string) => string} */
export function svgOf(shown, heading) {
  const cell = SIDE + GAP + LINE, width = 2 * SIDE + 3 * GAP, height = 4 * LINE + 2 * cell;
  const panels = PANELS.map(({ draw, caption }, k) => {
    const pen = new SvgPen(), place = flat(shown.box, SIDE);
    draw(pen, { ...shown, place, side: SIDE, ink: "rgb(0, 0, 0)" });
    const [left, top] = [GAP + (k % 2) * (SIDE + GAP), 3.5 * LINE + Math.floor(k / 2) * cell];
    const below = textAt(MARGIN, SIDE + LINE, caption);
    return `<g transform="translate(${left} ${top})">${pen.parts.join("\n")}${below}</g>`;
  });
  const told = shown.numbers.slice(0, TOLD).map(([label, , text]) => `${label} ${text}`).join("   ");
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" font-size="14"`
    + ` viewBox="0 0 ${width} ${height}" font-family="sans-serif">`
    + `<rect width="100%" height="100%" fill="white"/>`
    + textAt(GAP, 1.4 * LINE, heading, 600) + textAt(GAP, 2.6 * LINE, told) + `${panels.join("\n")}</svg>\n`;
}

/** @type {(blob: Blob, name: string) => void} */
function download(blob, name) {
  const href = URL.createObjectURL(blob);
  element("a", { href, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(href), LATER);
}

/** @type {(svg: string, name: string) => void} */
export const saveSvg = (svg, name) => download(new Blob([svg], { type: "image/svg+xml" }), `${name}.svg`);

/** @type {(svg: string, name: string) => Promise<void>} */
export async function savePng(svg, name) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = element("canvas", { width: DENSITY * image.width, height: DENSITY * image.height });
  contextOf(canvas).drawImage(image, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((blob) => blob && download(blob, `${name}.png`));
}
