// Assembles the page: all views highlight the triangle or pixel that the pointer is on in one.

import {DepthLines} from "./depth_lines.js";
import {element} from "./element.js";
import {ExplanationPanel} from "./explanation_panel.js";
import {Fates} from "./fates.js";
import {FragmentData} from "./fragment_data.js";
import {FragmentPanel} from "./fragment_panel.js";
import {guideOf, headerOf} from "./guide.js";
import {Legend, fillCounts} from "./legend.js";
import {Palette} from "./palette.js";
import {PicturePanel} from "./picture_panel.js";
import {PixelReport} from "./pixel_report.js";
import {RayPanel} from "./ray_panel.js";
import {RayTrees} from "./ray_trees.js";
import {StageData} from "./stage_data.js";
import {Tabs} from "./tabs.js";
import {TextPanel} from "./text_panel.js";
import {TheirsPanel} from "./theirs_panel.js";
import {Wireframe} from "./wireframe.js";

const STARTS = {
  model: {yaw: -0.6, pitch: 0.45},
  view: {yaw: -0.6, pitch: 0.35},
  project: {yaw: -0.45, pitch: 0.3},
};
const counted = (count, word) => `${count.toLocaleString("en")} ${word}${count === 1 ? "" : "s"}`;
// The stages whose texts a panel needs: colors of wireframes need two.
const NEEDS = {"wire-model": ["model", "view", "project"], "wire-view": ["view", "project"], "wire-project": ["view", "project"], drawer: ["project"],
  "text-model": ["model"], "text-view": ["view"], "text-project": ["project"], "text-zbuf": ["zbuf"]};
const NOTHING = {triangle: -1, pixel: -1};

export class Inspector {
  // `root` has the elements of page.html. It writes to the page's address only if it `hasAddress`. `kept` is the result of dispose() of
  // the inspector before an edit of the scene. `isOnScreen(element)` is false for panels that need not be made yet.
  constructor(root, data, {hasAddress = true, kept = null, isOnScreen = () => true} = {}) {
    Object.assign(this, {root, data, hasAddress, isOnScreen, listening: new AbortController()});
    this.held = NOTHING;
    this.shown = NOTHING;
    this.palette = new Palette(document.documentElement, this.listening.signal);
    this.fillHeader();
    this.header = headerOf(data.stages[0].text);
    const stages = data.stages.slice(0, 3).map(stage => this.stageData(stage));
    this.fragments = new FragmentData(data, stages[0].spheres.names);
    this.fates = new Fates(this.fragments, stages.slice(1), {limits: data.limits, isParallel: this.header.has("ortho"), culled: Number(new Map(data.stages[2].statistics).get("culled"))});
    this.panels = stages.map((stage, i) => this.stagePanel(stage, kept && kept.poses[i]));
    this.pixels = new PicturePanel([...this.all("#pixels .pane")], this.fragments, this.palette);
    this.competitors = new FragmentPanel(this.one("#pixel-place"), this.one("#competitors"), this.fragments);
    this.depthText = this.depthPanel();
    this.explanation = new ExplanationPanel(this.one("#explanation"), data, new PixelReport(data, this.fragments, this.panels[2].stage));
    this.theirs = data.theirs ? this.theirsPanel(data.theirs) : null;
    this.rays = data.rays ? this.rayPanel(data.rays) : null;
    this.tabs = new Tabs(this.one('[role="tablist"]'), () => this.explanation.refresh());
    this.listen();
    this.tabs.show(kept ? kept.tab : 0);
    if (kept && kept.held.triangle < data.triangles && kept.held.pixel < data.columns * data.rows) this.held = kept.held;
    this.show(this.held);
    this.one("#into-address").hidden = !hasAddress;
    if (hasAddress) this.follow(location.hash);
  }

  // Ends the inspector, and returns the state for the next one.
  dispose() {
    this.listening.abort();
    return {held: this.held, tab: this.tabs.shown, poses: this.panels.map(({wire}) => wire.view.pose)};
  }

  // Draws wireframes that have come on the screen, and returns the stages whose texts are needed there.
  look() {
    for (const {wire} of this.panels) wire.drawIfLate();
    return Object.keys(NEEDS).filter(id => this.isOnScreen(this.one("#" + id))).flatMap(id => NEEDS[id]);
  }

  one(selector) { return this.root.querySelector(selector); }

  all(selector) { return this.root.querySelectorAll(selector); }

