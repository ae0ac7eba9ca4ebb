// The playground: a scene, a config and options at the left, the output of every stage at the right.

import {element} from "../inspect_parts/element.js";
import {Inspector} from "../inspect_parts/inspector.js";
import {CommandLine} from "./command_line.js";
import {Editor} from "./editor.js";
import {Enlarging} from "./enlarging.js";
import {keep, kept} from "./keeping.js";
import {ROWS} from "./language.js";
import {checked, expectLines, hashOf, kindOf, stateOf} from "./link.js";
import {OwnPanel} from "./own_panel.js";
import {STAGES} from "./pipe.js";
import {PipeClient} from "./pipe_client.js";
import {STEPS} from "./tour.js";
import {VERSION, importerModule, texts, toolModule, workerAddress} from "./resources.js";

const FIRST_SAMPLE = "glass-and-mirrors", FIRST_CONFIG = "320 240\n", EXAMPLE = "worked-example";
const LARGEST_FILE = 1 << 26, LARGE_SCENE = 1e6;  // characters
const SIZE_OF_MODELS = [800, 600];  // that of pipeline picture
const MODEL = /\.(obj|stl|ply|gltf|glb)$/i;
const NO_WORDS = {model: "", view: "", project: "", zbuf: ""};
const PLACE = /^\w[\w-]*: (?:note: )?(<stdin>|config\.txt):(\d+)(?::(\d+))?: /;
const expectFits = size => { if (size > LARGEST_FILE) throw new Error(`it is longer than ${LARGEST_FILE} bytes`); };
const one = selector => document.querySelector(selector);

class Playground {
  constructor({samples, pages, mistakes}, module, worker) {
    this.given = samples;
    this.inspector = null;
    this.editors = {scene: new Editor(one("#scene"), "scene.txt", () => this.editedInput()), config: new Editor(one("#config"), "config.txt", () => this.editedInput())};
    this.isWork = false;  // true if the reader has changed the sample or the link
    this.own = new OwnPanel(this, mistakes);
    this.enlarging = new Enlarging(() => this.look());
    this.watch = new IntersectionObserver(() => this.look());
    this.client = new PipeClient(module, worker, {drawn: picture => this.preview(picture), answered: answer => this.show(answer), busy: isBusy => { one("#stop").hidden = !isBusy; }});
    this.line = new CommandLine(one("#line"), tool => this.client.ask({help: tool}).then(({text}) => text), () => this.editedInput());
    one("#samples").append(...Object.keys(samples).map(name => new Option(name, name)));
    one("#version").textContent = VERSION;
    this.fillLanguage(pages);
    this.listen();
  }

  get config() { return this.editors.config.text; }

  get isTraced() { return this.line.isTraced; }

  get state() { return {version: VERSION, scene: this.editors.scene.text, config: this.config, words: this.line.words, ...this.own.state}; }

  set state({scene, config, words, mine, others}) {
    this.own.state = {mine, others};
    this.editors.scene.text = scene;
    this.editors.config.text = config;
    this.line.words = words;
    one("#samples").value = "";
    this.runAfterEdit();
  }

  async start() {
    const before = kept(checked), linked = await this.linked();
    if (before) this.open(before.state, before.isWork);
    else if (linked.state) this.open(linked.state);
    else this.choose(FIRST_SAMPLE, FIRST_CONFIG);
    if (linked.problem) this.tell(linked.problem);
  }

  async linked() {
    try {
      return {state: await stateOf(location.hash)};
    } catch (error) {
      return {problem: `The link cannot be read: ${/^it /.test(error.message) ? error.message : "it is cut off or damaged"}.`};
    }
  }

  keep() { return keep(this.state, this.isWork); }

  // Opens a state from a link or a file.
  open(state, isWork = false) {
    if (this.isWork) this.keep();
    this.isWork = isWork;
    this.state = state;
    if (state.version !== VERSION) this.tell(`Made with version ${state.version}; this is ${VERSION}.`);
  }

  choose(name, size) {
    const {scene, config, isTraced} = this.given[name];
    if (this.isWork) this.keep();
    this.isWork = this.own.drafts.size > 0;
    this.state = {scene, config: size || config, words: isTraced ? {...NO_WORDS, trace: ""} : NO_WORDS};
    one("#samples").value = name;
  }

