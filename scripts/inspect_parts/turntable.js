// A parallel view of space that is turned, moved and brought nearer.

const FARTHEST = 20;  // triangles are kept in sight up to this many sizes of the frustum or cube around it
const LEFT_AROUND = 1.14;  // a margin for labels

// The box around points, triples of numbers, and the length of its diagonal.
function boxOf(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let at = 0; at < points.length; ++at) {
    low[at % 3] = Math.min(low[at % 3], points[at]);
    high[at % 3] = Math.max(high[at % 3], points[at]);
  }
  return {low, high, size: Math.hypot(...[0, 1, 2].map(i => high[i] - low[i]))};
}

export class Turntable {
  // `start` has yaw and pitch in radians; `guide` has line segments, `points` triples of numbers.
  constructor(start, guide, points) {
    Object.assign(this, {start, guide, points, isClose: false, zoom: 1, shift: [0, 0], ...start});
    this.resize(1, 1);
  }

  // Fits the view to a picture of this many pixels.
  resize(width, height) {
    Object.assign(this, {width, height});
    this.measure();
  }

  // Back to the first view, with all in sight; from there, with only the smaller of guide and triangles.
  fit() {
    const isThere = this.zoom === 1 && !this.shift[0] && !this.shift[1] && this.yaw === this.start.yaw && this.pitch === this.start.pitch;
    this.isClose = isThere && !this.isClose;
    Object.assign(this, this.start, {zoom: 1, shift: [0, 0]});
    this.measure();
  }

  // Its turn and place, for another Turntable.
  get pose() { return {yaw: this.yaw, pitch: this.pitch, zoom: this.zoom, shift: this.shift, isClose: this.isClose}; }

  set pose(pose) {
    Object.assign(this, pose);
    this.measure();
  }

  // The triples of numbers to fit into the view: guide and points, with points moved to at most FARTHEST sizes of the guide's box.
  inSight() {
    const guide = this.guide.flat(2), box = boxOf(guide), reach = [0, 1, 2].map(i => FARTHEST * (box.high[i] - box.low[i]));
    const near = this.points.map((x, at) => Math.max(box.low[at % 3] - reach[at % 3], Math.min(box.high[at % 3] + reach[at % 3], x)));
    if (!near.length) return [guide];
    return this.isClose ? [boxOf(near).size < box.size ? near : guide] : [guide, near];
  }

  // Chooses the center and `size`, the height of the pane in units of the space, to fit inSight().
  measure() {
    const shown = this.inSight(), boxes = shown.map(boxOf);
    this.middle = [0, 1, 2].map(i => (Math.min(...boxes.map(box => box.low[i])) + Math.max(...boxes.map(box => box.high[i]))) / 2);
    const [[a, b, c], [d, e, f]] = this.axes(), [mx, my, mz] = this.middle;
    let widest = 0, highest = 0;
    for (const points of shown) {
      for (let at = 0; at < points.length; at += 3) {
        const [x, y, z] = [points[at] - mx, points[at + 1] - my, points[at + 2] - mz];
        widest = Math.max(widest, Math.abs(a * x + b * y + c * z));
        highest = Math.max(highest, Math.abs(d * x + e * y + f * z));
      }
    }
    this.size = 2 * LEFT_AROUND * Math.max(highest, widest * this.height / this.width) || 1;
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.pitch + pitch));
  }

  // Zooms by a factor about pixel (x, y).
  approach(factor, x = this.width / 2, y = this.height / 2) {
    this.zoom *= factor;
    this.shift = [[x - this.width / 2, this.shift[0]], [y - this.height / 2, this.shift[1]]].map(([at, shift]) => at - factor * (at - shift));
  }

  // Rows for the directions right, up and to the viewer.
  axes() {
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    return [[cy, 0, -sy], [-sp * sy, cp, -sp * cy], [cp * sy, sp, cp * cy]];
  }

  // A point's pixel, and its nearness: larger is nearer.
  place(x, y, z) {
    const v = [x - this.middle[0], y - this.middle[1], z - this.middle[2]], scale = this.zoom * this.height / this.size;
    const [right, up, near] = this.axes().map(axis => axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2]);
    return [this.width / 2 + this.shift[0] + right * scale, this.height / 2 + this.shift[1] - up * scale, near];
  }

  // The same for many points at once.
  placeAll(points, x, y, near) {
    const [[a, b, c], [d, e, f], [g, h, i]] = this.axes(), [mx, my, mz] = this.middle, scale = this.zoom * this.height / this.size;
    const left = this.width / 2 + this.shift[0], top = this.height / 2 + this.shift[1];
    for (let k = 0, at = 0; at < points.length; ++k, at += 3) {
      const u = points[at] - mx, v = points[at + 1] - my, w = points[at + 2] - mz;
      x[k] = left + scale * (a * u + b * v + c * w);
      y[k] = top - scale * (d * u + e * v + f * w);
      near[k] = g * u + h * v + i * w;
    }
  }
}
