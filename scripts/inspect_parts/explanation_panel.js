// What explain reports on a triangle and a pixel; of a large scene, on the pixel, and the command that prints the rest.

import {asked} from "./asked.js";

// A word of a shell's command line.
export const quoted = word => /^[\w.,\/+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;

export class ExplanationPanel {
  constructor(box, {scene, config, explanations, stages, spheres, explain}, report, ask) {
    const [, cut] = stages[2].statistics.find(([key]) => key === "cut");
    Object.assign(this, {box, scene, config, explanations, spheres, explain, report, ask, isUncut: cut === "0"});
  }

  tell(name, pixel) {
    this.wanted = [name, pixel];
    if (this.box.hidden || String(this.wanted) === this.told) return;
    this.told = String(this.wanted);
    this.box.replaceChildren(...this.texts(name, pixel).map(text => {
      const part = document.createElement("pre");
      part.textContent = text;
      return part;
    }));
    if (this.ask && name >= 0 && !this.spheres) this.box.append(asked("Run it here", () => this.ask(this.words(name, pixel), this.explain.files)));
    this.box.scrollTop = 0;
  }

  // After the panel has come into sight.
  refresh() { if (this.wanted) this.tell(...this.wanted); }

  texts(name, pixel) {
    if (name < 0) return [pixel < 0 ? "Point at a triangle or a pixel." : this.report.background(pixel)];
    if (this.spheres) return ["explain shows the arithmetic of project and zbuf, which draw no spheres: of a scene with spheres it has none."];
    const explanation = this.explanations[name];
    if (!explanation) {
      const command = `The page has no explanation of this triangle. This command prints it:\n\n  ${this.command(name, pixel)}`;
      return [command, ...(pixel >= 0 && this.isUncut ? [this.report.lines(name, [["0", "1", "2"]], pixel).join("\n")] : [])];
    }
    return [explanation.text, ...(pixel < 0 ? [] : [this.report.lines(name, explanation.corners, pixel).join("\n")])];
  }

  command(name, pixel) {
    return ["pipeline", ...this.words(name, pixel).map(quoted)].join(" ");
  }

  words(name, pixel) {
    const {row, column} = pixel < 0 ? {} : this.report.fragments.place(pixel), options = this.explain ? this.explain.options :
      this.report.coverage === "center" ? ["--coverage", "center"] : [];
    return ["explain", this.scene, this.config, ...options, "--triangle", String(name), ...(pixel < 0 ? [] : ["--pixel", `${column},${row}`])];
  }
}
