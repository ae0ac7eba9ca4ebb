// What became of the triangles, as --stats counts them.

import {element} from "./element.js";

const SIDES = ["left", "right", "below", "above", "near", "far"];

// The legend's counts: label, number, and the terms of its sum. Each triangle, or piece of a cut triangle, is in one count: triangles that
// project finds outside but passes on are counted by zbuf.
function legendOf(stages) {
  const counts = new Map(stages.map(stage => [stage.tool, new Map(stage.statistics.map(([key, word]) => [key, Number(word)]))]));
  counts.get("project").set("dropped", stages[2].missing - counts.get("project").get("culled"));
  const sum = (label, kind, ...terms) => {
    const found = terms.map(([tool, key]) => [tool, key, counts.get(tool).get(key) || 0]).filter(([, , count]) => count > 0);
    return {label, kind, count: found.reduce((total, [, , count]) => total + count, 0), terms: found.map(([tool, key, count]) => `${tool}: ${count} ${key.replaceAll("_", " ")}`)};
  };
  const outside = SIDES.map(side => ["zbuf", "outside_" + side]);
  return [sum("shown", "shown", ["zbuf", "seen"]), sum("hidden", "hidden", ["zbuf", "hidden"]), sum("outside", "outside", ["project", "dropped"], ...outside),
    sum("culled", "culled", ["project", "culled"]), sum("too thin for a pixel", "thin", ["zbuf", "without_area"], ["zbuf", "between_centers"]), sum("cut", "", ["project", "cut"])];
}

export class Legend {
  constructor(list, stages) {
    list.replaceChildren(...legendOf(stages).filter(({label, count}) => count > 0 || /^(shown|hidden|outside|culled)$/.test(label)).map(({label, kind, count, terms}) =>
      element("li", {class: kind, title: terms.join("\n")}, element("b", {}, count.toLocaleString("en")), " " + label)));
  }
}

// The counts of --stats, without zeros: "19 seen, 3 hidden".
function countsOf(statistics) {
  return statistics.filter(([key, word]) => !/^triangles$|_(min|max)$/.test(key) && word !== "0").map(([key, word]) => `${word} ${key.replaceAll("_", " ")}`).join(", ");
}

// "-1.5 to 2", with four digits.
function rangeOf(statistics, axis) {
  const words = new Map(statistics), short = end => String(Number(Number(words.get(`${axis}_${end}`)).toPrecision(4)));
  return words.has(axis + "_min") ? `${short("min")} to ${short("max")}` : "";
}

export function fillCounts(body, stages) {
  const size = bytes => bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
  for (const stage of stages) {
    const row = body.insertRow();
    for (const words of [stage.tool, stage.title, stage.triangles.toLocaleString("en"), size(stage.bytes), stage.seconds > 0 ? `${Math.round(1000 * stage.seconds)} ms` : "< 1 ms",
      countsOf(stage.statistics), ...["x", "y", "z"].map(axis => rangeOf(stage.statistics, axis))]) row.insertCell().textContent = words;
  }
}
