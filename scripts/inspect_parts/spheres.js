// The spheres of a stage, ellipsoids after a transform: each has a center and the ends of three half axes.

const MOST_WITH_CIRCLES = 1000;  // of more spheres only the outlines are drawn, with fewer segments

function circleOf(segments) { return Array.from({length: segments + 1}, (_, i) => [Math.cos(2 * Math.PI * i / segments), Math.sin(2 * Math.PI * i / segments)]); }

export class Spheres {
  constructor(names, firstLines, points) {
    Object.assign(this, {names, firstLines, points});
    this.places = new Map([...names].map((name, i) => [name, i]));
    [this.x, this.y, this.near] = [0, 1, 2].map(() => new Float64Array(4 * this.names.length));
    this.outlines = new Float64Array(3 * this.names.length);
    this.areMany = this.names.length > MOST_WITH_CIRCLES;
    this.circle = circleOf(this.areMany ? 16 : 48);
  }

  // -1 if no sphere has that number.
  placeOf(name) { return this.places.get(name) ?? -1; }

  linesOf(name) { return [0, 1, 2, 3].map(v => this.firstLines[this.placeOf(name)] + v); }

  nameOfLine(number) {
    const i = this.firstLines.findIndex(first => first <= number && number < first + 4);
    return i < 0 ? -1 : this.names[i];
  }

  // Points on the surfaces that extend nearly as far as the spheres in every direction.
  outermost() {
    const found = [];
    for (let at = 0; at < this.points.length; at += 12) {
      const [center, ...axes] = [0, 3, 6, 9].map(v => [0, 1, 2].map(i => this.points[at + v + i] - (v ? this.points[at + i] : 0)));
      for (const way of [[1, 0, 0], [0, 1, 0], [0, 0, 1], ...[1, -1].flatMap(y => [1, -1].map(z => [1, y, z]))]) {
        const reach = 1 / Math.hypot(...way), end = [0, 1, 2].map(i => reach * axes.reduce((sum, axis, k) => sum + way[k] * axis[i], 0));
        for (const sign of [1, -1]) found.push(...center.map((x, i) => x + sign * end[i]));
      }
    }
    return Float64Array.from(found);
  }

  // Projects the spheres to the pixels of a Turntable. An outline is the unit circle times the matrix L = (a 0, b c), where L times its
  // transpose is the sum of h times its transpose over the projected half axes h.
  place(view) {
    const {x, y, outlines} = this;
    view.placeAll(this.points, x, y, this.near);
    for (let i = 0, at = 0; i < this.names.length; ++i, at += 4) {
      let xx = 0, xy = 0, yy = 0;
      for (let k = at + 1; k < at + 4; ++k) {
        const u = x[k] - x[at], v = y[k] - y[at];
        xx += u * u;
        xy += u * v;
        yy += v * v;
      }
      const a = Math.sqrt(xx) || 1e-9, b = xy / a;
      outlines[3 * i] = a;
      outlines[3 * i + 1] = b;
      outlines[3 * i + 2] = Math.sqrt(Math.max(0, yy - b * b));
    }
  }

  // Points around the center of a sphere, in pixels: cosine times one half axis plus sine times another.
  around(i, [px, py], [qx, qy]) { return this.circle.map(([u, v]) => [this.x[4 * i] + u * px + v * qx, this.y[4 * i] + u * py + v * qy]); }

  outline(i) { return this.around(i, [this.outlines[3 * i], this.outlines[3 * i + 1]], [0, this.outlines[3 * i + 2]]); }

  // The outline of a sphere and, unless there are many spheres, the three circles through the ends of two half axes each.
  circles(i) {
    if (this.areMany) return [this.outline(i)];
    const [a, b, c] = [1, 2, 3].map(v => [this.x[4 * i + v] - this.x[4 * i], this.y[4 * i + v] - this.y[4 * i]]);
    return [this.outline(i), this.around(i, a, b), this.around(i, b, c), this.around(i, c, a)];
  }

  // Of the spheres under a pixel, the one with the nearest center: number, and nearness times 3.
  at(px, py) {
    let found = -1, nearest = -Infinity;
    for (let i = 0; i < this.names.length; ++i) {
      const u = (px - this.x[4 * i]) / this.outlines[3 * i], v = (py - this.y[4 * i] - this.outlines[3 * i + 1] * u) / this.outlines[3 * i + 2];
      if (u * u + v * v <= 1 && this.near[4 * i] > nearest) [found, nearest] = [this.names[i], this.near[4 * i]];
    }
    return [found, 3 * nearest];
  }
}
