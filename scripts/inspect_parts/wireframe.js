// A wireframe of a stage's triangles that can be turned. Hidden lines are drawn, too.

import {KINDS} from "./fates.js";
import {GridIndex} from "./grid_index.js";
import {Ink} from "./ink.js";
import {Turntable} from "./turntable.js";

const WHEEL_STEP = 0.001, TURN_STEP = 0.01, KEY_TURN = 0.1, KEY_ZOOM = 1.15;
const CLICK_REACH = 3;     // pixels that the pointer may move during a click
const MOST_MARKED = 3000;  // vertices that differ
const THEIR_LAYER = KINDS.length;  // of the ink, above those of the kinds
const FADING = 8;          // tones of a ray that leaves the scene
const GIZMO = 22;          // length of the axes in the corner
const AXES = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];

// Two arrays of numbers, one after the other.
function joined(a, b) {
  const all = new Float64Array(a.length + b.length);
  all.set(a);
  all.set(b, a.length);
  return all;
}

export class Wireframe {
  // `pane` has a canvas and another one above it, for marks. The first view is `pose`, if there is one, else `start`. `kindOf(name)` is
  // the fate of a triangle or a sphere, one of KINDS. It is drawn only while `isOnScreen(pane)`, else later by drawIfLate().
  constructor(pane, stage, {start, pose, isOnScreen}, kindOf, palette) {
    Object.assign(this, {pane, stage, isOnScreen, palette, names: stage.names, guide: stage.guide, highlighted: -1, rays: [], theirs: null, index: null, isDirty: false});
    [this.canvas, this.mark] = pane.querySelectorAll("canvas");
    this.view = new Turntable(start, stage.guide, joined(stage.points, stage.spheres.outermost()));
    [this.layers, this.sphereLayers] = [stage.names, stage.spheres.names].map(names => Uint8Array.from(names, name => KINDS.indexOf(kindOf(name))));
    if (pose) this.view.pose = pose;
    [this.x, this.y, this.near] = this.places(3 * stage.names.length);
    new ResizeObserver(() => this.resize()).observe(pane);
    this.resize();
  }

  // Room for the pixels and the nearness of this many points.
  places(count) { return [0, 1, 2].map(() => new Float32Array(count)); }

  // Draws other triangles over these and marks the `vertices` that differ. If both have the same triangles in the same order (`isAlike`),
  // only triangles with a vertex that differs are drawn.
  layOver(points, isAlike, vertices) {
    const all = Int32Array.from({length: points.length / 9}, (_, i) => i), differing = new Set(vertices.map(vertex => Math.floor(vertex / 3)));
    this.theirs = {points, isAlike, vertices: vertices.subarray(0, MOST_MARKED), differing, triangles: isAlike ? [...differing] : all, places: this.places(points.length / 3)};
    this.draw();
  }

  resize() {
    const scale = window.devicePixelRatio || 1, width = Math.max(2, Math.round(this.pane.clientWidth * scale)), height = Math.max(2, Math.round(this.pane.clientHeight * scale));
    if (this.ink && width === this.ink.width && height === this.ink.height) return;
    this.scale = scale;
    this.ink = new Ink(width, height, THEIR_LAYER + 1);
    for (const canvas of [this.canvas, this.mark]) Object.assign(canvas, {width, height});
    this.view.resize(width, height);
    this.draw();
  }

  fit() {
    this.view.fit();
    this.draw();
  }

  // Draws before the browser's next frame, once, however often it is called.
  drawSoon() {
    if (this.isDirty) return;
    this.isDirty = true;
    requestAnimationFrame(() => this.draw());
  }

  drawIfLate() { if (this.isLate) this.draw(); }

  draw() {
    const {ink, x, y, layers, palette} = this, context = this.canvas.getContext("2d");
    this.isDirty = false;
    this.isLate = !this.isOnScreen(this.pane);
    if (this.isLate) return;
    this.index = null;
    this.view.placeAll(this.stage.points, x, y, this.near);
    ink.clear();
    for (let i = 0; i < layers.length; ++i) this.inkTriangle(layers[i], x, y, 3 * i);
    this.inkSpheres();
    if (this.theirs) {
      const {points, places, triangles} = this.theirs;
      this.view.placeAll(points, ...places);
      for (const i of triangles) this.inkTriangle(THEIR_LAYER, places[0], places[1], 3 * i);
    }
    ink.paint(context, palette.numbers("--card"), [...KINDS, "theirs"].map(kind => palette.numbers("--" + kind)));
    this.drawGuide(context);
    if (this.theirs) this.drawDifferences(context);
    this.highlight(this.highlighted);
  }

