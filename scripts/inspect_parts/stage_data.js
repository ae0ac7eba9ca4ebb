// A stage's text as numbers: the corners of its triangles, and the lines that belong to each.

import {intsOf} from "./pack.js";
import {Spheres} from "./spheres.js";

// The lines of a text, cut out of it only when they are shown.
export class Lines {
  constructor(text) {
    const starts = [0];
    for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1)) starts.push(at + 1);
    starts.push(text.length + 1);
    Object.assign(this, {text, starts, length: starts.length - 1});
  }

  line(index) { return this.text.slice(this.starts[index], this.starts[index + 1] - 1); }
}

export class StageData {
  // `count` triangles have numbers from 0; a stage may have several pieces of one, or none.
  constructor(stage, count) {
    Object.assign(this, {tool: stage.tool, title: stage.title, guide: stage.guide, labels: stage.labels});
    this.lines = new Lines(stage.text);
    this.numbers = stage.numbers ? intsOf(stage.numbers) : null;
    this.names = intsOf(stage.names);
    this.firstLines = intsOf(stage.firstLines);
    this.points = this.readPoints();
    this.spheres = new Spheres(stage.spheres);
    this.starts = new Int32Array(count + 1);  // piece `order[k]` belongs to triangle `name` for starts[name] <= k < starts[name + 1]
    for (const name of this.names) ++this.starts[name + 1];
    for (let name = 0; name < count; ++name) this.starts[name + 1] += this.starts[name];
    const next = this.starts.slice();
    this.order = new Int32Array(this.names.length);
    this.names.forEach((name, piece) => { this.order[next[name]++] = piece; });
  }

  readPoints() {
    const points = new Float64Array(9 * this.names.length);
    for (let i = 0, at = 0; i < this.names.length; ++i) for (const words of this.wordsOf(i)) for (const word of words) points[at++] = Number(word);
    return points;
  }

  // The x, y and z of a piece's corners, as written. Of a thinned text the lines of all triangles stand one behind the other, after the header.
  wordsOf(piece) {
    const first = this.numbers ? this.numbers.length - 3 * (this.names.length - piece) : this.firstLines[piece] - 1;
    return [0, 1, 2].map(v => this.lines.line(first + v).split(" ", 3));
  }

  piecesOf(name) { return name < 0 ? [] : this.order.subarray(this.starts[name], this.starts[name + 1]); }

  has(name) { return this.piecesOf(name).length > 0 || this.spheres.placeOf(name) >= 0; }

  linesOf(name) {
    if (!this.numbers && this.spheres.placeOf(name) >= 0) return this.spheres.linesOf(name);
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
