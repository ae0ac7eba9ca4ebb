// The playground: a scene, a config and options at the left, what every stage makes of them at the right.

import {Inspector} from "../inspect_parts/inspector.js";
import {CommandLine} from "./command_line.js";
import {Editor} from "./editor.js";
import {LONGEST, checked, expectLines, hashOf, stateOf} from "./link.js";
import {PipeClient} from "./pipe_client.js";
import {PythonClient} from "./python_client.js";
import {runCode} from "./sandbox.js";
import {TEMPLATES} from "./templates.js";
import {STEPS} from "./tour.js";
import {VERSION, importerModule, python, samples, toolModule, workerAddress} from "resources";

const FIRST_SAMPLE = "worked-example";
const STORE = "playground", LARGEST_FILE = 1 << 26;
const MODEL = /\.(obj|stl|ply|gltf|glb)$/i;
const NO_WORDS = {model: "", view: "", project: "", zbuf: ""};
const PLACE = /^\w[\w-]*: (?:note: )?(<stdin>|config\.txt):(\d+)(?::(\d+))?: /;
const expectFits = size => { if (size > LARGEST_FILE) throw new Error(`it is longer than ${LARGEST_FILE} bytes`); };
const one = selector => document.querySelector(selector);

class Playground {
  constructor(given, module, worker) {
    this.given = given;
    this.inspector = null;
    this.busy = new Set();
    this.editors = {scene: new Editor(one("#scene"), "scene.txt", () => this.edited()), config: new Editor(one("#config"), "config.txt", () => this.edited())};
    this.own = null;  // {tool, text} that runs in place of a stage
    this.ownRuns = 0;
    this.ownEditor = new Editor(one("#own-text"), "my stage", () => this.editedOwn());
    this.ownEditor.text = TEMPLATES.view;
    this.client = new PipeClient(module, worker, {drawn: picture => this.inspector && this.inspector.pixels.preview(picture), answered: answer => this.show(answer), busy: isBusy => this.setBusy("tools", isBusy)});
    this.python = python && new PythonClient(module, python, isBusy => this.setBusy("Python", isBusy));
    this.line = new CommandLine(one("#line"), tool => this.client.helpOf(tool), () => this.edited());
    one("#samples").append(...Object.keys(given).map(name => new Option(name, name)));
    one("#version").textContent = VERSION;
    this.listen();
  }

  get state() { return {version: VERSION, scene: this.editors.scene.text, config: this.editors.config.text, words: this.line.words, ...this.mine}; }

  // The reader's own stage, if it is more than what was offered.
  get mine() {
    const tool = one("#own-tool").value, kind = one("#own-kind").value, {text} = this.ownEditor;
    return this.own || (kind === "js" && text !== TEMPLATES[tool]) ? {mine: {tool, kind, text}} : {};
  }

  // A stage of one's own waits for Run: it may be someone else's.
  set state({scene, config, words, mine}) {
    const before = this.mine.mine;
    if (!mine || !before || ["tool", "kind", "text"].some(key => mine[key] !== before[key])) this.forgetOwn();
    if (mine) {
      one("#own").open = true;
      one("#own-tool").value = mine.tool;
      one("#own-kind").value = mine.kind;
      this.ownEditor.text = mine.text;
    }
    this.editors.scene.text = scene;
    this.editors.config.text = config;
    this.line.words = words;
    one("#samples").value = "";
    this.runAfterEdit();
  }

  async start() {
    const kept = this.kept(), linked = await this.linked();
    if (kept) this.open(kept);
    else if (linked.state) this.open(linked.state);
    else this.choose(FIRST_SAMPLE);
    if (linked.problem) this.tell(linked.problem);
  }

  async linked() {
    try {
      return {state: await stateOf(location.hash)};
    } catch (error) {
      return {problem: `The link cannot be read: ${/^it /.test(error.message) ? error.message : "it is cut off or damaged"}.`};
    }
  }

  // What was here before this tab was loaded again.
  kept() {
    try {
      const {hash, state} = JSON.parse(sessionStorage.getItem(STORE));
      return hash === location.hash ? checked(state) : null;
    } catch {
      return null;
    }
  }

  keep() {
    try { sessionStorage.setItem(STORE, JSON.stringify({hash: location.hash, state: this.state})); } catch { /* no room, or not allowed */ }
  }

  // A state that came with a link or a file.
  open(state) {
    this.state = state;
    if (state.version !== VERSION) this.tell(`Made with version ${state.version}; this is ${VERSION}.`);
  }

