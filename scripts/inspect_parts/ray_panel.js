// A pixel's tree of rays as a table, in which a triangle that a ray meets can be selected.

import {element} from "./element.js";

const short = x => Number(x.toPrecision(4)).toString();

export class RayPanel {
  constructor(title, table, trees) {
    Object.assign(this, {title, body: table.tBodies[0], trees});
  }

  // `place` is null without a pixel. Calls `select(name)` when a triangle is chosen.
  tell(place, select) {
    this.body.replaceChildren();
    if (!place) {
      this.title.textContent = "Point at a pixel to see its rays, here and in the wireframes.";
      return [];
    }
    const {place: [column, row], rays} = this.trees.at(place), isOther = column !== place.column || row !== place.row;
    this.title.textContent = `Rays of row ${row}, column ${column}` +
      (isOther ? `, the nearest pixel of which the page has them (trace --probe ${place.column},${place.row} has those of this one)` : "");
    for (const ray of rays) this.addRow(ray, select);
    return rays;
  }

  addRow({depth, kind, weight, target, brought, triangle}, select) {
    const row = this.body.insertRow(), name = row.insertCell(), what = row.insertCell();
    name.className = "ray " + kind;
    name.style.paddingLeft = `${1.2 * depth}em`;
    name.textContent = kind;
    name.setAttribute("aria-label", `${kind}, level ${depth}`);
    const words = target.replace(/ (at|along) .*/, "").replace(/^to /, "");
    if (triangle >= 0) {
      const button = element("button", {"aria-label": `select ${words}`}, words);
      button.onclick = () => select(triangle);
      what.append(button);
    } else what.textContent = words;
    row.insertCell().textContent = short(weight);
    row.insertCell().textContent = brought.map(short).join(" ");
    row.dataset.name = triangle;
  }

  highlight(name) {
    for (const row of this.body.rows) row.classList.toggle("hot", name >= 0 && Number(row.dataset.name) === name);
  }
}
