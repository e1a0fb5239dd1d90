// What drawings are made with: the context of a canvas, or the same calls that write SVG.

function canvasPen(canvas) {
  const scale = window.devicePixelRatio || 1, side = canvas.clientWidth;
  const pixels = Math.round(side * scale);
  if (canvas.width !== pixels) canvas.width = canvas.height = pixels;
  const pen = canvas.getContext("2d");
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, side, side);
  pen.lineJoin = pen.lineCap = "round";
  return pen;
}

class SvgPen {
  constructor() {
    Object.assign(this, { parts: [], path: [], globalAlpha: 1, fillStyle: "", strokeStyle: "", lineWidth: 1,
                          dashes: [] });
  }

  beginPath() { this.path = []; }
  moveTo(x, y) { this.path.push(`M${x.toFixed(2)} ${y.toFixed(2)}`); }
  lineTo(x, y) { this.path.push(`L${x.toFixed(2)} ${y.toFixed(2)}`); }
  closePath() { this.path.push("Z"); }
  setLineDash(dashes) { this.dashes = dashes; }
  fill() { this.add(`fill="${this.fillStyle}"`, "fill"); }

  stroke() {
    const dashes = this.dashes.length ? ` stroke-dasharray="${this.dashes.join(" ")}"` : "";
    this.add(`fill="none" stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}"${dashes}`, "stroke");
  }

  add(look, kind) {
    const alpha = this.globalAlpha < 1 ? ` ${kind}-opacity="${this.globalAlpha}"` : "";
    this.parts.push(`<path d="${this.path.join("")}" ${look}${alpha}/>`);
  }

  // Part of a picture, from sx, sy, in a place on the page.
  drawImage(image, sx, sy, sw, sh, x, y, width, height) {
    this.parts.push(`<svg x="${x}" y="${y}" width="${width}" height="${height}"`
      + ` viewBox="${sx} ${sy} ${sw} ${sh}" preserveAspectRatio="none"><image width="${image.width}"`
      + ` height="${image.height}" href="${image.toDataURL()}"/></svg>`);
  }
}
