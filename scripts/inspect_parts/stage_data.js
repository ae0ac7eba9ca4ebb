// A stage's text as numbers: the corners of its triangles, and the lines of each triangle.

import {intsOf} from "./pack.js";
import {Spheres} from "./spheres.js";

const ZERO = 48, NINE = 57, MINUS = 45;  // characters

// The lines of a text, cut out of it only when they are shown.
export class Lines {
  constructor(text) {
    const starts = [0];
    for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1)) starts.push(at + 1);
    starts.push(text.length + 1);
    Object.assign(this, {text, starts, length: starts.length - 1});
  }

  line(index) { return this.text.slice(this.starts[index], this.starts[index + 1] - 1); }

  // The first three words of `count` lines from line `first` on, counted from 1.
  pointsAt(first, count) { return Array.from({length: count}, (_, i) => this.line(first - 1 + i).split(" ", 3)); }
}

// A text of our own tools, with the lines of each triangle.
export class StageText extends Lines {
  // `names` and `firstLines` are the numbers and first lines of triangles, or pieces of one; `count` is one more than the last number.
  constructor(text) {
    super(text);
    Object.assign(this, {names: [], firstLines: [], spheres: {names: [], firstLines: []}, count: 0});
    let corners = 0;  // lines of the current triangle still to come
    for (let i = 0; i < this.length; ++i) {
      const first = text.charCodeAt(this.starts[i]);
      if (first === MINUS || (first >= ZERO && first <= NINE)) {
        if (corners === 0) {
          this.names.push(this.count++);
          this.firstLines.push(i + 1);
          corners = 3;
        }
        --corners;
        continue;
      }
      const line = this.line(i);
      if (line.startsWith("triangle ")) this.count = Number(line.slice(9));
      if (line === "clipped") corners = 3;  // the whole triangle in clip space; its pieces follow
      if (line === "sphere") {
        this.spheres.names.push(this.count++);
        this.spheres.firstLines.push(i + 2);
        corners = 4;
      }
    }
  }
}

export class StageData {
  // `count` triangles are numbered from 0; a stage may have no piece of a triangle, or several.
  constructor(stage, count) {
    Object.assign(this, {tool: stage.tool, title: stage.title, guide: stage.guide, labels: stage.labels, remark: stage.remark});
    const {names, firstLines, spheres} = this.lines = new StageText(stage.text);
    this.numbers = stage.numbers ? intsOf(stage.numbers) : null;  // of the lines of a thinned text
    const shown = lines => Int32Array.from(lines, line => this.numbers ? this.numbers[line - 1] : line);
    this.names = Int32Array.from(names);
    this.firstLines = shown(firstLines);
    this.points = this.numbersAt(firstLines, 3);
    this.spheres = new Spheres(Int32Array.from(spheres.names), shown(spheres.firstLines), this.numbersAt(spheres.firstLines, 4));
    this.starts = new Int32Array(count + 1);  // piece `order[k]` belongs to triangle `name` for starts[name] <= k < starts[name + 1]
    for (const name of this.names) ++this.starts[name + 1];
    for (let name = 0; name < count; ++name) this.starts[name + 1] += this.starts[name];
    const next = this.starts.slice();
    this.order = new Int32Array(this.names.length);
    this.names.forEach((name, piece) => { this.order[next[name]++] = piece; });
  }

  // The coordinates of the points in the `count` lines from each of `firstLines` on.
  numbersAt(firstLines, count) {
    const points = new Float64Array(3 * count * firstLines.length);
    let at = 0;
    for (const first of firstLines) for (const words of this.lines.pointsAt(first, count)) for (const word of words) points[at++] = Number(word);
    return points;
  }

  // The x, y and z of a piece's corners, as written.
  wordsOf(piece) { return this.lines.pointsAt(this.lines.firstLines[piece], 3); }

  piecesOf(name) { return name < 0 ? [] : this.order.subarray(this.starts[name], this.starts[name + 1]); }

  has(name) { return this.piecesOf(name).length > 0 || this.spheres.placeOf(name) >= 0; }

  linesOf(name) {
    if (this.spheres.placeOf(name) >= 0) return this.spheres.linesOf(name);
    return [...this.piecesOf(name)].flatMap(piece => [0, 1, 2].map(v => this.firstLines[piece] + v));
  }

  // The triangle that a line belongs to, -1 for none.
  nameOfLine(number) {
    let low = 0, high = this.firstLines.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.firstLines[middle] <= number) low = middle + 1; else high = middle;
    }
    return low > 0 && number < this.firstLines[low - 1] + 3 ? this.names[low - 1] : this.spheres.nameOfLine(number);
  }
}
