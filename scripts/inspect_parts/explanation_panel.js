// The report of explain on a triangle and a pixel; in a large scene on the pixel, with the command that prints it all.

import {element} from "./element.js";

// A word of a shell's command line.
export const quoted = word => /^[\w.,\/+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;

export class ExplanationPanel {
  constructor(box, {scene, config, explanations, stages, spheres, options}, report) {
    const [, cut] = stages[2].statistics.find(([key]) => key === "cut");
    Object.assign(this, {box, scene, config, explanations, spheres, options, report, isUncut: cut === "0"});
  }

  tell(name, pixel) {
    this.wanted = [name, pixel];
    if (this.box.hidden || String(this.wanted) === this.told) return;
    this.told = String(this.wanted);
    this.box.replaceChildren(...this.texts(name, pixel).map(text => element("pre", {}, text)));
    this.box.scrollTop = 0;
  }

  // Called when the panel becomes visible.
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
    const {row, column} = pixel < 0 ? {} : this.report.fragments.place(pixel), options = this.options || (this.report.coverage === "center" ? ["--coverage", "center"] : []);
    return ["pipeline", "explain", this.scene, this.config, ...options, "--triangle", String(name), ...(pixel < 0 ? [] : ["--pixel", `${column},${row}`])].map(quoted).join(" ");
  }
}
