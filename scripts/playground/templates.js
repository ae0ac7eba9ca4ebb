// Stages to begin with, the body of a function that gets `input`, the text of the stage before (for model, the scene), and returns its own;
// zbuf gets `config`, too, and returns a picture.

export const TEMPLATES = {
  model: `// Carries out the commands of the scene: push, pop, translate, scale, triangle. rotate is yours to write.
const words = input.replace(/#.*/g, "").split(/\\s+/).filter(word => word);
const next = () => Number(words.shift()), three = () => [next(), next(), next()];
const camera = [["eye", three()], ["look", three()], ["up", three()], ["perspective", [next(), next(), next(), next()]]];
let m = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];
const saved = [], out = camera.map(([name, numbers]) => name + " " + numbers.join(" "));
const times = (p, w) => m.map(row => row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3] * w);
while (words.length) {
  const command = words.shift();
  if (command === "push") saved.push(m);
  else if (command === "pop") m = saved.pop();
  else if (command === "translate") { const moved = times(three(), 1); m = m.map((row, i) => [...row.slice(0, 3), moved[i]]); }
  else if (command === "scale") { const f = three(); m = m.map(row => [row[0] * f[0], row[1] * f[1], row[2] * f[2], row[3]]); }
  else if (command === "rotate") { next(); three(); }
  else if (command === "triangle") { for (let i = 0; i < 3; ++i) out.push(times(three(), 1).map(x => x.toFixed(7)).join(" ")); out.push(""); }
}
return out.join("\\n") + "\\n";
`,
  view: `// Moves world space so that the eye is at the origin, looks down -z and has y up.
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b) => a.map((x, i) => x - b[i]), unit = a => a.map(x => x / Math.sqrt(dot(a, a)));
const camera = {}, out = [];
for (const line of input.split("\\n")) {
  const [first, ...rest] = line.split(" ");
  if (["eye", "look", "up"].includes(first)) camera[first] = rest.map(Number);
  else if (/^[-0-9]/.test(line)) {
    const l = unit(minus(camera.look, camera.eye)), r = unit(cross(l, camera.up)), u = cross(r, l);
    const p = minus(line.split(" ").slice(0, 3).map(Number), camera.eye);
    out.push([dot(r, p), dot(u, p), -dot(l, p)].map(x => x.toFixed(7)).join(" "));
  } else out.push(line);
}
return out.join("\\n");
`,
  project: `// Divides by the distance: what the camera sees lies between -1 and 1. It neither clips nor drops what is behind the eye.
const out = [];
let x = 1, y = 1, near = 1, far = 10;
for (const line of input.split("\\n")) {
  const words = line.split(" ");
  if (words[0] === "perspective") {
    const [fovY, aspect] = words.slice(1, 3).map(Number), half = degrees => Math.tan(degrees * Math.PI / 360);
    [near, far] = words.slice(3, 5).map(Number);
    y = 1 / half(fovY);
    x = words[5] === "ratio" ? y / aspect : 1 / half(fovY * aspect);
  } else if (/^[-0-9]/.test(line)) {
    const p = words.slice(0, 3).map(Number), w = -p[2];
    const z = (-(far + near) / (far - near) * p[2] - 2 * far * near / (far - near)) / w;
    out.push([x * p[0] / w, y * p[1] / w, z].map(n => n.toFixed(7)).join(" "));
  } else if (line === "") out.push("");
}
return out.join("\\n");
`,
  zbuf: `// Draws the nearest triangle in each pixel, and returns the picture as a PPM text: P3, columns, rows, 255, and three numbers a pixel.
const [columns, rows, left = -1, bottom = -1, front = -1, rear = 1] = config.replace(/#.*/g, "").split(/\\s+/).filter(word => word).map(Number);
const dx = -2 * left / columns, dy = -2 * bottom / rows, x0 = left + dx / 2, y0 = -bottom - dy / 2;
const depths = new Float64Array(columns * rows).fill(rear), colors = new Uint8Array(3 * columns * rows);
let state = 1, name = 0, corners = [], colored = -1, rgb = [];
const random = () => (state = (Math.imul(214013, state) + 2531011) >>> 0, (state >>> 16) % 256);
const meets = (y, [p, q]) => p[1] > q[1] ? meets(y, [q, p]) : p[1] === q[1] || y < p[1] || y > q[1] ? [] : [y === q[1] ? q : p.map((n, i) => n + (y - p[1]) / (q[1] - p[1]) * (q[i] - n))];
function draw([a, b, c]) {
  while (colored < name) { rgb = [random(), random(), random()]; ++colored; }
  for (let row = 0; row < rows; ++row) {
    const ends = [[a, b], [b, c], [c, a]].flatMap(edge => meets(y0 - row * dy, edge)).sort((p, q) => p[0] - q[0]), [first, last] = [ends[0], ends.at(-1)];
    if (ends.length < 2) continue;
    for (let column = Math.max(0, Math.floor((first[0] - x0) / dx + 0.5)); column < columns && column <= Math.floor((last[0] - x0) / dx + 0.5); ++column) {
      const z = first[2] + (x0 + column * dx - first[0]) * (last[2] - first[2]) / (last[0] - first[0] || 1), pixel = row * columns + column;
      if (z >= front && z < depths[pixel]) { depths[pixel] = z; colors.set(rgb, 3 * pixel); }
    }
  }
}
for (const line of input.split("\\n")) {
  if (line.startsWith("triangle ")) name = Number(line.slice(9));
  if (/^[-0-9]/.test(line)) corners.push(line.split(" ").slice(0, 3).map(Number));
  if (corners.length === 3) { draw(corners); corners = []; ++name; }
}
return "P3 " + columns + " " + rows + " 255\\n" + colors.join(" ") + "\\n";
`,
};