  fillHeader() {
    const {data} = this, notes = [...data.notes];
    if (data.step > 1) notes.unshift(`Of ${data.triangles} triangles one in ${data.step} is drawn and printed here; pixels know all of them.`);
    this.one("#title").textContent = `${data.scene}: ${counted(data.triangles - data.spheres, "triangle")}${data.spheres ? ` and ${counted(data.spheres, "sphere")}` : ""}, ${data.columns} × ${data.rows} pixels`;
    this.one("#notes").textContent = notes.join(" · ");
    new Legend(this.one("#legend"), data.stages);
    fillCounts(this.one("#counts tbody"), data.stages);
    for (const id of ["image", "depth"])
      this.one("#" + id).setAttribute("aria-label", `${id}, ${data.columns} columns and ${data.rows} rows of pixels; arrow keys go from pixel to pixel`);
  }

  stageData(given) {
    const reach = -new Map(this.data.stages[1].statistics).get("z_min") || 0;  // of the camera, to the farthest vertex
    return new StageData({...given, ...guideOf(given.tool, this.header, reach)}, this.data.triangles);
  }

  stagePanel(stage, pose) {
    const {tool, title, remark} = stage;
    const canvas = element("canvas", {id: "wire-" + tool, tabindex: 0, role: "application", "aria-label": `${title}, wireframe after ${tool}; arrow keys go from triangle to triangle, with Shift they turn it`});
    const pane = element("div", {class: "pane"}, canvas, element("canvas", {"aria-hidden": true}));
    const fit = element("button", {"aria-label": `fit ${title} into its view`, title: "All of it; once more: the smaller of the camera or cube and the triangles"}, "Fit");
    this.one("#stages").append(element("figure", {}, element("figcaption", {}, tool, element("span", {title}, title), element("span", {title: remark}, remark && `(${remark})`), fit), pane));
    const box = element("div", {class: "text", id: "text-" + tool, tabindex: 0, role: "group", "aria-label": `text after ${tool}`});
    this.one("#texts").append(element("section", {}, element("h2", {}, tool, " ", element("span", {}, "lines from 1")), box));
    const wire = new Wireframe(pane, stage, {start: STARTS[tool], pose, isOnScreen: this.isOnScreen}, name => this.fates.kindOf(name), this.palette);
    fit.onclick = canvas.ondblclick = () => wire.fit();
    const {numbers} = stage, text = new TextPanel(box, stage.lines, {
      numberOf: index => numbers ? numbers[index] || "" : index + 1,
      indexOf: number => numbers ? numbers.indexOf(number) : number - 1,
    });
    return {stage, wire, text};
  }

  depthPanel() {
    this.depths = new DepthLines(this.data.stages[3].text, this.fragments);
    const box = element("div", {class: "text", id: "text-zbuf", tabindex: 0, role: "group", "aria-label": "depths, row by row"});
    this.one("#texts").append(element("section", {}, element("h2", {}, "zbuf ", element("span", {}, "z_buffer.txt; rows from 0")), box));
    return new TextPanel(box, this.depths, {numberOf: index => index, indexOf: number => number});
  }

  theirsPanel(theirs) {
    const [model, view, project, image, depth] = this.all("figcaption");
    this.one("#tab-theirs").hidden = false;
    this.one("#legend").append(element("li", {class: "theirs"}, "theirs, where it differs"));
    return new TheirsPanel({box: this.one("#theirs"), theirs, panels: this.panels, pictures: this.pixels, captions: [model, view, project, depth, image],
                            button: this.one("#whose"), select: name => this.select({triangle: name, pixel: -1})});
  }

  rayPanel(given) {
    this.one("#tab-rays").hidden = false;
    this.one("#pixels figcaption span").textContent = "trace";
    return new RayPanel(this.one("#rays-place"), this.one("#rays table"), new RayTrees(given, this.data.columns, this.data.rows));
  }

  // The rays of a pixel, in the table and in the wireframes of world and view space.
  showRays(pixel, triangle) {
    const {trees} = this.rays, rays = this.rays.tell(pixel < 0 ? null : this.fragments.place(pixel), name => this.select({triangle: name, pixel}));
    this.rays.highlight(triangle);
    this.panels[0].wire.rays = trees.drawing(rays, p => trees.inWorld(p));
    this.panels[1].wire.rays = trees.drawing(rays);
  }

