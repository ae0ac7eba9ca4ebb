// The command line of the pipe, to read, edit and copy. The options of a tool come from its own --help-all.

import {element} from "../inspect_parts/element.js";
import {quoted} from "../inspect_parts/explanation_panel.js";
import {STAGES, wordsOf} from "./pipe.js";

const OWN = /^--(help|version|timing|stats|fragments|image|z-buffer|seen|depth-image|depth-array|framed|expect-framed|bare|first|threads|rows)$/;
const OPTION = /^ {2}(?:-\w,)?(--[a-z-]+)(?: (\S+(?: [A-Z]\S*)*))?(?: {2,}|$)/;
const FILES = {model: "< scene.txt", zbuf: "config.txt", trace: "config.txt"};
const TOOLS = [...STAGES, "trace"];

// [words, description] for each option in a tool's --help-all; an option with a choice of values has a pair for each value.
export function optionsIn(help) {
  const lines = help.split("\n"), found = [];
  lines.forEach((line, i) => {
    const [beginning, name, values] = line.match(OPTION) || [];
    if (!name || OWN.test(name)) return;
    let end = i + 1;
    while (/^ {20}/.test(lines[end])) ++end;
    const told = [line.slice(beginning.length), ...lines.slice(i + 1, end)].map(part => part.trim()).join(" ").trim();
    const choices = values && values.includes("|") ? values.split("|") : [values || ""];
    // A value may have a sentence of its own: "auto: cut only ... near: cut all ...".
    const ownOf = value => /^\w+$/.test(value) && told.split(new RegExp(`(?:^| )${value}: `))[1];
    found.push(...choices.map(value => [`${name} ${value}`.trim(), ownOf(value) ? ownOf(value).split(/[.;] | \w+: | \(/)[0] : told.split(/[.;:] | \(/)[0]]));
  });
  return found;
}

export class CommandLine {
  // `helpOf(tool)` returns a promise of the tool's help. Calls `changed` after each edit.
  constructor(box, helpOf, changed) {
    Object.assign(this, {inputs: new Map(), parts: new Map()});
    TOOLS.forEach((tool, i) => {
      const input = element("input", {placeholder: "options", spellcheck: false, "aria-label": `options of ${tool}`});
      const menu = element("select", {"aria-label": `add an option of ${tool}`}, new Option("+", ""));
      input.oninput = changed;
      helpOf(tool).then(help => { menu.append(...optionsIn(help).map(([words, told]) => new Option(`${words}  ${told}`, words))); });
      menu.onchange = () => {
        input.value = `${input.value} ${menu.value}`.trim();
        menu.value = "";
        input.focus();
        const [blank] = input.value.match(/ [A-Z][A-Z:,]*$/) || [];  // to be filled in first
        if (blank) input.setSelectionRange(input.value.length - blank.length + 1, input.value.length);
        else changed();
      };
      const part = element("span", {}, element("label", {}, (i > 0 ? "| " : "") + tool, input), menu, FILES[tool] || "");
      box.append(part);
      this.inputs.set(tool, input);
      this.parts.set(tool, part);
    });
    this.drawing = element("select", {"aria-label": "drawn by"}, new Option("project | zbuf", ""), new Option("trace (rays: shadows, mirrors, glass, spheres)", "trace"));
    this.drawing.onchange = () => { this.isTraced = this.drawing.value === "trace"; changed(); };
    this.isTraced = false;
    box.append(this.drawing);
    const copy = element("button", {}, "Copy command");
    copy.onclick = () => navigator.clipboard.writeText(this.text).then(() => { copy.textContent = "Copied"; setTimeout(() => { copy.textContent = "Copy command"; }, 1500); });
    box.append(copy);
  }

  get isTraced() { return this.drawing.value === "trace"; }

  set isTraced(isTraced) {
    this.drawing.value = isTraced ? "trace" : "";
    for (const tool of ["project", "zbuf", "trace"]) this.parts.get(tool).hidden = (tool === "trace") !== isTraced;
  }

  // `trace` has words only if it draws.
  get words() {
    const tools = this.isTraced ? TOOLS : STAGES;
    return Object.fromEntries(tools.map(tool => [tool, this.inputs.get(tool).value]));
  }

  set words(words) {
    for (const [tool, input] of this.inputs) input.value = words[tool] || "";
    this.isTraced = typeof words.trace === "string";
  }

  // The pipe as a shell's command line.
  get text() { return (this.isTraced ? ["model", "view", "trace"] : STAGES).map(tool => [tool, ...wordsOf(this.inputs.get(tool).value).map(quoted), ...(FILES[tool] ? [FILES[tool]] : [])].join(" ")).join(" | "); }
}
