// The part of a stage's text that the panels get: all, or of a long text the header, all spheres, and one triangle in `step`; of a text that
// no panel shows, `step` is Infinity.

import {textOf} from "./tools.js";

const MINUS = 45, ZERO = 48, NINE = 57, LINE_FEED = 10;
const startsWith = (bytes, at, word) => bytes[at] === word.charCodeAt(0) && [...word].every((letter, i) => bytes[at + i] === letter.charCodeAt(0));

// {text, numbers, pieces, distinct, count, spheres}: the part, its lines' numbers (0 for an added line; null for the whole text), the
// counts of pieces written and of the triangles they belong to, the last triangle's number plus 1, and the count of spheres. Reads bytes:
// as strings, the lines of a million triangles would fill a browser's memory.
export function partOf(bytes, step) {
  const found = {pieces: 0, distinct: 0, count: 0, spheres: 0}, parts = [], numbers = [];
  let corners = 0, before = -1;  // lines of the triangle that are still to come, and the last name
  const take = (start, end, number) => {
    parts.push(textOf(bytes.subarray(start, end)));
    numbers.push(number);
  };
  for (let at = 0, number = 1, isKept = true; at < bytes.length; ++number) {
    const end = (bytes.indexOf(LINE_FEED, at) + 1 || bytes.length + 1) - 1, first = bytes[at], name = found.count;
    if (first === MINUS || (first >= ZERO && first <= NINE)) {
      if (corners === 0) {
        isKept = name % step === 0;
        if (isKept && step > 1) { parts.push(`triangle ${name}`); numbers.push(0); }
        if (name !== before) ++found.distinct;
        before = name;
        ++found.pieces;
        ++found.count;
        corners = 3;
      }
      --corners;
      if (isKept && step > 1) take(at, end, number);
    } else if (startsWith(bytes, at, "triangle ")) {
      found.count = Number(textOf(bytes.subarray(at + 9, end)));
    } else if (startsWith(bytes, at, "clipped")) {
      corners = 3;
      isKept = false;
    } else if (startsWith(bytes, at, "sphere")) {
      if (step > 1) { parts.push(`triangle ${name}`); numbers.push(0); take(at, end, number); }
      isKept = true;
      ++found.spheres;
      ++found.count;
      corners = 4;
    } else if (step > 1 && !found.pieces && !found.spheres && end > at) take(at, end, number);
    at = end + 1;
  }
  return {...found, text: step > 1 ? parts.join("\n") : textOf(bytes), numbers: step > 1 ? Int32Array.from(numbers) : null};
}