  // Lists the words of scenes and configs, and the pages on them.
  fillLanguage(pages) {
    for (const [title, rows] of ROWS)
      one("#language table").append(element("tbody", {}, element("tr", {}, element("th", {colspan: 2, scope: "rowgroup"}, title)), ...rows.map(([words, line]) => element("tr", {}, element("td", {}, element("code", {}, words)), element("td", {}, line)))));
    one("#pages").append(...Object.values(pages).map(text => element("li", {}, element("a", {target: "_blank", href: URL.createObjectURL(new Blob([text], {type: "text/plain;charset=utf-8"}))}, text.slice(2, text.indexOf("\n"))))));
  }

  listen() {
    one("#samples").onchange = event => { if (event.target.value) this.choose(event.target.value); };
    one("#example").onclick = () => this.choose(EXAMPLE);
    one("#link").onclick = () => this.copyLink();
    one("#save").onclick = () => this.saveState();
    one("#words").onclick = () => { const {hidden} = one("#language"); one("#language").hidden = !hidden; one("#words").setAttribute("aria-expanded", hidden); };
    // On closing: if work cannot be kept, the browser asks.
    window.addEventListener("beforeunload", event => { if (!this.keep() && this.isWork) event.preventDefault(); });
    document.addEventListener("visibilitychange", () => this.keep());
    one("#picture").onclick = () => one("#image").toBlob(blob => this.save("out.png", blob));
    one("#files").onclick = () => this.saveFiles();
    one("#stop").onclick = () => this.client.stop();
    one("#own").ontoggle = () => this.look();
    this.step = 0;
    one("#tour").onclick = () => { const {hidden} = one("#steps"); one("#steps").hidden = !hidden; one("#tour").setAttribute("aria-expanded", hidden); if (hidden) { this.goToStep(0); one("#after").focus(); } };
    one("#before").onclick = () => this.goToStep(this.step - 1);
    one("#after").onclick = () => this.goToStep(this.step + 1);
    window.addEventListener("hashchange", async () => { const {state, problem} = await this.linked(); if (state) this.open(state); if (problem) this.tell(problem); });
    one("#end").onclick = () => one("#tour").click();
    one("#open").onclick = () => one("#file").click();
    one("#file").onchange = event => this.take(event.target.files);
    document.addEventListener("dragover", event => event.preventDefault());
    document.addEventListener("drop", event => { event.preventDefault(); this.take(event.dataTransfer.files); });
  }

  // Takes files dropped on the page: one by Save, a scene and a config by their names, or a model with the files that it names.
  async take(files) {
    const model = [...files].find(({name}) => MODEL.test(name));
    for (const file of model ? [model] : files) {
      try {
        expectFits(file.size);
        this.tellOfSize(file.name, file.size);
        await (model ? this.takeModel(model.name, files) : this.takeFile(file));
      } catch (error) {
        this.tell(`${file.name} cannot be read: ${error.message}.`);
      }
    }
  }

  async takeModel(name, files) {
    const [columns, rows] = SIZE_OF_MODELS, contents = await Promise.all([...files].map(async file => [file.name, new Uint8Array(await file.arrayBuffer())]));
    const model = {importer: await importerModule(), words: ["--size", `${columns}x${rows}`, "--", name], files: Object.fromEntries(contents)};
    const {scene, told, messages} = await this.client.ask({model});
    if (!scene) return this.tell(messages ? messages[0].line : told);
    expectFits(scene.length);
    this.work({scene, config: `${columns} ${rows}\n`, words: {...NO_WORDS, zbuf: "--coverage center"}, mine: undefined});
    one("#told").prepend(told, " ");
  }

  async takeFile(file) {
    const text = await file.text(), kind = kindOf(text);
    if (file.name.endsWith(".json")) return this.open(checked(JSON.parse(text)), true);
    if (!kind) throw new Error("it is no scene, config, model (OBJ, STL, PLY, glTF) or saved work");
    expectLines(text);
    this.work({[kind]: text});
  }

  // Changes parts of the state, which then counts as the reader's work.
  work(parts) {
    this.isWork = true;
    this.state = {...this.state, ...parts};
  }

  // The last output of a stage; for model, the scene; null if a run must first bring it.
  textOf(tool) {
    if (tool === "scene") return this.editors.scene.text;
    return this.inspector?.data.shown.includes(tool) ? this.inspector.data.stages.find(other => other.tool === tool).text : null;
  }

