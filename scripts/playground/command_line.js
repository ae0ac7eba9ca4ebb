// The command line of the pipe, to read, to edit and to copy. What a tool can be told comes from its own --help.

import {STAGES} from "./pipe.js";

const OWN = /^--(help|version|timing|stats|fragments|image|z-buffer|seen|depth-image|depth-array|framed|expect-framed|bare|first|threads|rows)$/;
const OPTION = /^ {2}(?:-\w,)?(--[a-z-]+)(?: (\S+(?: [A-Z]\S*)*))?(?: {2,}|$)/;
const FILES = {model: "< scene.txt", zbuf: "config.txt"};

// The words that a tool takes, of the text of its --help: a choice is one for each of its values.
export function optionsIn(help) {
  return help.split("\n").map(line => line.match(OPTION)).filter(found => found && !OWN.test(found[1])).flatMap(([, name, values]) =>
    !values ? [name] : values.includes("|") ? values.split("|").map(value => `${name} ${value}`) : [`${name} ${values}`]);
}

export class CommandLine {
  // `helpOf(tool)` gives a promise of its --help; `changed` is called after each edit.
  constructor(box, helpOf, changed) {
    Object.assign(this, {box, inputs: new Map()});
    STAGES.forEach((tool, i) => {
      const label = document.createElement("label"), input = document.createElement("input"), menu = document.createElement("select");
      input.placeholder = "options";
      input.spellcheck = false;
      input.oninput = changed;
      input.setAttribute("aria-label", `options of ${tool}`);
      menu.setAttribute("aria-label", `add an option of ${tool}`);
      menu.append(new Option("+", ""));
      helpOf(tool).then(help => { menu.append(...optionsIn(help).map(word => new Option(word, word))); });
      menu.onchange = () => {
        input.value = `${input.value} ${menu.value}`.trim();
        menu.value = "";
        input.focus();
        changed();
      };
      label.append((i > 0 ? "| " : "") + tool, input);
      box.append(label, menu, ...(FILES[tool] ? [document.createTextNode(FILES[tool])] : []));
      this.inputs.set(tool, input);
    });
    const copy = document.createElement("button");
    copy.textContent = "Copy command";
    copy.onclick = () => navigator.clipboard.writeText(this.text).then(() => { copy.textContent = "Copied"; setTimeout(() => { copy.textContent = "Copy command"; }, 1500); });
    box.append(copy);
  }

  get words() { return Object.fromEntries([...this.inputs].map(([tool, input]) => [tool, input.value])); }

  set words(words) { for (const [tool, input] of this.inputs) input.value = words[tool]; }

  // As a shell takes it.
  get text() { return STAGES.map(tool => [tool, this.inputs.get(tool).value.trim(), FILES[tool]].filter(word => word).join(" ")).join(" | "); }
}
