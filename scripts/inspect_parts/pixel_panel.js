// The image and the depth map, and zbuf's report on every pixel. It draws only zbuf's own pixels.

const FATES = ["kept", "lost, behind", "lost, equal and later than", "lost, before the front limit", "lost, beyond the rear limit"];

class PixelPanel {
  constructor(data) {
    Object.assign(this, {columns: data.columns, rows: data.rows, rgb: bytesOf(data.pixels), leftOut: data.leftOut});
    this.begins = intsOf(data.fragments.begins);
    this.triangles = intsOf(data.fragments.triangles);
    this.depths = realsOf(data.fragments.depths);
    this.fates = bytesOf(data.fragments.fates);
    // A pixel shows the last fragment that was kept.
    this.seen = new Int32Array(this.columns * this.rows).fill(-1);
    for (let p = 0; p < this.seen.length; ++p)
      for (let f = this.begins[p]; f < this.begins[p + 1]; ++f) if (this.fates[f] === 0) this.seen[p] = f;
    this.scale = Math.max(this.columns, this.rows) > 420 ? 420 / Math.max(this.columns, this.rows) : Math.max(1, Math.floor(420 / Math.max(this.columns, this.rows)));
    this.canvases = ["image", "depth", "image-mark", "depth-mark"].map(id => this.sized(document.getElementById(id)));
    this.paint(this.canvases[0], p => [this.rgb[3 * p], this.rgb[3 * p + 1], this.rgb[3 * p + 2], 255]);
    this.paintDepths();
  }

  sized(canvas) {
    canvas.width = this.columns;
    canvas.height = this.rows;
    canvas.style.width = this.columns * this.scale + "px";
    canvas.style.height = this.rows * this.scale + "px";
    return canvas;
  }

  paint(canvas, color) {
    const picture = new ImageData(this.columns, this.rows);
    for (let p = 0; p < this.columns * this.rows; ++p) picture.data.set(color(p), 4 * p);
    canvas.getContext("2d").putImageData(picture, 0, 0);
  }

  paintDepths() {
    let near = Infinity, far = -Infinity;
    for (const f of this.seen) if (f >= 0) { near = Math.min(near, this.depths[f]); far = Math.max(far, this.depths[f]); }
    const shade = z => far > near ? 255 - 205 * (z - near) / (far - near) : 255;
    this.paint(this.canvases[1], p => { const s = this.seen[p] < 0 ? 0 : shade(this.depths[this.seen[p]]); return [s, s, s, 255]; });
  }

  owner(p) { return this.seen[p] < 0 ? -1 : this.triangles[this.seen[p]]; }

  // Marks the pixels that show triangle `name`.
  highlight(name) {
    for (const canvas of this.canvases.slice(2)) this.paint(canvas, p => name >= 0 && this.owner(p) === name ? [255, 40, 90, 170] : [0, 0, 0, 0]);
    for (const row of document.querySelectorAll("#competitors tbody tr")) row.className = row.className.replace(" hot", "") + (Number(row.dataset.name) === name ? " hot" : "");
  }

  // Describes a pixel; clicking one of its competitors calls `select(name)`.
  tell(p, select) {
    const row = Math.floor(p / this.columns), column = p % this.columns, place = document.getElementById("pixel-place");
    place.textContent = `row ${row}, column ${column}: ` + (this.seen[p] < 0 ? "background" : `triangle ${this.owner(p)}, depth ${this.depths[this.seen[p]]}`) +
      (this.leftOut ? ` (${this.leftOut} fragments of the picture that lost are left out)` : "");
    let winner = -1;
    const rows = [];
    for (let f = this.begins[p]; f < this.begins[p + 1]; ++f) {
      const line = document.createElement("tr"), fate = this.fates[f];
      const reason = FATES[fate] + (fate === 1 || fate === 2 ? ` triangle ${winner}` : "");
      if (fate === 0) winner = this.triangles[f];
      for (const words of [this.triangles[f], this.depths[f], reason]) line.appendChild(document.createElement("td")).textContent = words;
      line.dataset.name = this.triangles[f];
      line.className = f === this.seen[p] ? "seen" : "";
      line.onclick = () => select(Number(line.dataset.name));
      rows.push(line);
    }
    document.querySelector("#competitors tbody").replaceChildren(...rows);
  }

  listen(point, click) {
    for (const canvas of this.canvases.slice(0, 2)) {
      const at = event => {
        const column = Math.min(this.columns - 1, Math.floor(event.offsetX / this.scale)), row = Math.min(this.rows - 1, Math.floor(event.offsetY / this.scale));
        return Math.max(0, row) * this.columns + Math.max(0, column);
      };
      canvas.onmousemove = event => point(at(event));
      canvas.onclick = event => click(at(event));
    }
  }
}
