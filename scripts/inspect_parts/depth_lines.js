// The rows of z_buffer.txt, cut to the depths around a column: a row has one for every pixel that shows a triangle.

import {Lines} from "./stage_data.js";

const DEPTHS_BEFORE = 2, DEPTHS_SHOWN = 24;

export class DepthLines {
  constructor(text, fragments) {
    this.lines = new Lines(text);
    this.length = this.lines.length;
    this.fragments = fragments;
    this.pixel = -1;
  }

  line(row) {
    const words = this.lines.line(row).split("\t").filter(word => word), {row: ownRow, column} = this.fragments.place(Math.max(0, this.pixel)), at = this.indexOf(row, column);
    const first = Math.max(0, at - DEPTHS_BEFORE), shown = words.slice(first, first + DEPTHS_SHOWN);
    if (this.pixel >= 0 && row === ownRow && this.fragments.seen[this.pixel] >= 0) shown[at - first] = `[${shown[at - first]}]`;
    return [...(first > 0 ? ["…"] : []), ...shown, ...(first + DEPTHS_SHOWN < words.length ? ["…"] : [])].join("  ");
  }

  // How many pixels left of a column have a depth.
  indexOf(row, column) {
    const begin = row * this.fragments.columns;
    return this.fragments.seen.subarray(begin, begin + column).reduce((count, f) => count + (f >= 0), 0);
  }
}
