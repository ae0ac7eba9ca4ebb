// A rotatable wireframe of a stage's triangles. It shows their positions; hidden surfaces are zbuf's business.

const styleOf = name => getComputedStyle(document.documentElement).getPropertyValue(name);

// So many times its own size, triangles around the frustum or the cube may shrink it.
const FARTHEST = 20;

class Wireframe {
  constructor(canvas, mark, stage, start) {
    Object.assign(this, {canvas, mark, names: intsOf(stage.names), points: realsOf(stage.points), guide: stage.guide});
    this.yaw = start.yaw;
    this.pitch = start.pitch;
    this.zoom = 1;
    this.highlighted = -1;
    const scale = window.devicePixelRatio || 1;
    for (const c of [canvas, mark]) {
      c.width = 480 * scale;
      c.height = 340 * scale;
      c.className = "wire";
    }
    this.fit();
    this.draw();
  }

  // Chooses center and size so that the frustum or the cube is in sight, and the triangles as far as that leaves it to be seen.
  fit() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], shown = [];
    const include = p => { shown.push(p); p.forEach((x, i) => { low[i] = Math.min(low[i], x); high[i] = Math.max(high[i], x); }); };
    this.guide.flat().forEach(include);
    const first = low.map((x, i) => x - FARTHEST * (high[i] - x)), last = high.map((x, i) => x + FARTHEST * (x - low[i]));
    for (let at = 0; at < this.points.length; at += 3)
      include([0, 1, 2].map(i => Math.max(first[i], Math.min(last[i], this.points[at + i]))));
    this.middle = low.map((x, i) => (x + high[i]) / 2);
    const {width, height} = this.canvas;
    this.size = height;  // one canvas pixel per unit
    const placed = shown.map(p => this.place(...p));
    this.size = 2.1 * placed.reduce((most, [x, y]) => Math.max(most, Math.abs(x - width / 2) * height / width, Math.abs(y - height / 2)), 0);
  }

  // A point's position on the canvas, in its pixels, and its nearness: larger is nearer.
  place(x, y, z) {
    const [u, v, w] = [x - this.middle[0], y - this.middle[1], z - this.middle[2]];
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const right = cy * u - sy * w, back = sy * u + cy * w;
    const up = cp * v - sp * back, near = sp * v + cp * back;
    const scale = this.zoom * this.canvas.height / this.size;
    return [this.canvas.width / 2 + right * scale, this.canvas.height / 2 - up * scale, near];
  }

  corner(i, v) {
    const at = 9 * i + 3 * v;
    return this.place(this.points[at], this.points[at + 1], this.points[at + 2]);
  }

  trace(context, i) {
    for (let v = 0; v < 3; ++v) {
      const [x, y] = this.corner(i, v);
      v ? context.lineTo(x, y) : context.moveTo(x, y);
    }
    context.closePath();
  }

  draw() {
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.lineWidth = 1;
    context.strokeStyle = styleOf("--wire");
    context.globalAlpha = this.names.length > 2000 ? 0.35 : 0.8;
    context.beginPath();
    for (let i = 0; i < this.names.length; ++i) this.trace(context, i);
    context.stroke();
    context.globalAlpha = 1;
    context.strokeStyle = styleOf("--guide");
    context.lineWidth = 1.5;
    context.beginPath();
    for (const [p, q] of this.guide) {
      context.moveTo(...this.place(...p).slice(0, 2));
      context.lineTo(...this.place(...q).slice(0, 2));
    }
    context.stroke();
    this.highlight(this.highlighted);
  }

  // Highlights triangle `name`, all pieces of it.
  highlight(name) {
    this.highlighted = name;
    const context = this.mark.getContext("2d");
    context.clearRect(0, 0, this.mark.width, this.mark.height);
    context.fillStyle = context.strokeStyle = styleOf("--hot");
    context.lineWidth = 2;
    for (let i = 0; i < this.names.length; ++i) {
      if (this.names[i] !== name) continue;
      context.beginPath();
      this.trace(context, i);
      context.globalAlpha = 0.45;
      context.fill();
      context.globalAlpha = 1;
      context.stroke();
    }
  }

  // Of the triangles under a point of the canvas, the one whose center is nearest to the viewer; -1 if there is none.
  triangleAt(x, y) {
    let found = -1, nearest = -Infinity;
    for (let i = 0; i < this.names.length; ++i) {
      const [a, b, c] = [this.corner(i, 0), this.corner(i, 1), this.corner(i, 2)];
      const side = (p, q) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
      const [s, t, u] = [side(a, b), side(b, c), side(c, a)];
      const near = a[2] + b[2] + c[2];
      if (((s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0)) && near > nearest) [found, nearest] = [this.names[i], near];
    }
    return found;
  }

  // Calls point(name) for the triangle pointed at and click(name) for the one clicked.
  listen(point, click) {
    let from = null, hasTurned = false;
    const at = event => this.triangleAt(event.offsetX * this.canvas.width / 480, event.offsetY * this.canvas.height / 340);
    this.canvas.onpointerdown = event => { from = [event.clientX, event.clientY]; hasTurned = false; this.canvas.setPointerCapture(event.pointerId); };
    this.canvas.onpointermove = event => {
      if (!from) return point(at(event));
      const [dx, dy] = [event.clientX - from[0], event.clientY - from[1]];
      if (!hasTurned && Math.hypot(dx, dy) < 3) return;
      hasTurned = true;
      from = [event.clientX, event.clientY];
      this.yaw -= dx * 0.01;
      this.pitch = Math.max(-1.57, Math.min(1.57, this.pitch + dy * 0.01));
      this.draw();
    };
    this.canvas.onpointerup = event => { if (!hasTurned) click(at(event)); from = null; };
    this.canvas.onpointerleave = () => point(-1);
    this.canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoom *= Math.exp(-event.deltaY * 0.001);
      this.draw();
    }, {passive: false});
  }
}
