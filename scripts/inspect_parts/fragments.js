// What `zbuf --fragments` says, as arrays.

const REASONS = ["kept", "behind", "equal", "before", "beyond", "nearer"];  // a fate is an index into these

// The fragments pixel by pixel from the top left, each pixel's in the order in which they arrived, its first at `begins`.
export function fragmentsOf(text, columns, pixelCount) {
  const lines = text.split("\n");
  lines.pop();
  const count = lines.length, pixels = new Int32Array(count), begins = new Int32Array(pixelCount + 1);
  const found = {triangles: new Int32Array(count), depths: new Float64Array(count), fates: new Uint8Array(count)};
  const sorted = {triangles: new Int32Array(count), depths: new Float64Array(count), fates: new Uint8Array(count)};
  lines.forEach((line, i) => {  // COLUMN,ROW: triangle N, depth D: kept | COLUMN,ROW: triangle N, depth D: lost, behind triangle M
    const [place, , name, , depth, fate, why] = line.split(" "), [column, row] = place.split(",");
    pixels[i] = parseInt(row, 10) * columns + Number(column);
    ++begins[pixels[i] + 1];
    found.triangles[i] = parseInt(name, 10);
    found.depths[i] = parseFloat(depth);
    found.fates[i] = REASONS.indexOf(why || fate);
  });
  for (let p = 0; p < pixelCount; ++p) begins[p + 1] += begins[p];
  const next = begins.slice();
  for (let i = 0; i < count; ++i) {
    const at = next[pixels[i]]++;
    for (const key in sorted) sorted[key][at] = found[key][i];
  }
  return {begins, ...sorted};
}
