// An index of the triangles that may lie under a point: a grid whose cells list them. It is rebuilt whenever
// the view turns; an R-tree would take longer to build, and its library save no code.

const CELL = 16;            // pixels
const MOST_CELLS = 64;      // of a triangle; a larger triangle is a candidate everywhere

export class GridIndex {
  // `x` and `y` have three corners for each of `count` triangles, in pixels.
  constructor(x, y, count, width, height) {
    Object.assign(this, {x, y, columns: Math.ceil(width / CELL), rows: Math.ceil(height / CELL), large: []});
    this.begins = new Int32Array(this.columns * this.rows + 1);
    this.eachCell(count, cell => ++this.begins[cell + 1], i => this.large.push(i));
    for (let cell = 0; cell + 1 < this.begins.length; ++cell) this.begins[cell + 1] += this.begins[cell];
    this.triangles = new Int32Array(this.begins[this.columns * this.rows]);
    const next = this.begins.slice();
    this.eachCell(count, (cell, i) => { this.triangles[next[cell]++] = i; }, () => {});
  }

  eachCell(count, visit, visitLarge) {
    const {x, y} = this;
    for (let i = 0; i < count; ++i) {
      const a = 3 * i, left = Math.max(0, Math.floor(Math.min(x[a], x[a + 1], x[a + 2]) / CELL)), top = Math.max(0, Math.floor(Math.min(y[a], y[a + 1], y[a + 2]) / CELL));
      const right = Math.min(this.columns - 1, Math.floor(Math.max(x[a], x[a + 1], x[a + 2]) / CELL)), bottom = Math.min(this.rows - 1, Math.floor(Math.max(y[a], y[a + 1], y[a + 2]) / CELL));
      if (right < left || bottom < top) continue;
      if ((right - left + 1) * (bottom - top + 1) > MOST_CELLS) {
        visitLarge(i);
        continue;
      }
      for (let row = top; row <= bottom; ++row) for (let column = left; column <= right; ++column) visit(row * this.columns + column, i);
    }
  }

  // The triangles that may contain a point.
  candidates(px, py) {
    const column = Math.floor(px / CELL), row = Math.floor(py / CELL);
    if (column < 0 || row < 0 || column >= this.columns || row >= this.rows) return [];
    const cell = row * this.columns + column;
    return [...this.triangles.subarray(this.begins[cell], this.begins[cell + 1]), ...this.large];
  }

  contains(i, px, py) {
    const {x, y} = this, a = 3 * i, b = a + 1, c = a + 2;
    const s = (x[b] - x[a]) * (py - y[a]) - (y[b] - y[a]) * (px - x[a]);
    const t = (x[c] - x[b]) * (py - y[b]) - (y[c] - y[b]) * (px - x[b]);
    const u = (x[a] - x[c]) * (py - y[c]) - (y[a] - y[c]) * (px - x[c]);
    return (s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0);
  }
}
