// The exact report of explain on a pixel and a triangle; the same as lib/maths/window.py and lib/explaining/pixel_section.py.

import {Double, Fraction} from "./exact.js";

const FAR_OFF = 10 ** 9;  // a column beyond any picture, since doubles may be infinite

// The pixel centers in NDC, in fractions or in doubles with zbuf's roundings.
class PixelGrid {
  constructor(kind, width, height, left, bottom) {
    const two = kind.of(2), minusTwo = kind.of(-2);
    this.kind = kind;
    this.dx = minusTwo.times(left).over(kind.of(width));
    this.dy = minusTwo.times(bottom).over(kind.of(height));
    this.leftX = left.plus(this.dx.over(two));
    this.topY = kind.of(-1).times(bottom).minus(this.dy.over(two));
  }

  columnAt(x) { return x.minus(this.leftX).over(this.dx); }
  rowAt(y) { return this.topY.minus(y).over(this.dy); }
  xOf(column) { return this.leftX.plus(this.kind.of(column).times(this.dx)); }
  yOf(row) { return this.topY.minus(this.kind.of(row).times(this.dy)); }
}

const compared = (a, b) => a.map((x, i) => x.compare(b[i])).find(sign => sign) || 0;

// The sorted (x, z) where non-horizontal edges cross the line at y; interpolated from the lower end (by y, then x, then z).
function crossings(points, y) {
  const found = [];
  points.forEach((p, i) => {
    const [low, high] = [p, points[(i + 1) % 3]].sort((a, b) => compared([a[1], a[0], a[2]], [b[1], b[0], b[2]]));
    if (low[1].compare(y) > 0 || y.compare(high[1]) > 0 || !low[1].compare(high[1])) return;
    const t = y.minus(low[1]).over(high[1].minus(low[1])), isEnd = !y.compare(high[1]);
    found.push([0, 2].map(axis => isEnd ? high[axis] : low[axis].plus(t.times(high[axis].minus(low[axis])))));
  });
  return found.sort(compared);
}

// The columns where a row enters and leaves a triangle, and the pixels nearest to them, halves going right; null if the row misses it.
// `depth` is set if both are a single point.
function spanOnRow(grid, points, row) {
  const at = grid.kind.of(row), rows = points.map(p => grid.rowAt(p[1])).sort((a, b) => a.compare(b));
  if (rows[0].compare(at) > 0 || at.compare(rows[2]) > 0) return null;
  const met = crossings(points, grid.yOf(row));
  if (met.length < 2) return null;
  const [[leftX, leftZ], [rightX]] = [met[0], met.at(-1)], ends = [grid.columnAt(leftX), grid.columnAt(rightX)], half = grid.kind.of(1).over(grid.kind.of(2));
  const [first, last] = ends.map(column => Math.max(-FAR_OFF, Math.min(column.plus(half).floor(), FAR_OFF)));
  return {left: ends[0], right: ends[1], first, last, depth: leftX.compare(rightX) ? null : leftZ};
}

const OWNING = ["left", "top"];  // by the rule `center`

// The side of the triangle that an edge bounds, from the growth of its edge function to the right and downwards.
const sideOf = (right, down) => right.sign ? (right.sign > 0 ? "left" : "right") : down.sign > 0 ? "top" : "bottom";