  // Runs the last state again if the screen, or the reader's own stage, needs texts of more stages.
  look() {
    if (!this.inspector) return;
    const {shown} = this.inspector.data, needed = this.inspector.look();
    this.client.shown = this.own.isInUse ? STAGES : needed;
    if (this.client.shown.every(tool => shown.includes(tool)) || one("#glass").matches(".stale")) return;
    this.client.shown = [...new Set([...shown, ...this.client.shown])];
    if (this.client.running === null) this.client.run(this.client.state, this.client.isQuick);
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
    if (!hash) return this.tell("Too long for an address: use Save, and drop the file on this page.");
    history.replaceState(null, "", hash);
    this.keep();
    const isCopied = await navigator.clipboard.writeText(location.href).then(() => true, () => false), told = isCopied ? "Copied." : "It is in the address now.";
    if (location.protocol !== "file:") return this.tell(told);
    const save = element("button", {}, "Save");
    save.onclick = () => this.saveState();
    this.tell(`${told} It works on this computer only, since this page is a file here. To send your work, take a file: `, save);
  }

  saveState() { this.save("playground.json", new Blob([JSON.stringify(this.state, null, 1)], {type: "application/json"})); }

  async saveFiles() {
    const {zip, messages} = await this.client.ask({saved: this.state});
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

  tell(...parts) { one("#told").replaceChildren(...parts); }

  tellOfSize(name, size) { this.tell(size > LARGE_SCENE ? `${name} has ${(size / 1e6).toFixed(1)} MB: the picture comes first; the panels take seconds, and show a part of more than 20,000 triangles.` : ""); }

  edited() {
    this.isWork = true;
    one("#samples").value = "";
  }

  editedInput() {
    this.edited();
    this.runAfterEdit();
  }

  runAfterEdit() {
    this.own.awaitInput();
    this.run();
  }

  // Shows the picture of a run before its other panels.
  preview({pixels, columns, rows}) {
    if (!this.inspector) return;
    this.inspector.pixels.showImage(pixels, columns, rows);
    one("#glass").classList.add("ahead");
  }

  run() {
    const {scene, config, words} = this.state;
    this.tellOfSize("The scene", scene.length);
    this.client.run({scene, config, words, own: this.own.stage});
  }

  // Shows the worker's answer: the data of an Inspector, or the stage that failed.
  show({data, failed, messages}) {
    this.keep();
    this.showMessages(messages, failed);
    one("#glass").classList.toggle("stale", Boolean(failed));
    one("#glass").classList.remove("ahead");
    if (failed && this.inspector) this.inspector.pixels.showImage(this.inspector.data.pixels);  // in place of a newer run's preview
    if (failed && !this.inspector) one("#waiting").textContent = "Nothing to show yet: the messages say why.";
    if (failed) return;
    const kept = this.inspector && this.inspector.dispose(), parts = one("#inspector").content.cloneNode(true), {id} = document.activeElement;
    document.body.style.minHeight = `${document.body.scrollHeight}px`;  // else the page would scroll up
    one("#glass").replaceChildren(one("#older"), parts);
    if (data.isTraced) one("#glass #pixels figcaption span").textContent = "trace";
    this.inspector = new Inspector(one("#glass"), data, {hasAddress: false, kept, isOnScreen: element => this.enlarging.isOnScreen(element)});
    document.body.style.minHeight = "";
    if (id) document.getElementById(id)?.focus({preventScroll: true});
    this.watch.disconnect();
    for (const panel of one("#glass").querySelectorAll("figure, .text, #drawer")) this.watch.observe(panel);
    document.body.dataset.runs = Number(document.body.dataset.runs || 0) + 1;
    this.enlarging.show();
    this.own.judge(data.theirs, data.columns * data.rows);
    if (this.own.isAgain) this.own.run();
  }

  showMessages(messages, failed) {
    const places = {scene: [], config: []};
    const items = messages.map(({tool, line}) => {
      const found = line.match(PLACE), isError = tool === failed && !/^\w+: note: /.test(line), item = element("li", {class: isError ? "error" : ""});
      const editor = found && (found[1] === "config.txt" ? "config" : tool === "model" ? "scene" : null);
      const shown = tool === "model" ? line.replace("<stdin>", "scene.txt") : line;
      if (!editor) return item.append(shown), item;
      places[editor].push({line: Number(found[2]), column: Number(found[3] || 1), isError, text: line.slice(found[0].length)});
      const button = element("button", {}, shown);
      button.onclick = () => this.editors[editor].goTo(Number(found[2]));
      item.append(button);
      return item;
    });
    if (!items.length) items.push(element("li", {class: "quiet"}, "none"));
    one("#messages").replaceChildren(...items);
    for (const name of ["scene", "config"]) this.editors[name].mark(places[name]);
  }
}

Promise.all([texts(), toolModule(), workerAddress()]).then(async parts => {
  document.body.playground = new Playground(...parts);
  await document.body.playground.start();
  document.body.dataset.ready = "yes";
}).catch(error => { one("#waiting").textContent = `This browser cannot run the tools: ${error.message}`; });
