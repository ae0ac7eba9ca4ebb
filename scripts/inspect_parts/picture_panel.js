// The image and the depth map side by side, with marks on canvases above them.

const STEPS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
const SHIFT_STEPS = 10;

// A pixel of a canvas as one number.
const packed = (r, g, b) => 0xff000000 | b << 16 | g << 8 | r;

export class PicturePanel {
  // Each of two `panes` has a canvas for the pixels and one above it for marks.
  constructor(panes, fragments, palette) {
    Object.assign(this, {panes, fragments, palette, columns: fragments.columns, rows: fragments.rows, name: -1, pixel: -1, scale: 1});
    this.canvases = panes.map(pane => pane.querySelector("canvas"));
    this.marks = panes.map(pane => pane.querySelector("canvas + canvas"));
    for (const canvas of this.canvases) Object.assign(canvas, {width: this.columns, height: this.rows});
    this.showImage(fragments.rgb);
    this.paintDepths();
    const observer = new ResizeObserver(() => this.resize());
    panes.forEach(pane => observer.observe(pane));
    this.resize();
  }

  // The largest scale at which the picture fits into its pane; from 3 on a whole number, so that all pixels have one size.
  resize() {
    const fitting = Math.min(this.panes[0].clientWidth / this.columns, this.panes[0].clientHeight / this.rows);
    this.scale = fitting >= 3 ? Math.floor(fitting) : Math.max(fitting, 0.01);
    const [width, height] = [this.columns * this.scale, this.rows * this.scale], ratio = window.devicePixelRatio || 1;
    for (const canvas of [...this.canvases, ...this.marks]) Object.assign(canvas.style, {width: width + "px", height: height + "px"});
    for (const canvas of this.marks) Object.assign(canvas, {width: Math.ceil(width * ratio), height: Math.ceil(height * ratio)});
    this.highlight(this.name, this.pixel);
  }

  paint(canvas, color) {
    const picture = new ImageData(this.columns, this.rows), pixels = new Uint32Array(picture.data.buffer);
    for (let p = 0; p < pixels.length; ++p) pixels[p] = color(p);
    canvas.getContext("2d").putImageData(picture, 0, 0);
  }

  // Shows an image; one of another size, from a run whose other data are yet to come, is fitted into this one's place.
  showImage(rgb, columns = this.columns, rows = this.rows) {
    const picture = new ImageData(columns, rows), pixels = new Uint32Array(picture.data.buffer);
    for (let p = 0, at = 0; p < pixels.length; ++p, at += 3) pixels[p] = packed(rgb[at], rgb[at + 1], rgb[at + 2]);
    Object.assign(this.canvases[0], {width: columns, height: rows}).getContext("2d").putImageData(picture, 0, 0);
  }

  // Paints pixels that differ from another image in one color, all others in dark gray tones.
  showDifferences(other) {
    const {rgb} = this.fragments, color = packed(...this.palette.numbers("--theirs")), gray = level => packed(level, level, level);
    const differs = at => rgb[at] !== other[at] || rgb[at + 1] !== other[at + 1] || rgb[at + 2] !== other[at + 2];
    this.paint(this.canvases[0], p => differs(3 * p) ? color : gray((rgb[3 * p] + rgb[3 * p + 1] + rgb[3 * p + 2]) / 9));
  }

  paintDepths() {
    const {seen, depths} = this.fragments;
    let near = Infinity, far = -Infinity;
    for (const f of seen) if (f >= 0) { near = Math.min(near, depths[f]); far = Math.max(far, depths[f]); }
    const shade = z => far > near ? 255 - 205 * (z - near) / (far - near) : 255;
    this.paint(this.canvases[1], p => { const s = seen[p] < 0 ? 0 : Math.round(shade(depths[seen[p]])); return packed(s, s, s); });
  }

  // Outlines the pixels that show triangle `name`, and one pixel; -1 for none. The outlines have two tones, one of which stands out from
  // any color.
  highlight(name, pixel) {
    Object.assign(this, {name, pixel});
    const outline = this.outlineOf(this.fragments.pixelsOf(name));
    for (const mark of this.marks) {
      const context = mark.getContext("2d"), ratio = mark.width / (this.columns * this.scale);
      context.clearRect(0, 0, mark.width, mark.height);
      context.setTransform(ratio * this.scale, 0, 0, ratio * this.scale, 0, 0);
      this.stroke(context, outline, [[4, "--halo"], [1.75, "--hot"]]);
      if (pixel >= 0) this.stroke(context, this.boxOf(pixel), [[4, "--halo"], [1.75, "--pixel"]]);
      context.setTransform(1, 0, 0, 1, 0, 0);
    }
  }

  stroke(context, path, tones) {
    for (const [width, color] of tones) {
      Object.assign(context, {lineWidth: width / this.scale, strokeStyle: this.palette.word(color), lineCap: "square"});
      context.stroke(path);
    }
  }

  outlineOf(pixels) {
    const path = new Path2D(), {owners} = this.fragments, {columns} = this;
    for (const p of pixels) {
      const column = p % columns, row = (p - column) / columns, owner = owners[p];
      const side = (isInner, x0, y0, x1, y1) => { if (!isInner) { path.moveTo(x0, y0); path.lineTo(x1, y1); } };
      side(column > 0 && owners[p - 1] === owner, column, row, column, row + 1);
      side(column + 1 < columns && owners[p + 1] === owner, column + 1, row, column + 1, row + 1);
      side(owners[p - columns] === owner, column, row, column + 1, row);
      side(owners[p + columns] === owner, column, row + 1, column + 1, row + 1);
    }
    return path;
  }

  // A square around a pixel, large enough to be seen.
  boxOf(p) {
    const {row, column} = this.fragments.place(p), half = Math.max(0.5, 4 / this.scale), path = new Path2D();
    path.rect(column + 0.5 - half, row + 0.5 - half, 2 * half, 2 * half);
    return path;
  }

  // Calls `point` with the pixel pointed at, -1 for none, and `click` with the one clicked or walked to.
  listen({point, click}) {
    for (const canvas of this.canvases) {
      const at = event => {
        const column = Math.min(this.columns - 1, Math.floor(event.offsetX / this.scale)), row = Math.min(this.rows - 1, Math.floor(event.offsetY / this.scale));
        return Math.max(0, row) * this.columns + Math.max(0, column);
      };
      canvas.onpointermove = event => point(at(event));
      canvas.onpointerleave = () => point(-1);
      canvas.onclick = event => click(at(event));
      canvas.onkeydown = event => {
        if (!(event.key in STEPS) || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        click(this.beside(this.pixel, ...STEPS[event.key].map(step => step * (event.shiftKey ? SHIFT_STEPS : 1))));
      };
    }
  }

  // The pixel some columns and rows away, within the picture; the middle one if `p` is none.
  beside(p, right, down) {
    if (p < 0) return Math.floor(this.rows / 2) * this.columns + Math.floor(this.columns / 2);
    const {row, column} = this.fragments.place(p);
    return Math.max(0, Math.min(this.rows - 1, row + down)) * this.columns + Math.max(0, Math.min(this.columns - 1, column + right));
  }
}
