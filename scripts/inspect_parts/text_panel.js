// A text with line numbers. Only the visible lines are in the document.

const LINE_HEIGHT = 16;

class TextPanel {
  // `nameOf(number)` returns the triangle a line belongs to, -1 for none.
  constructor(box, text, nameOf) {
    Object.assign(this, {box, lines: text.lines, numbers: text.numbers, nameOf});
    this.hot = new Set();
    const spacer = document.createElement("div");
    spacer.style.height = this.lines.length * LINE_HEIGHT + "px";
    this.part = document.createElement("div");
    this.part.className = "lines";
    box.replaceChildren(spacer, this.part);
    box.onscroll = () => this.draw();
    this.draw();
  }

  number(index) { return this.numbers ? this.numbers[index] : index + 1; }

  index(number) { return this.numbers ? this.numbers.indexOf(number) : number - 1; }

  draw() {
    const first = Math.max(0, Math.floor(this.box.scrollTop / LINE_HEIGHT) - 5);
    const end = Math.min(this.lines.length, first + Math.ceil(this.box.clientHeight / LINE_HEIGHT) + 10);
    this.part.style.top = first * LINE_HEIGHT + "px";
    const rows = [];
    for (let i = first; i < end; ++i) {
      const row = document.createElement("div"), number = document.createElement("span");
      number.className = "number";
      number.textContent = this.number(i);
      row.append(number, this.lines[i].slice(0, 4000));
      row.dataset.number = this.number(i);
      if (this.hot.has(this.number(i))) row.className = "hot";
      rows.push(row);
    }
    this.part.replaceChildren(...rows);
  }

  // Marks lines; scrolls to the first of them if it is out of view.
  highlight(numbers, isToBeSeen) {
    this.hot = new Set(numbers);
    if (numbers.length && isToBeSeen) {
      const top = this.index(numbers[0]) * LINE_HEIGHT;
      if (top < this.box.scrollTop || top > this.box.scrollTop + this.box.clientHeight - 4 * LINE_HEIGHT)
        this.box.scrollTop = Math.max(0, top - this.box.clientHeight / 3);
    }
    this.draw();
  }

  listen(point, click) {
    const at = event => {
      const row = event.target.closest("[data-number]");
      return row ? this.nameOf(Number(row.dataset.number)) : -1;
    };
    this.box.onmousemove = event => point(at(event));
    this.box.onmouseleave = () => point(-1);
    this.box.onclick = event => click(at(event));
  }
}
