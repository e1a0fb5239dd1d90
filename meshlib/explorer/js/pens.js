// What drawings are made with: the context of a canvas, or the same calls that write SVG.

/** @import { Pen } from "./types" */

/** A pen for a canvas of any density of pixels, in units of the page.
 * @type {(canvas: HTMLCanvasElement) => Pen} */
export function canvasPen(canvas) {
  const scale = window.devicePixelRatio || 1, side = canvas.clientWidth;
  const pixels = Math.round(side * scale);
  if (canvas.width !== pixels) canvas.width = canvas.height = pixels;
  const pen = contextOf(canvas);
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, side, side);
  pen.lineJoin = pen.lineCap = "round";
  return pen;
}

/** @type {(canvas: HTMLCanvasElement) => CanvasRenderingContext2D} */
export function contextOf(canvas) {
  const context = canvas.getContext("2d");
  if (!context) throw new Error("this browser does not draw on a canvas");
  return context;
}

/** Writes each path and picture as an element of SVG.
 * @implements {Pen} */
export class SvgPen {
  constructor() {
    this.parts = /** @type {string[]} */ ([]);
    this.path = /** @type {string[]} */ ([]);
    this.dashes = /** @type {number[]} */ ([]);
    this.fillStyle = /** @type {Pen["fillStyle"]} */ ("");
    this.strokeStyle = /** @type {Pen["strokeStyle"]} */ ("");
    this.globalAlpha = 1;
    this.lineWidth = 1;
  }

  beginPath() {
    this.path = [];
  }

  /** @type {Pen["moveTo"]} */
  moveTo(x, y) {
    this.path.push(`M${x.toFixed(2)} ${y.toFixed(2)}`);
  }

  /** @type {Pen["lineTo"]} */
  lineTo(x, y) {
    this.path.push(`L${x.toFixed(2)} ${y.toFixed(2)}`);
  }

  closePath() {
    this.path.push("Z");
  }

  /** @type {Pen["setLineDash"]} */
  setLineDash(dashes) {
    this.dashes = dashes;
  }

  fill() {
    this.add(`fill="${this.fillStyle}"`, "fill");
  }

  stroke() {
    const dashes = this.dashes.length ? ` stroke-dasharray="${this.dashes.join(" ")}"` : "";
    this.add(`fill="none" stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}"${dashes}`, "stroke");
  }

  /** Adds the path with this look.
   * @type {(look: string, kind: "fill" | "stroke") => void} */
  add(look, kind) {
    const alpha = this.globalAlpha < 1 ? ` ${kind}-opacity="${this.globalAlpha}"` : "";
    this.parts.push(`<path d="${this.path.join("")}" ${look}${alpha}/>`);
  }

  /** Part of a picture, of size sw, sh from sx, sy, in a place on the page.
   * @type {Pen["drawImage"]} */
  drawImage(image, sx, sy, sw, sh, x, y, width, height) {
    this.parts.push(`<svg x="${x}" y="${y}" width="${width}" height="${height}"`
      + ` viewBox="${sx} ${sy} ${sw} ${sh}" preserveAspectRatio="none"><image width="${image.width}"`
      + ` height="${image.height}" href="${image.toDataURL()}"/></svg>`);
  }
}