  choose(name) {
    const {scene, config} = this.given[name];
    this.state = {scene, config, words: NO_WORDS};
    one("#samples").value = name;
  }

  listen() {
    one("#samples").onchange = event => { if (event.target.value) this.choose(event.target.value); };
    one("#link").onclick = () => this.copyLink();
    one("#save").onclick = () => this.save("playground.json", new Blob([JSON.stringify(this.state, null, 1)], {type: "application/json"}));
    one("#picture").onclick = () => one("#image").toBlob(blob => this.save("out.png", blob));
    one("#files").onclick = () => this.saveFiles();
    one("#stop").onclick = () => (this.busy.has("tools") ? this.client : this.python).stop();
    this.step = 0;
    one("#tour").onclick = () => { const {hidden} = one("#steps"); one("#steps").hidden = !hidden; one("#tour").setAttribute("aria-expanded", hidden); if (hidden) { this.goToStep(0); one("#after").focus(); } };
    one("#before").onclick = () => this.goToStep(this.step - 1);
    one("#after").onclick = () => this.goToStep(this.step + 1);
    window.addEventListener("hashchange", async () => { const {state, problem} = await this.linked(); if (state) this.open(state); if (problem) this.tell(problem); });
    one("#end").onclick = () => one("#tour").click();
    one("#own-run").onclick = () => this.runOwn();
    one("#own-off").onclick = () => this.setOwn(null);
    for (const menu of ["#own-tool", "#own-kind"]) one(menu).onchange = () => this.offerOwn();
    one("#open").onclick = () => one("#file").click();
    one("#file").onchange = event => this.take(event.target.files);
    document.addEventListener("dragover", event => event.preventDefault());
    document.addEventListener("drop", event => { event.preventDefault(); this.take(event.dataTransfer.files); });
  }

  // Files dropped on the page: what Save wrote, a scene and a config by their names, or a model with the files that it names.
  async take(files) {
    const model = [...files].find(({name}) => MODEL.test(name));
    for (const file of model ? [model] : files) {
      try {
        expectFits(file.size);
        await (model ? this.takeModel(model.name, files) : this.takeFile(file));
      } catch (error) {
        this.tell(`${file.name} cannot be read: ${error.message}.`);
      }
    }
  }

  async takeModel(name, files) {
    const {columns, rows} = this.inspector ? this.inspector.data : {columns: 800, rows: 600};
    const contents = await Promise.all([...files].map(async file => [file.name, new Uint8Array(await file.arrayBuffer())]));
    const model = {importer: await importerModule(), words: ["--size", `${columns}x${rows}`, "--", name], files: Object.fromEntries(contents)};
    const {scene, told, messages} = await this.client.ask({model});
    if (scene) {
      expectFits(scene.length);
      this.state = {...this.state, scene, words: NO_WORDS, mine: undefined};
    }
    this.tell(messages ? messages[0].line : told);
  }

  async takeFile(file) {
    const text = await file.text();
    if (file.name.endsWith(".json")) return this.open(checked(JSON.parse(text)));
    expectLines(text);
    this.state = {...this.state, [/config/.test(file.name) ? "config" : "scene"]: text};
  }

  // Something to begin with: code, or the stage's own text.
  offerOwn() {
    const tool = one("#own-tool").value, isCode = one("#own-kind").value === "js";
    this.setOwn(null);
    this.ownEditor.text = isCode ? TEMPLATES[tool] : this.textOf(tool);
  }

  // What a stage wrote last, or what model reads.
  textOf(tool) {
    const stage = this.inspector && this.inspector.data.stages.find(other => other.tool === tool);
    return tool === "scene" ? this.editors.scene.text : stage ? stage.text : "";
  }

  // What ran is another stage now; a text runs at once, code on Run.
  editedOwn() {
    if (!this.own) return;
    if (one("#own-kind").value === "text") this.runOwn(); else this.setOwn(null);
  }

  // Lets go of the stage, and of one that is still running.
  forgetOwn() {
    ++this.ownRuns;
    this.own = null;
    this.isAgain = this.isCodeRunning = false;
    one("#own-off").disabled = true;
  }

  async runOwn() {
    const tool = one("#own-tool").value, {text} = this.ownEditor, before = {model: "scene", view: "model", project: "view", zbuf: "project"}[tool];
    if (this.line.isTraced) return this.tell("A stage of your own is drawn by project | zbuf.");
    if (one("#own-kind").value === "text") return this.setOwn({tool, text});
    const run = ++this.ownRuns;
    this.isAgain = false;
    this.isCodeRunning = true;
    try {
      const made = await runCode(text, this.textOf(before), this.editors.config.text);
      if (run === this.ownRuns) this.setOwn({tool, text: made});
    } catch (error) {
      if (run !== this.ownRuns) return;
      this.setOwn(null);
      this.tell(`Your ${tool}: ${error.message}`);
    }
  }

