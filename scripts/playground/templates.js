// Stages to begin with, the body of a function that gets `input`, the text of the stage before (for model, the scene), and returns its own.

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
};