  // The triangle whose first corner has index `a`.
  inkTriangle(layer, x, y, a) {
    this.ink.line(layer, x[a], y[a], x[a + 1], y[a + 1]);
    this.ink.line(layer, x[a + 1], y[a + 1], x[a + 2], y[a + 2]);
    this.ink.line(layer, x[a + 2], y[a + 2], x[a], y[a]);
  }

  inkSpheres() {
    const {spheres} = this.stage;
    spheres.place(this.view);
    this.sphereLayers.forEach((layer, i) => {
      for (const circle of spheres.circles(i)) for (let k = 1; k < circle.length; ++k) this.ink.line(layer, ...circle[k - 1], ...circle[k]);
    });
  }

  // Draws a dotted line from each of our vertices that differs to theirs, and a dot at theirs.
  drawDifferences(context) {
    const {vertices, places: [x, y]} = this.theirs, color = this.palette.word("--theirs"), radius = 2.5 * this.scale;
    Object.assign(context, {strokeStyle: color, fillStyle: color, lineWidth: this.scale});
    context.setLineDash([2 * this.scale, 3 * this.scale]);
    context.beginPath();
    for (const vertex of vertices) {
      context.moveTo(this.x[vertex], this.y[vertex]);
      context.lineTo(x[vertex], y[vertex]);
    }
    context.stroke();
    context.setLineDash([]);
    context.beginPath();
    for (const vertex of vertices) {
      context.moveTo(x[vertex] + radius, y[vertex]);
      context.arc(x[vertex], y[vertex], radius, 0, 2 * Math.PI);
    }
    context.fill();
  }

