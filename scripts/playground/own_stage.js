// The differences between a stage of the reader's own and ours, for the inspector's panel on theirs.

import {StageText} from "../inspect_parts/stage_data.js";

const IMAGE_PLACE = 4;  // of the inspector's captions
const LONGEST_NUMBER = 16, LONGEST_HEAD = 1000;  // characters of a picture's text
const AXES = "xyz", TOLERANCE = 1e-6;  // for 7 decimals calculated from 7 decimals; relative for numbers beyond 1

// A text as our tools write it: no comments, no carriage returns, one blank between words.
export const tidied = text => text.split("\n").map(line => line.replace(/#.*/, "").trim().replace(/[ \t]+/g, " ").replace(/^\+/, "").replace(/^(-?)\./, "$10.")).join("\n");

const pointsOf = text => Float64Array.from(text.firstLines.flatMap(first => text.pointsAt(first, 3).flatMap(words =>
  [0, 1, 2].map(i => words[i] === undefined ? NaN : Number(words[i])))));

// The differences between their text of a stage and ours: indices of vertices, the first difference in words, and the vertices' lines.
export function difference(theirText, ourText) {
  const theirs = new StageText(tidied(theirText)), ours = new StageText(ourText), points = pointsOf(theirs), right = pointsOf(ours);
  const lines = Int32Array.from(theirs.firstLines.flatMap(first => [0, 1, 2].map(v => first + v))), isCompared = points.length === right.length;
  const differing = [];
  let first = isCompared ? "" : `${points.length / 9} triangles in place of ${right.length / 9}`;
  for (let vertex = 0; isCompared && vertex < lines.length; ++vertex) {
    const at = 3 * vertex;
    const axis = [0, 1, 2].find(i => !(Math.abs(points[at + i] - right[at + i]) <= TOLERANCE * Math.max(1, Math.abs(right[at + i]))));
    if (axis === undefined) continue;
    differing.push(vertex);
    first = first || `line ${lines[vertex]}, ${AXES[axis]} of vertex ${vertex % 3 + 1} of triangle ${Math.floor(vertex / 3)}: ${points[at + axis]} in place of ${right[at + axis]}`;
  }
  return {points, lines, isCompared, differing: Int32Array.from(differing), first};
}

// The red, green and blue of every pixel of a PPM text, P3; throws an error if it is no PPM of that size.
function pixelsIn(text, columns, rows) {
  if (text.length > LONGEST_NUMBER * 3 * columns * rows + LONGEST_HEAD) throw new Error("it is longer than such a picture");
  const [kind, width, height, largest, ...numbers] = text.replace(/#.*/g, "").split(/\s+/).filter(word => word);
  const expected = `P3 ${columns} ${rows} 255`, found = [kind, width, height, largest].join(" ");
  if (found !== expected) throw new Error(`expected a text that begins with ${expected}, found ${found.slice(0, 40).trim() || "nothing"}`);
  if (numbers.length !== 3 * columns * rows) throw new Error(`expected ${3 * columns * rows} numbers behind 255, found ${numbers.length}`);
  const wrong = numbers.find(word => !/^\d{1,3}$/.test(word) || Number(word) > 255);
  if (wrong !== undefined) throw new Error(`expected a number from 0 to 255, found ${wrong.slice(0, 40)}`);
  return Uint8Array.from(numbers, Number);
}

// The inspector's `theirs` for a picture by the reader's own zbuf.
export function theirPictureOf(text, {columns, rows, pixels}) {
  let picture = null, sentence = "", remarks = "", first = -1, count = 0;
  const colorOf = (rgb, p) => [...rgb.subarray(3 * p, 3 * p + 3)].join(" ");
  try {
    picture = pixelsIn(text, columns, rows);
    for (let p = 0; p < columns * rows; ++p) {
      if ([0, 1, 2].every(i => picture[3 * p + i] === pixels[3 * p + i])) continue;
      if (count++ === 0) first = p;
    }
    if (count) remarks = `row ${Math.floor(first / columns)}, column ${first % columns}: ${colorOf(picture, first)} in place of ${colorOf(pixels, first)}`;
    sentence = `${count} of ${columns * rows} pixels differ${count ? `, first ${remarks}` : ""}`;
  } catch (error) {
    sentence = `there is no picture of it: ${error.message}`;
  }
  return theirsIn({tool: "zbuf", place: IMAGE_PLACE, sentence, remarks, picture, isGood: picture !== null && count === 0, count, stages: {}});
}

function theirsIn({tool, place, sentence, remarks, picture, isGood, count, stages}) {
  return {
    folder: `your own ${tool}`, sentence, picture, stages,
    files: [{stage: tool, file: "mine", place, verdict: isGood ? "right" : "differs", isGood, differing: count, largest: "", remarks, matrices: []}],
  };
}

// The inspector's `theirs` for a text. `picture` is the pixels of the picture made of it, or null because of `failure`.
export function theirsOf(tool, place, differences, picture, ourPixels, failure) {
  const {first, differing, isCompared, lines} = differences;
  let pixels = 0;
  for (let p = 0; picture && p < ourPixels.length; p += 3) pixels += [0, 1, 2].some(i => picture[p + i] !== ourPixels[p + i]);
  const isGood = !first && picture !== null && pixels === 0;
  const found = isCompared ? `${differing.length} of ${lines.length} vertices differ` : first;
  const seen = picture ? `${pixels} of ${ourPixels.length / 3} pixels differ` : `there is no picture of it: ${failure}`;
  const sentence = first ? `${found}${isCompared ? `, first ${first}` : ""}; ${seen}` : isGood ? `every vertex is right; ${seen}` :
    `every vertex is right, but ${picture ? `${seen}: look at its other lines and numbers` : `the stages after it do not take it: ${failure}`}`;
  return theirsIn({tool, place, sentence, remarks: first, picture, isGood, count: differing.length, stages: {[tool]: differences}});
}