  setOwn(own) {
    this.forgetOwn();
    this.own = own;
    one("#own-off").disabled = !own;
    this.run();
  }

  goToStep(step) {
    this.step = Math.max(0, Math.min(STEPS.length - 1, step));
    const {text, sample, edit} = STEPS[this.step];
    one("#step").textContent = `${this.step + 1} of ${STEPS.length}. ${text}`;
    one("#before").disabled = this.step === 0;
    one("#after").disabled = this.step === STEPS.length - 1;
    if (sample) this.choose(sample);
    if (edit) this.state = {...this.state, scene: edit(this.editors.scene.text)};
  }

  async copyLink() {
    const hash = await hashOf(this.state);
    if (hash.length > LONGEST) return this.tell("Too long for an address: use Save, and drop the file on this page.");
    history.replaceState(null, "", hash);
    this.keep();
    await navigator.clipboard.writeText(location.href).then(() => this.tell("Copied."), () => this.tell("It is in the address now."));
  }

  async saveFiles() {
    const {zip, messages} = await this.client.filesOf(this.state);
    if (zip) this.save("pipeline.zip", zip); else this.tell(messages.map(({line}) => line).join(" "));
  }

  save(name, blob) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    this.tell(`Saved as ${name}.`);
  }

  // What is under way, "tools" or "Python", can be stopped.
  setBusy(what, isBusy) {
    if (isBusy) this.busy.add(what); else this.busy.delete(what);
    one("#stop").hidden = !this.busy.size;
  }

  tell(text) { one("#told").textContent = text; }

  edited() {
    one("#samples").value = "";
    this.runAfterEdit();
  }

  // Code of one's own that ran, or runs, runs again when its new input is there.
  runAfterEdit() {
    const isAgain = this.isAgain || this.isCodeRunning || (this.own && one("#own-kind").value === "js");
    if (isAgain) this.forgetOwn();
    this.isAgain = isAgain;
    this.run();
  }

  run() {
    this.tell("");
    const {scene, config, words} = this.state;
    this.client.run({scene, config, words, own: this.own});
  }

  // What the worker answers: the data of an Inspector, or the stage that failed.
  show({data, failed, messages}) {
    this.keep();
    this.showMessages(messages, failed);
    one("#glass").classList.toggle("stale", Boolean(failed));
    if (failed && !this.inspector) one("#waiting").textContent = "Nothing to show yet: the messages say why.";
    if (failed) return;
    const kept = this.inspector && this.inspector.dispose(), parts = one("#inspector").content.cloneNode(true);
    one("#glass").replaceChildren(parts);
    if (data.isTraced) one("#glass #pixels figcaption span").textContent = "trace";
    this.inspector = new Inspector(one("#glass"), data, {hasAddress: false, kept, ask: this.python && ((command, files) => this.python.ask(command, files))});
    document.body.dataset.runs = Number(document.body.dataset.runs || 0) + 1;
    if (this.isAgain) this.runOwn();
  }

  showMessages(messages, failed) {
    const places = {scene: [], config: []};
    const items = messages.map(({tool, line}) => {
      const item = document.createElement("li"), found = line.match(PLACE), isError = tool === failed && !/^\w+: note: /.test(line);
      item.className = isError ? "error" : "";
      const editor = found && (found[1] === "config.txt" ? "config" : tool === "model" ? "scene" : null);
      const shown = tool === "model" ? line.replace("<stdin>", "scene.txt") : line;
      if (!editor) return item.append(shown), item;
      places[editor].push({line: Number(found[2]), column: Number(found[3] || 1), isError, text: line.slice(found[0].length)});
      const button = document.createElement("button");
      button.textContent = shown;
      button.onclick = () => this.editors[editor].goTo(Number(found[2]));
      item.append(button);
      return item;
    });
    if (!items.length) {
      const item = document.createElement("li");
      item.className = "quiet";
      item.textContent = "none";
      items.push(item);
    }
    one("#messages").replaceChildren(...items);
    for (const name of ["scene", "config"]) this.editors[name].mark(places[name]);
  }
}

Promise.all([samples(), toolModule(), workerAddress()]).then(async parts => {
  document.body.playground = new Playground(...parts);
  await document.body.playground.start();
  document.body.dataset.ready = "yes";
}).catch(error => { one("#waiting").textContent = `This browser cannot run the tools: ${error.message}`; });