  // The camera or the cube with its labels, and the directions of the axes.
  drawGuide(context) {
    const {scale, palette} = this;
    Object.assign(context, {strokeStyle: palette.word("--guide"), lineWidth: 1.25 * scale, font: `${11 * scale}px system-ui, "DejaVu Sans", sans-serif`, textBaseline: "middle"});
    context.beginPath();
    for (const [p, q] of this.guide) {
      context.moveTo(...this.view.place(...p).slice(0, 2));
      context.lineTo(...this.view.place(...q).slice(0, 2));
    }
    context.stroke();
    const write = (text, x, y, color) => {
      Object.assign(context, {strokeStyle: palette.word("--card"), fillStyle: color, lineWidth: 3 * scale});
      context.strokeText(text, x, y);
      context.fillText(text, x, y);
    };
    for (const {at, text} of this.stage.labels) {
      const [x, y] = this.view.place(...at);
      write(text, Math.max(2, Math.min(x + 4 * scale, this.canvas.width - context.measureText(text).width - 2)), y + (text === "eye" ? 9 : -7) * scale, palette.word("--guide"));
    }
    const [x, y] = [34 * scale, this.canvas.height - 34 * scale], directions = this.view.axes();
    for (const [text, axis] of AXES) {
      const [right, up] = directions.map(row => row.reduce((sum, value, i) => sum + value * axis[i], 0)), color = palette.word("--axis-" + text);
      Object.assign(context, {strokeStyle: color, lineWidth: 1.5 * scale});
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + GIZMO * scale * right, y - GIZMO * scale * up);
      context.stroke();
      write(text, x + (GIZMO + 7) * scale * right - 3 * scale, y - (GIZMO + 7) * scale * up, color);
    }
  }

  // Marks all pieces of triangle `name` in two tones, one of which stands out from any color.
  highlight(name) {
    this.highlighted = name;
    const context = this.mark.getContext("2d"), {palette} = this, pieces = this.stage.piecesOf(name);
    context.clearRect(0, 0, this.mark.width, this.mark.height);
    const path = this.outline(pieces, this.x, this.y), sphere = this.stage.spheres.placeOf(name);
    if (sphere >= 0) for (const [x, y] of this.stage.spheres.outline(sphere)) path.lineTo(x, y);
    context.fillStyle = palette.word("--hot-fill");
    context.fill(path);
    this.stroke(context, path, "--hot");
    if (this.theirs && this.theirs.isAlike) this.stroke(context, this.outline(pieces.filter(piece => this.theirs.differing.has(piece)), ...this.theirs.places), "--theirs");
    for (const ray of this.rays) this.drawRay(context, ray);
  }

  // Draws a line to the ray's end and a dot there; if the ray leaves the scene, a fading line of half a pane.
  drawRay(context, {kind, from, to, towards}) {
    const reach = this.view.size / 2 / this.view.zoom, end = to || from.map((at, i) => at + reach * (towards[i] - at));
    const [x, y] = this.view.place(...from), [x1, y1] = this.view.place(...end), tone = "--ray-" + kind, parts = to ? 1 : FADING;
    context.setLineDash(kind === "shadow" ? [3 * this.scale, 4 * this.scale] : []);
    for (let part = 0; part < parts; ++part) {
      const path = new Path2D(), at = step => [x + (x1 - x) * step / parts, y + (y1 - y) * step / parts];
      path.moveTo(...at(part));
      path.lineTo(...at(part + 1));
      context.globalAlpha = 1 - part / parts;
      this.stroke(context, path, tone);
    }
    context.globalAlpha = 1;
    context.setLineDash([]);
    if (!to) return;
    const dot = new Path2D();
    dot.arc(x1, y1, this.scale, 0, 2 * Math.PI);
    this.stroke(context, dot, tone);
  }

  outline(pieces, x, y) {
    const path = new Path2D();
    for (const piece of pieces) {
      const a = 3 * piece;
      path.moveTo(x[a], y[a]);
      path.lineTo(x[a + 1], y[a + 1]);
      path.lineTo(x[a + 2], y[a + 2]);
      path.closePath();
    }
    return path;
  }

  stroke(context, path, tone) {
    for (const [width, color] of [[4.5, "--halo"], [2, tone]]) {
      Object.assign(context, {lineWidth: width * this.scale, strokeStyle: this.palette.word(color), lineJoin: "round"});
      context.stroke(path);
    }
  }

  // Of the triangles and spheres under a point of the canvas, the number of the one with the nearest center; -1 for none.
  triangleAt(x, y) {
    this.index = this.index || new GridIndex(this.x, this.y, this.names.length, this.canvas.width, this.canvas.height);
    let [found, nearest] = this.stage.spheres.at(x, y);
    for (const i of this.index.candidates(x, y)) {
      const near = this.near[3 * i] + this.near[3 * i + 1] + this.near[3 * i + 2];
      if (near > nearest && this.index.contains(i, x, y)) [found, nearest] = [this.names[i], near];
    }
    return found;
  }

  // Calls `point` with the triangle pointed at, `click` with the one clicked, `walk` with 1 or -1 for the next one or the one before.
  listen({point, click, walk}) {
    const {canvas, view} = this;
    let from = null, hasTurned = false;
    const place = event => [event.offsetX * this.scale, event.offsetY * this.scale], at = event => this.triangleAt(...place(event));
    canvas.onpointerdown = event => {
      from = [event.clientX, event.clientY];
      hasTurned = false;
      if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
    };
    canvas.onpointermove = event => {
      if (!from) return point(at(event));
      const [dx, dy] = [event.clientX - from[0], event.clientY - from[1]];
      if (!hasTurned && Math.hypot(dx, dy) < CLICK_REACH) return;
      hasTurned = true;
      from = [event.clientX, event.clientY];
      view.turn(-dx * TURN_STEP, dy * TURN_STEP);
      this.drawSoon();
    };
    canvas.onpointerup = event => {
      if (from && !hasTurned) click(at(event));
      from = null;
    };
    canvas.onpointercancel = () => { from = null; };
    canvas.onpointerleave = () => point(-1);
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      view.approach(Math.exp(-event.deltaY * WHEEL_STEP), ...place(event));
      this.drawSoon();
    }, {passive: false});
    const steps = {ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1};
    const turns = {ArrowLeft: [KEY_TURN, 0], ArrowRight: [-KEY_TURN, 0], ArrowUp: [0, -KEY_TURN], ArrowDown: [0, KEY_TURN]};
    canvas.onkeydown = event => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.shiftKey && event.key in turns) view.turn(...turns[event.key]);
      else if (event.key in steps) walk(steps[event.key]);
      else if (event.key === "+" || event.key === "-") view.approach(event.key === "+" ? KEY_ZOOM : 1 / KEY_ZOOM);
      else if (event.key === "Home") view.fit();
      else return;
      event.preventDefault();
      this.drawSoon();
    };
  }
}
