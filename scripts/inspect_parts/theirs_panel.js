// A student's stages over ours: the judge's verdict, and the differences.

import {element} from "./element.js";
import {bytesOf, intsOf, realsOf} from "./pack.js";

const MOST_LISTED = 500;  // vertices of a stage
const FACES = [["our image", "show theirs"], ["their image", "show what differs"], ["where theirs differs", "show ours"]];

export class TheirsPanel {
  // Calls `select(name)` when a triangle is chosen.
  constructor({box, theirs, panels, pictures, captions, button, select}) {
    Object.assign(this, {box, theirs, select});
    box.append(element("p", {}, `${theirs.folder}: ${theirs.sentence}.`), this.fileTable());
    theirs.files.forEach((file, i) => captions[file.place ?? i].append(element("span", {class: file.isGood ? "good" : "bad", title: file.remarks}, `${file.file}: ${file.verdict}`)));
    for (const {stage, wire} of panels) {
      const given = theirs.stages[stage.tool], {matrices = []} = theirs.files.find(file => file.stage === stage.tool) || {};
      if (!given && !matrices.length) continue;
      box.append(element("h2", {}, stage.tool));
      if (matrices.length) box.append(element("pre", {}, matrices.join("\n")));
      if (given) this.addStage(stage, wire, given);
    }
    if (theirs.picture) this.listenToFaces(button, captions.at(-1).firstChild, pictures);
  }

  fileTable() {
    const body = element("tbody", {}, ...this.theirs.files.map(({stage, file, verdict, isGood, differing, largest, remarks}) => element("tr", {},
      ...[stage, file].map(word => element("td", {}, word)), element("td", {class: isGood ? "good" : "bad"}, verdict), ...[differing ?? "", largest, remarks].map(word => element("td", {}, String(word))))));
    const heads = ["stage", "file", "verdict", "differ", "largest difference", "cause and remarks"];
    return element("table", {}, element("thead", {}, element("tr", {}, ...heads.map(head => element("th", {scope: "col"}, head)))), body);
  }

  addStage(stage, wire, {points, lines, isCompared, differing}) {
    const theirs = realsOf(points), vertices = intsOf(differing), numbers = intsOf(lines);
    wire.layOver(theirs, isCompared, vertices);
    if (!isCompared) return this.box.append(element("p", {}, `${theirs.length / 9} triangles in place of ${stage.names.length}: vertices are not compared`));
    if (!vertices.length) return this.box.append(element("p", {}, "every vertex is ours, to the digits it shows"));
    const coordinates = (all, vertex) => [...all.subarray(3 * vertex, 3 * vertex + 3)].join(" ");
    const rows = [...vertices.subarray(0, MOST_LISTED)].map(vertex => {
      const name = stage.names[Math.floor(vertex / 3)], button = element("button", {"aria-label": `select triangle ${name}`}, String(name));
      button.onclick = () => this.select(name);
      return element("tr", {"data-name": name}, element("td", {}, button), ...[vertex % 3 + 1, numbers[vertex], coordinates(theirs, vertex), coordinates(stage.points, vertex)].map(word => element("td", {}, String(word))));
    });
    this.box.append(element("p", {}, `${vertices.length} of ${numbers.length} vertices differ from ours` + (vertices.length > MOST_LISTED ? `; the first ${MOST_LISTED}:` : ":")),
      element("table", {}, element("thead", {}, element("tr", {}, ...["triangle", "vertex", "their line", "theirs", "ours"].map(head => element("th", {scope: "col"}, head)))), element("tbody", {}, ...rows)));
  }

  // The button shows in turn our image, their image and the pixels that differ.
  listenToFaces(button, title, pictures) {
    const rgb = bytesOf(this.theirs.picture), ours = pictures.fragments.rgb;
    let face = 0;
    button.hidden = false;
    [title.textContent, button.textContent] = FACES[0];
    button.onclick = () => {
      face = (face + 1) % FACES.length;
      [title.textContent, button.textContent] = FACES[face];
      if (face === 2) pictures.showDifferences(rgb); else pictures.showImage(face ? rgb : ours);
    };
  }

  highlight(name) {
    for (const row of this.box.querySelectorAll("[data-name]")) row.classList.toggle("hot", Number(row.dataset.name) === name);
  }
}
