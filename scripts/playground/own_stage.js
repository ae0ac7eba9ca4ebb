// A stage of the reader's own in the place of ours: what of it differs, for the inspector's panel on theirs.

import {StageText} from "./stage_text.js";

const AXES = "xyz", TOLERANCE = 1e-6;  // of 7 decimals made from 7 decimals, times the size of the number beyond 1

// A text as our tools write it: no comments, no carriage returns, one blank between words.
export const tidied = text => text.split("\n").map(line => line.replace(/#.*/, "").trim().replace(/[ \t]+/g, " ").replace(/^\+/, "").replace(/^(-?)\./, "$10.")).join("\n");

const pointsOf = text => Float64Array.from(text.firstLines.flatMap(first => [0, 1, 2].flatMap(v => {
  const words = (text.lines[first - 1 + v] || "").split(" ");
  return [0, 1, 2].map(i => words[i] === undefined ? NaN : Number(words[i]));
})));

// How their text of a stage differs from ours: the indices of vertices, in words the first difference, and the lines of the vertices.
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

// What the inspector calls theirs. `picture` has the pixels of their picture, or is null, because of `failure`.
export function theirsOf(tool, place, differences, picture, ourPixels, failure) {
  const {first, differing, isCompared, lines} = differences;
  let pixels = 0;
  for (let p = 0; picture && p < ourPixels.length; p += 3) pixels += [0, 1, 2].some(i => picture[p + i] !== ourPixels[p + i]);
  const isGood = !first && picture !== null && pixels === 0;
  const count = isCompared ? `${differing.length} of ${lines.length} vertices differ` : first;
  const seen = picture ? `${pixels} of ${ourPixels.length / 3} pixels differ` : `there is no picture of it: ${failure}`;
  return {
    folder: `your own ${tool}`, sentence: first ? `${count}${isCompared ? `, first ${first}` : ""}; ${seen}` : isGood ? `every vertex is right; ${seen}` :
      `every vertex is right, but ${picture ? `${seen}: look at its other lines and numbers` : `the stages behind do not take it: ${failure}`}`, picture,
    files: [{stage: tool, file: "mine", place, verdict: isGood ? "right" : "differs", isGood, differing: differing.length, largest: "", remarks: first, matrices: []}],
    stages: {[tool]: differences},
  };
}
