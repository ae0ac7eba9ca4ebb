// The trees of rays that trace --probe reports, each parsed only when it is shown.

const RAY = /^(\d+),(\d+): ( *)(primary|shadow|mirrored|refracted) weight (\S+) from (\S+) (\S+) (\S+) (.*)$/;

export class RayTrees {
  constructor({step, lines, lights, camera}, columns, rows) {
    Object.assign(this, {step, lights, camera, columns, rows, trees: new Map()});
    for (const line of lines.split("\n")) {
      const place = line.slice(0, line.indexOf(":"));
      if (!this.trees.has(place)) this.trees.set(place, []);
      this.trees.get(place).push(line);
    }
  }

  // The probed column or row nearest to `at`.
  probed(at, count) {
    const first = Math.min(this.step >> 1, count - 1), last = Math.floor((count - 1 - first) / this.step);
    return first + this.step * Math.max(0, Math.min(last, Math.round((at - first) / this.step)));
  }

  // The pixel of the nearest tree, and its rays.
  at({column, row}) {
    const place = [this.probed(column, this.columns), this.probed(row, this.rows)];
    return {place, rays: (this.trees.get(place.join()) || []).map(line => this.read(line))};
  }

  // `to` is a ray's end, null if it meets nothing or was not cast; `towards` is its point at distance 1 if it meets nothing. `triangle`
  // is the number of the triangle or sphere that it meets, -1 if there is none.
  read(line) {
    const [, , , blanks, kind, weight, x, y, z, rest] = line.match(RAY), from = [x, y, z].map(Number), [target, brought] = rest.split(" brings ");
    const hit = target.match(/^to (\w+) (\d+) (\w+) at (\S+) (\S+) (\S+)$/), light = target.match(/^to light (\d+)$/), way = target.match(/^to nothing along (\S+) (\S+) (\S+)$/);
    return {depth: blanks.length / 2, kind, weight: Number(weight), from, target, brought: (brought || "").split(" ").filter(word => word).map(Number),
            to: hit ? hit.slice(4).map(Number) : light ? this.lights[light[1]] || null : null, towards: way && from.map((at, i) => at + Number(way[i + 1])),
            triangle: hit ? Number(hit[2]) : -1};
  }

  // A point of view space in world space.
  inWorld([x, y, z]) {
    const [eye, right, up, forward] = this.camera;
    return eye.map((e, i) => e + x * right[i] + y * up[i] - z * forward[i]);
  }

  // The segments of rays, and the directions in which rays leave the scene, with `place` applied to each point.
  drawing(rays, place = p => p) {
    return rays.filter(ray => ray.target !== "cut").map(({kind, from, to, towards}) => ({kind, from: place(from), to: to && place(to), towards: towards && place(towards)}));
  }
}
