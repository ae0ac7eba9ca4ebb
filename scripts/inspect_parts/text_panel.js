// A text whose lines are numbered. Only the visible lines are in the document.

import {element} from "./element.js";

const LINE_HEIGHT = 16;
const LONGEST = 4000;  // characters of a line

export class TextPanel {
  // `numberOf(index)` is the number shown beside a line, `indexOf(number)` its inverse.
  constructor(box, lines, {numberOf, indexOf}) {
    Object.assign(this, {box, lines, numberOf, indexOf, hot: new Set()});
    const spacer = element("div", {});
    spacer.style.height = lines.length * LINE_HEIGHT + "px";
    this.part = element("div", {class: "lines"});
    this.part.style.setProperty("--digits", Math.max(2, String(numberOf(lines.length - 1)).length));
    box.replaceChildren(spacer, this.part);
    box.onscroll = () => this.draw();
    new ResizeObserver(() => this.draw()).observe(box);
    this.draw();
  }

  draw() {
    const first = Math.max(0, Math.floor(this.box.scrollTop / LINE_HEIGHT) - 5);
    const end = Math.min(this.lines.length, first + Math.ceil(this.box.clientHeight / LINE_HEIGHT) + 10);
    this.part.style.top = first * LINE_HEIGHT + "px";
    const rows = [];
    for (let i = first; i < end; ++i) {
      const number = this.numberOf(i);
      rows.push(element("div", {"data-number": number, class: this.hot.has(number) ? "hot" : ""}, element("span", {class: "number"}, number), this.lines.line(i).slice(0, LONGEST)));
    }
    this.part.replaceChildren(...rows);
  }

  // Marks lines by their numbers; scrolls to the first of them if it is out of view.
  highlight(numbers, isToBeSeen) {
    this.hot = new Set(numbers);
    const index = numbers.length ? this.indexOf(numbers[0]) : -1;
    if (index >= 0 && isToBeSeen) {
      const top = index * LINE_HEIGHT;
      if (top < this.box.scrollTop || top > this.box.scrollTop + this.box.clientHeight - 3 * LINE_HEIGHT)
        this.box.scrollTop = Math.max(0, top - this.box.clientHeight / 3);
    }
    this.draw();
  }

  // Calls `point` and `click` with the number of a line, null for none.
  listen(point, click) {
    const at = event => {
      const row = event.target.closest("[data-number]");
      return row ? Number(row.dataset.number) : null;
    };
    this.box.onpointermove = event => point(at(event));
    this.box.onpointerleave = () => point(null);
    this.box.onclick = event => click(at(event));
  }
}