// A pixel and a piece of a triangle, by a coverage rule; `names` are the piece's corners, `words` their coordinates.
class PixelOfPiece {
  constructor(grids, coverage, names, words, {column, row}) {
    Object.assign(this, {names, column, row, byCenter: coverage === "center"});
    this.points = words.map(vertex => vertex.map(Fraction.ofWord));
    const corners = this.points.map(p => [grids.exact.columnAt(p[0]), grids.exact.rowAt(p[1])]), [a, b, c] = corners;
    this.doubledArea = b[0].minus(a[0]).times(c[1].minus(a[1])).minus(c[0].minus(a[0]).times(b[1].minus(a[1])));
    const sign = Fraction.of(this.doubledArea.sign > 0 ? 1 : -1);
    this.edges = corners.map((corner, i) => {
      const next = (i + 1) % 3, [right, down] = [0, 1].map(axis => sign.times(corners[next][axis].minus(corner[axis])));
      const value = right.times(Fraction.of(row).minus(corner[1])).minus(down.times(Fraction.of(column).minus(corner[0])));
      const length = right.times(right).plus(down.times(down)).root();
      return {name: `${names[i]}-${names[next]}`, side: sideOf(Fraction.of(0).minus(down), right), value, distance: length.sign ? value.over(length) : value};
    });
    this.hasArea = this.doubledArea.sign !== 0;
    this.distance = this.hasArea ? Math.min(...this.edges.map(edge => edge.distance.number)) : -Infinity;
    this.span = spanOnRow(grids.exact, this.points, row);
    this.spanInDoubles = spanOnRow(grids.inDoubles, words.map(vertex => vertex.map(word => new Double(Number(word)))), row);
    this.isCovered = this.byCenter ? this.hasArea && this.edges.every(edge => this.owns(edge)) : this.spanInDoubles !== null && this.spanInDoubles.first <= column && column <= this.spanInDoubles.last;
  }

  owns({value, side}) { return value.sign > 0 || !value.sign && OWNING.includes(side); }

  edgeLines() {
    const rows = this.edges.map(({name, side, value, distance}) => value.sign ?
      [name, distance.absolute.measured(), `pixels ${value.sign > 0 ? "inside" : "outside"} a ${side} edge`] : [name, "", `exactly on a ${side} edge${this.byCenter ? `: ${OWNING.includes(side) ? "owned" : "not owned"}` : ""}`]);
    const width = Math.max(...rows.map(([, number]) => number.length));
    return rows.map(([name, number, words]) => `  edge ${name}   ${number ? number.padStart(width) + " " : ""}${words}`);
  }

  centerLine() {
    if (!this.hasArea) return "not covered: a triangle without area covers no center";
    const outside = this.edges.filter(edge => edge.value.sign < 0), foreign = this.edges.find(edge => !this.owns(edge));
    if (outside.length) return `not covered: the center is outside edge ${outside.map(edge => edge.name).join(" and edge ")}`;
    if (foreign) return `not covered: points on a ${foreign.side} edge belong to the triangle beyond it`;
    const isOnEdge = this.edges.some(edge => !edge.value.sign);
    return `covered: ${isOnEdge ? "points on left and top edges belong to the triangle" : "the center is inside"}`;
  }

  coverageLines() {
    if (this.byCenter) return ["  " + this.centerLine()];
    const lines = [], {span, spanInDoubles: doubles} = this;
    if (span) lines.push(`  row ${this.row} crosses it from column ${span.left.measured()} to ${span.right.measured()}: pixels ${span.first} to ${span.last} are nearest`);
    if (doubles && !(span && doubles.first === span.first && doubles.last === span.last))
      lines.push(`  in doubles, as zbuf calculates, from ${doubles.left.number} to ${doubles.right.number}: pixels ${doubles.first} to ${doubles.last}`);
    if (!doubles) return [...lines, `  not covered: the line through the centers of row ${this.row} does not cross the triangle${span ? " in doubles" : ""}`];
    if (!this.isCovered) return [...lines, `  not covered: ${this.column} is ${this.column < doubles.first ? "left" : "right"} of these`];
    return [...lines, `  covered: ${this.column} is one of these${this.edges.some(edge => edge.value.sign < 0) ? ", although its center is outside" : ""}`];
  }

