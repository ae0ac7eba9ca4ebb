// The reader's own stages: a text for each stage, as JavaScript and as output. One of them replaces ours.

import {element} from "../inspect_parts/element.js";
import {Editor} from "./editor.js";
import {mistakesIn} from "./mistakes.js";
import {runCode} from "./sandbox.js";
import {TEMPLATES} from "./templates.js";

const BEFORE = {model: "scene", view: "model", project: "view", zbuf: "project"};
const one = selector => document.querySelector(selector);

export class OwnPanel {
  // `page` has `textOf(stage)`, `config`, `isTraced`, `edited()`, called after an edit here, and `run()`, called when the stage changes.
  // `mistakes` are sentences about mistakes, {name: sentence}.
  constructor(page, mistakes) {
    Object.assign(this, {page, mistakes, drafts: new Map(), stage: null, runs: 0});
    [this.tool, this.kind] = [one("#own-tool"), one("#own-kind")];
    this.editor = new Editor(one("#own-text"), "my stage", () => this.edited());
    for (const menu of [this.tool, this.kind]) menu.onchange = () => this.offer();
    one("#own-run").onclick = () => this.run();
    one("#own-off").onclick = () => this.set(null);
    one("#own-anew").onclick = () => { this.drafts.delete(this.name); this.offer(); };
    one("#own-text").addEventListener("keydown", event => { if (event.key === "Enter" && event.ctrlKey) { event.stopPropagation(); event.preventDefault(); this.run(); } }, {capture: true});
    this.editor.text = TEMPLATES.view;
  }

  get name() { return `${this.tool.value} ${this.kind.value}`; }

  // The panel's part of the page's state: all texts of the reader's, whether run or not; the chosen one is `mine`.
  get state() {
    const all = [...this.drafts].map(([name, text]) => ({tool: name.split(" ")[0], kind: name.split(" ")[1], text}));
    const mine = all.find(({tool, kind}) => `${tool} ${kind}` === this.name), others = all.filter(other => other !== mine);
    return {...(mine ? {mine} : {}), ...(others.length ? {others} : {})};
  }

  // A stage that comes with a state runs only after Run: it may be someone else's code.
  set state({mine, others = []}) {
    const before = this.state.mine;
    if (mine ? !before || ["tool", "kind", "text"].some(key => mine[key] !== before[key]) : this.kind.value === "text") this.forget();
    for (const {tool, kind, text} of [...others, ...(mine ? [mine] : [])]) this.drafts.set(`${tool} ${kind}`, text);
    if (!mine) return;
    one("#own").open = true;
    [this.tool.value, this.kind.value, this.editor.text] = [mine.tool, mine.kind, mine.text];
  }

  // Whether it needs the texts of all stages.
  get isInUse() { return one("#own").open || Boolean(this.stage) || this.isAgain || this.isRunning; }

  // Shows the reader's text, or one to begin with: a template, or our stage's output.
  offer() {
    this.set(null);
    this.editor.text = this.drafts.get(this.name) ?? (this.kind.value === "js" ? TEMPLATES[this.tool.value] : this.page.textOf(this.tool.value) ?? "");
  }

  // After an edit, a text runs at once, code on Run.
  edited() {
    this.drafts.set(this.name, this.editor.text);
    this.page.edited();
    if (this.stage && this.kind.value === "text") this.run(); else if (this.stage) this.set(null); else this.forget();
  }

  // Drops the stage, and ignores the result of a run still under way.
  forget() {
    ++this.runs;
    this.stage = this.sentence = null;
    this.isAgain = this.isRunning = false;
    one("#own-off").disabled = true;
    this.tell("");
    this.editor.mark([]);
  }

  // Code that has run, or is running, will run again on its new input.
  awaitInput() {
    const isAgain = this.isAgain || this.isRunning || (this.stage && this.kind.value === "js");
    if (isAgain) this.forget();
    this.isAgain = isAgain;
  }

  async run() {
    const tool = this.tool.value, {text} = this.editor;
    if (this.page.isTraced) return this.tell("A stage of your own is drawn by project | zbuf.");
    if (this.kind.value === "text") return this.set({tool, text});
    this.forget();
    const run = this.runs, printed = one("#own-printed"), input = this.page.textOf(BEFORE[tool]);
    this.isAgain = input === null;
    if (this.isAgain) return this.page.look();
    this.isRunning = true;
    printed.textContent = "";
    try {
      const made = await runCode(text, [input, this.page.config], line => { if (run === this.runs) printed.append(line, "\n"); });
      if (run === this.runs) this.set({tool, text: made});
    } catch (error) {
      if (run !== this.runs) return;
      this.set(null);
      const {line, column} = error, where = line ? `line ${line}, column ${column}: ` : "";
      this.tell(`Your ${tool}: ${where}${error.message}`, "bad");
      if (line) this.editor.mark([{line, column, isError: true, text: error.message}]);
    }
  }

  set(stage) {
    this.forget();
    this.stage = stage;
    one("#own-off").disabled = !stage;
    this.page.run();
  }

  // The verdict on the stage that ran.
  judge(theirs, pixels) {
    if (!this.stage || !theirs || theirs.sentence === this.sentence) return;
    this.sentence = theirs.sentence;
    if (theirs.files[0].isGood) return this.tell(`Solved: all ${pixels} pixels agree.`, "good");
    const told = `${theirs.sentence}. `, button = element("button", {}, "Name the mistake");
    button.onclick = () => this.nameMistake(this.stage, told);
    this.tell(told, "bad");
    one("#own-told").append(button);
  }

  async nameMistake({tool, text}, told) {
    const run = this.runs, names = await mistakesIn(tool, text, [this.page.textOf(BEFORE[tool]), this.page.config]).catch(() => []);
    if (run === this.runs) this.tell(told + (names.map(name => this.mistakes[name]).join(" Or: ") || "It is none of the mistakes that this page has; pipeline compare --hand-in has more."), "bad");
  }

  tell(text, kind = "") { Object.assign(one("#own-told"), {textContent: text, className: kind}); }
}
