// zbuf's image and every fragment of its pixels, counted row by row from the top left.

import {fragmentsOf} from "./fragments.js";
import {bytesOf} from "./pack.js";

const FATES = ["kept", "lost, behind", "lost, equal and later than", "lost, before the front limit", "lost, beyond the rear limit", "lost, nearer by too little than"];
const BEYOND_LIMITS = new Set([3, 4]);
const LOST_TO = new Set([1, 2, 5]);  // fates that name another triangle

export class FragmentData {
  // `spheres` are the numbers that belong to spheres.
  constructor(data, spheres) {
    Object.assign(this, {columns: data.columns, rows: data.rows, rgb: bytesOf(data.pixels), leftOut: data.leftOut});
    this.spheres = new Set(spheres);
    const {fragments} = data;
    this.areAll = typeof fragments === "string";  // with the fragments that lost
    Object.assign(this, typeof fragments === "string" ? fragmentsOf(fragments, this.columns, this.columns * this.rows) : fragments);
    this.seen = new Int32Array(this.columns * this.rows).fill(-1);    // the last fragment that was kept,
    this.owners = new Int32Array(this.columns * this.rows).fill(-1);  // and its triangle
    this.shownPixels = new Int32Array(data.triangles);                // of each triangle
    this.hasFragment = new Uint8Array(data.triangles);                // 1: within the limits of depth, 2: beyond them, 3: both
    for (let p = 0; p < this.seen.length; ++p) {
      for (let f = this.begins[p]; f < this.begins[p + 1]; ++f) {
        this.hasFragment[this.triangles[f]] |= BEYOND_LIMITS.has(this.fates[f]) ? 2 : 1;
        if (this.fates[f] === 0) this.seen[p] = f;
      }
      if (this.seen[p] < 0) continue;
      this.owners[p] = this.triangles[this.seen[p]];
      ++this.shownPixels[this.owners[p]];
    }
    this.ends = this.shownPixels.slice();  // `order[k]` shows `name` for ends[name] - shownPixels[name] <= k < ends[name]
    for (let name = 1; name < this.ends.length; ++name) this.ends[name] += this.ends[name - 1];
    const next = this.ends.map((end, name) => end - this.shownPixels[name]);
    this.order = new Int32Array(this.ends.at(-1) || 0);
    this.owners.forEach((owner, p) => { if (owner >= 0) this.order[next[owner]++] = p; });
  }

  // "triangle 3" or "sphere 3".
  called(name) { return `${this.spheres.has(name) ? "sphere" : "triangle"} ${name}`; }

  // Every fragment of a pixel as it arrived: its triangle, depth, fate in words, and whether the pixel shows it.
  fragmentsOf(p) {
    const found = [];
    let winner = -1;
    for (let f = this.begins[p]; f < this.begins[p + 1]; ++f) {
      const fate = this.fates[f], triangle = this.triangles[f];
      found.push({triangle, depth: this.depths[f], isSeen: f === this.seen[p], fate: FATES[fate] + (LOST_TO.has(fate) ? ` ${this.called(winner)}` : "")});
      if (fate === 0) winner = triangle;
    }
    return found;
  }

  // The pixels that show a triangle.
  pixelsOf(name) { return name < 0 ? [] : this.order.subarray(this.ends[name] - this.shownPixels[name], this.ends[name]); }

  place(p) { return {row: Math.floor(p / this.columns), column: p % this.columns}; }

  told(p) {
    const {row, column} = this.place(p), f = this.seen[p];
    return `row ${row}, column ${column}: ` + (f < 0 ? "background" : `${this.called(this.triangles[f])}, depth ${this.depths[f]}`);
  }
}
