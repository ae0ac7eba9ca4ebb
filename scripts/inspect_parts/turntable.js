// A parallel view of space that is turned, moved and brought nearer.

const FARTHEST = 20;  // so many times the size of the frustum or the cube, triangles around it may shrink it
const LEFT_AROUND = 1.14;  // for labels

class Turntable {
  // `start` has yaw and pitch in radians; `guide` has line segments, `points` triples of numbers.
  constructor(start, guide, points) {
    Object.assign(this, {start, guide, points});
    this.resize(1, 1);
  }

  // To a picture of so many pixels.
  resize(width, height) {
    Object.assign(this, {width, height});
    if (this.zoom === undefined) this.fit(); else this.measure();
  }

  // Back to the first view, with all in sight.
  fit() {
    Object.assign(this, this.start, {zoom: 1, shift: [0, 0]});
    this.measure();
  }

  // `size` is the height of the pane in units of the space. Chooses it and the center so that the frustum or the cube is in sight, and the triangles as far as that leaves it to be seen.
  measure() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const include = (x, y, z) => {
      low[0] = Math.min(low[0], x); low[1] = Math.min(low[1], y); low[2] = Math.min(low[2], z);
      high[0] = Math.max(high[0], x); high[1] = Math.max(high[1], y); high[2] = Math.max(high[2], z);
    };
    this.guide.flat().forEach(p => include(...p));
    const first = low.map((x, i) => x - FARTHEST * (high[i] - x)), last = high.map((x, i) => x + FARTHEST * (x - low[i]));
    const inReach = (x, i) => Math.max(first[i], Math.min(last[i], x)), {points} = this;
    for (let at = 0; at < points.length; at += 3) include(inReach(points[at], 0), inReach(points[at + 1], 1), inReach(points[at + 2], 2));
    this.middle = low.map((x, i) => (x + high[i]) / 2);
    const [[a, b, c], [d, e, f]] = this.axes(), [mx, my, mz] = this.middle;
    let widest = 0, highest = 0;
    const widen = (x, y, z) => {
      widest = Math.max(widest, Math.abs(a * (x - mx) + b * (y - my) + c * (z - mz)));
      highest = Math.max(highest, Math.abs(d * (x - mx) + e * (y - my) + f * (z - mz)));
    };
    this.guide.flat().forEach(p => widen(...p));
    for (let at = 0; at < points.length; at += 3) widen(inReach(points[at], 0), inReach(points[at + 1], 1), inReach(points[at + 2], 2));
    this.size = 2 * LEFT_AROUND * Math.max(highest, widest * this.height / this.width) || 1;
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.pitch + pitch));
  }

  // By a factor, so that what is at pixel (x, y) stays there.
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