  listen() {
    for (const {stage, wire, text} of this.panels) {
      wire.listen({point: name => this.point({triangle: name, pixel: -1}), click: name => this.select({triangle: name, pixel: -1}), walk: step => this.walk(stage, step)});
      const nameOf = number => number === null ? -1 : stage.nameOfLine(number);
      text.listen(number => this.point({triangle: nameOf(number), pixel: -1}, text), number => this.select({triangle: nameOf(number), pixel: -1}));
    }
    this.pixels.listen({point: p => this.point(this.atPixel(p)), click: p => this.select(this.atPixel(p))});
    const help = this.one("#keys");
    this.one("#help").onclick = () => help.showModal();
    const {signal} = this.listening;
    document.addEventListener("keydown", event => {
      if (help.open) return;
      if (event.key === "Escape") this.select(NOTHING);
      if (event.key === "?") help.showModal();
    }, {signal});
    document.addEventListener("click", event => { if (this.root.contains(event.target) && !event.target.closest("canvas, button, table, .text, pre, dialog")) this.select(NOTHING); }, {signal});
    if (this.hasAddress) window.addEventListener("hashchange", () => this.follow(location.hash), {signal});
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw(), {signal});
  }

  redraw() {
    for (const {wire} of this.panels) wire.draw();
    this.pixels.highlight(this.shown.triangle, this.shown.pixel);
  }

  atPixel(p) { return p < 0 ? NOTHING : {triangle: this.fragments.owners[p], pixel: p}; }

  // Shows a triangle or pixel until the pointer leaves it; `source` is a panel that does not scroll.
  point(what, source) { this.show(what.triangle < 0 && what.pixel < 0 ? this.held : what, source); }

  // Holds a triangle or a pixel, and puts it into the address. On the background only the pixel is held.
  select(what) {
    this.held = what;
    const {row, column} = this.fragments.place(what.pixel);
    const hash = what.pixel >= 0 ? `#pixel=${column},${row}` : what.triangle >= 0 ? `#triangle=${what.triangle}` : "";
    if (this.hasAddress && location.hash !== hash) history.replaceState(null, "", hash || location.pathname + location.search);
    this.show(what);
  }

  // To the next triangle that a stage has, or the one before.
  walk(stage, step) {
    const count = this.data.triangles;
    for (let tried = 0, name = this.held.triangle; tried < count; ++tried) {
      name = name < 0 ? (step > 0 ? 0 : count - 1) : (name + step + count) % count;
      if (stage.has(name)) return this.select({triangle: name, pixel: -1});
    }
  }

  show(what, source) {
    const {triangle, pixel} = this.shown = what;
    if (this.rays) this.showRays(pixel, triangle);
    for (const {stage, wire, text} of this.panels) {
      wire.highlight(triangle);
      text.highlight(stage.linesOf(triangle), text !== source);
    }
    this.pixels.highlight(triangle, pixel);
    this.competitors.tell(pixel, name => this.select({triangle: name, pixel}));
    this.competitors.highlight(triangle);
    this.depths.pixel = pixel;
    this.depthText.highlight(pixel < 0 ? [] : [this.fragments.place(pixel).row], true);
    this.explanation.tell(triangle, pixel);
    if (this.theirs) this.theirs.highlight(triangle);
    this.one("#status").textContent = this.told(what);
    document.body.dataset.triangle = triangle;
  }

  told({triangle, pixel}) {
    const parts = pixel >= 0 ? [this.fragments.told(pixel)] : [];
    if (triangle >= 0 && pixel < 0) parts.push(this.fragments.called(triangle));
    if (triangle >= 0) parts.push(this.fateOf(triangle));
    return parts.join(": ");
  }

  fateOf(name) {
    const count = this.fragments.shownPixels[name];
    if (count) return `shown in ${count} pixel${count === 1 ? "" : "s"}`;
    if (this.fragments.hasFragment[name] & 1) return "hidden in all its pixels";
    const {stage} = this.panels[2];
    return !stage.numbers && !stage.piecesOf(name).length ? "dropped by project: outside or culled" : "without a pixel: outside, or too thin";
  }

  // "#pixel=COLUMN,ROW" or "#triangle=N" in the address selects one.
  follow(hash) {
    const pixel = hash.match(/^#pixel=(\d+),(\d+)$/), triangle = hash.match(/^#triangle=(\d+)$/);
    if (pixel && Number(pixel[1]) < this.fragments.columns && Number(pixel[2]) < this.fragments.rows)
      this.select(this.atPixel(Number(pixel[2]) * this.fragments.columns + Number(pixel[1])));
    if (triangle && Number(triangle[1]) < this.data.triangles) this.select({triangle: Number(triangle[1]), pixel: -1});
  }
}