  depthLines() {
    const {spanInDoubles: doubles, span} = this;
    if (doubles && doubles.depth && !this.byCenter) {
      const depth = span && span.depth ? span.depth : Fraction.ofDouble(doubles.depth.number);
      return [`  depth = ${depth.fixed(10)}, where the row meets the triangle in a single point`];
    }
    if (!this.hasArea) return [];
    const [ab, bc, ca] = this.edges.map(edge => edge.value.over(this.doubledArea.absolute)), weights = [bc, ca, ab];
    const depth = weights.reduce((sum, weight, i) => sum.plus(weight.times(this.points[i][2])), Fraction.of(0));
    return [`  depth = ${weights.map((weight, i) => `${weight.measured()} z${this.names[i]}`).join(" + ").replaceAll("+ -", "- ")} = ${depth.fixed(10)}`];
  }
}

// Rows of words as lines, each column aligned on the left.
function alignedLeft(rows) {
  const widths = rows[0].map((_, i) => Math.max(...rows.map(row => row[i].length)));
  return rows.map(row => ("  " + row.map((word, i) => word.padEnd(widths[i])).join("   ")).trimEnd());
}

export class PixelReport {
  constructor({columns, rows, limits, coverage}, fragments, stage) {
    Object.assign(this, {fragments, stage, coverage});
    this.grids = {exact: new PixelGrid(Fraction, columns, rows, ...limits.map(Fraction.ofWord)),
                  inDoubles: new PixelGrid(Double, columns, rows, ...limits.map(word => new Double(Number(word))))};
  }

  // About triangle `name`; `corners` has the names of the corners of its pieces.
  lines(name, corners, pixel) {
    const place = this.fragments.place(pixel), lines = this.beginning(pixel), fragments = this.fragments.fragmentsOf(pixel);
    const pieces = [...this.stage.piecesOf(name)].slice(0, corners.length);
    if (pieces.length) {
      const shown = pieces.map((piece, i) => new PixelOfPiece(this.grids, this.coverage, corners[i], this.stage.wordsOf(piece), place))
        .reduce((best, next) => next.isCovered > best.isCovered || (next.isCovered === best.isCovered && next.distance > best.distance) ? next : best);
      const isDrawn = fragments.some(({triangle}) => triangle === name);
      lines.push(...(shown.hasArea ? shown.edgeLines() : []), ...shown.coverageLines());
      if (shown.isCovered !== isDrawn) lines.push(`  zbuf itself: ${isDrawn ? "covered" : "not covered"}`);
      if (shown.isCovered || isDrawn) lines.push(...shown.depthLines());
    }
    return [...lines, ...this.winnerLines(fragments, name)];
  }

  background(pixel) { return [...this.beginning(pixel), ...this.winnerLines(this.fragments.fragmentsOf(pixel), -1)].join("\n"); }

  beginning(pixel) {
    const {column, row} = this.fragments.place(pixel), {exact} = this.grids;
    return [`PIXEL    ${column},${row}: its center is at column ${column}, row ${row} of the window, at (${exact.xOf(column).short()} ${exact.yOf(row).short()}) in NDC`];
  }

  winnerLines(fragments, name) {
    if (!fragments.length) return ["no triangle covers this pixel: it shows the background"];
    let seen = null;
    const rows = fragments.map(fragment => {
      let {fate} = fragment;
      if (fate === "kept") {
        fate = seen ? `kept, nearer than triangle ${seen.triangle}` : "kept, the first one";
        seen = fragment;
      }
      return [fragment.triangle === name ? "->" : "", `triangle ${fragment.triangle}`, `depth ${fragment.depth}`, fate];
    });
    return ["  at this pixel, in the order they are drawn:", ...alignedLeft(rows), "  " + this.verdict(fragments, seen, name)];
  }

  verdict(fragments, seen, name) {
    if (!seen) return "none of them is between the limits: the pixel shows the background";
    const own = fragments.filter(({triangle}) => triangle === name), shows = `the pixel shows triangle ${seen.triangle}`;
    if (!own.length || seen.triangle === name) return shows;
    const nearest = own.reduce((best, next) => next.depth < best.depth ? next : best);
    if (nearest.depth > seen.depth) return `${shows}: ${seen.depth} is nearer than ${nearest.depth}`;
    return nearest.depth === seen.depth ? `${shows}: it is as near and came earlier` : shows;
  }
}
