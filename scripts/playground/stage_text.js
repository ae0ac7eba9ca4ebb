// A text of our own tools, line by line: which lines belong to which triangle.

const NUMBER = /^[-0-9]/;

export class StageText {
  // `names` and `firstLines` are those of triangles, or of pieces of one; `spheres` has a number and a first line for each; `count` is one
  // more than the last number.
  constructor(text) {
    Object.assign(this, {text, lines: text.split("\n"), names: [], firstLines: [], spheres: [], count: 0});
    let number = 0, corners = 0;  // of the next triangle, and how many lines of the one before are still to come
    this.lines.forEach((line, i) => {
      if (NUMBER.test(line)) {
        if (corners === 0) {
          this.names.push(number++);
          this.firstLines.push(i + 1);
          corners = 3;
        }
        --corners;
      } else if (line.startsWith("triangle ")) {
        number = Number(line.slice(9));
      } else if (line === "clipped") {  // the whole triangle in clip space; its pieces follow
        corners = 3;
      } else if (line === "sphere") {
        this.spheres.push([number++, i + 2]);
        corners = 4;
      }
    });
    this.count = number;
  }

  // Of each sphere the center and the ends of three half axes.
  spherePoints() {
    return this.spheres.flatMap(([, line]) => [0, 1, 2, 3].flatMap(i => this.lines[line - 1 + i].split(" ", 3).map(Number)));
  }
}
