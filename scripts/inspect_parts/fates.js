// The fate of each triangle: one of the legend's kinds, whose color its lines have.

export const KINDS = ["outside", "culled", "thin", "hidden", "shown"];

export class Fates {
  // `view` and `project` are StageData, `limits` the limits of x and y, `culled` the count of triangles that project culled.
  constructor(fragments, [view, project], {limits, isParallel, culled}) {
    Object.assign(this, {fragments, view, project, limits: [...limits.map(limit => Math.abs(Number(limit))), 1], isParallel});
    // Triangles that project passes on have the winding that it does not cull.
    this.culledSign = culled ? -this.windingOf(view.names.find(name => project.has(name))) : NaN;
  }

  // The sign of the volume between a triangle and the eye, or of the triangle's area in a parallel projection.
  windingOf(name) {
    const first = 9 * this.view.piecesOf(name)[0], [ax, ay, az, bx, by, bz, cx, cy, cz] = this.view.points.subarray(first, first + 9);
    if (this.isParallel) return Math.sign((bx - ax) * (cy - ay) - (cx - ax) * (by - ay));
    return Math.sign(ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx));
  }

  kindOf(name) {
    if (this.fragments.shownPixels[name]) return "shown";
    if (this.fragments.hasFragment[name] & 1 || this.fragments.spheres.has(name)) return "hidden";
    if (!this.project.has(name)) return this.windingOf(name) === this.culledSign ? "culled" : "outside";
    if (this.fragments.hasFragment[name] || [...this.project.piecesOf(name)].every(piece => this.liesOutside(piece))) return "outside";
    return this.fragments.areAll ? "thin" : "hidden";
  }

  // Whether all corners of a piece are beyond one limit.
  liesOutside(piece) {
    const p = this.project.points.subarray(9 * piece, 9 * piece + 9);
    return this.limits.some((limit, axis) => [1, -1].some(side => [0, 1, 2].every(v => side * p[3 * v + axis] > limit)));
  }
}
