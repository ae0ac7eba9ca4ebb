// The output of `zbuf --fragments`, as arrays.

const REASONS = ["kept", "behind", "equal", "before", "beyond", "nearer"];  // a fate is an index into these

// The fragments, pixel by pixel from the top left, in the order of arrival; those of pixel p begin at `begins[p]`.
export function fragmentsOf(text, columns, pixelCount) {
  const lines = text.split("\n");
  lines.pop();
  const count = lines.length, begins = new Int32Array(pixelCount + 1);
  const triangles = new Int32Array(count), depths = new Float64Array(count), fates = new Uint8Array(count);
  const pixels = Int32Array.from(lines, line => {
    const [column, row] = line.split(",", 2);
    return parseInt(row, 10) * columns + Number(column);
  });
  for (const p of pixels) ++begins[p + 1];
  for (let p = 0; p < pixelCount; ++p) begins[p + 1] += begins[p];
  const next = begins.slice();
  lines.forEach((line, i) => {  // COLUMN,ROW: triangle N, depth D: kept | COLUMN,ROW: triangle N, depth D: lost, behind triangle M
    const [, , name, , depth, fate, why] = line.split(" "), at = next[pixels[i]]++;
    triangles[at] = parseInt(name, 10);
    depths[at] = parseFloat(depth);
    fates[at] = REASONS.indexOf(why || fate);
  });
  return {begins, triangles, depths, fates};
}
