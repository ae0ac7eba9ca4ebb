// Names the mistakes of a reader's stage: each known mistake is made in a right stage, and named if the output is the reader's.

import {StageText} from "../inspect_parts/stage_data.js";
import {difference, tidied} from "./own_stage.js";
import {runCode} from "./sandbox.js";
import {TEMPLATES} from "./templates.js";

const ROTATE = `{
    const x = next() * Math.PI / 180, [a, b, c] = (v => v.map(n => n / Math.hypot(...v)))(three()), k = 1 - Math.cos(x), s = Math.sin(x);
    const R = [[a * a * k + Math.cos(x), a * b * k - c * s, a * c * k + b * s], [a * b * k + c * s, b * b * k + Math.cos(x), b * c * k - a * s], [a * c * k - b * s, b * c * k + a * s, c * c * k + Math.cos(x)]];
    m = m.map(row => [...[0, 1, 2].map(j => row[0] * R[0][j] + row[1] * R[1][j] + row[2] * R[2][j]), row[3]]);
  }`;
const RIGHT = {...TEMPLATES, model: TEMPLATES.model.replace("{ next(); three(); }", ROTATE)};

// Mistakes of tests/conformance/mistakes.txt: pairs of a text in the right stage and its replacement.
export const MISTAKES = {
  "model/push-and-pop-ignored": ["m = saved.pop()", "saved.pop()"],
  "model/push-of-the-identity": ["saved.push(m)", "saved.push(m), m = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"],
  "model/pop-to-the-identity": ["m = saved.pop()", "m = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"],
  "model/push-does-not-nest": ["m = saved.pop()", "m = saved.at(-1)"],
  "model/axis-not-normalized": ["n / Math.hypot(...v)", "n"],
  "model/angle-in-radians": ["next() * Math.PI / 180", "next()"],
  "model/rotation-transposed": ["s = Math.sin(x)", "s = -Math.sin(x)"],
  "model/translation-added": ["times(three(), 1); m = m", "three().map((n, i) => n + m[i][3]); m = m"],
  "view/translation-after-rotation": ["Number), camera.eye)", "Number), [0, 0, 0])", "-dot(l, p)]", "-dot(l, p)].map((n, i) => n - camera.eye[i])"],
  "view/eye-added": ["Number), camera.eye)", "Number), camera.eye.map(n => -n))"],
  "view/no-translation": ["Number), camera.eye)", "Number), [0, 0, 0])"],
  "view/rotation-transposed": ["[dot(r, p), dot(u, p), -dot(l, p)]", "[0, 1, 2].map(i => r[i] * p[0] + u[i] * p[1] - l[i] * p[2])"],
  "view/eye-and-look-exchanged": ["camera.look, camera.eye", "camera.eye, camera.look", "Number), camera.eye)", "Number), camera.look)"],
  "view/look-is-a-direction": ["minus(camera.look, camera.eye)", "camera.look"],
  "view/l-not-unit": ["unit(minus(camera.look, camera.eye))", "minus(camera.look, camera.eye)"],
  "view/l-not-negated": ["-dot(l, p)", "dot(l, p)"],
  "view/up-is-a-point": ["cross(l, camera.up)", "cross(l, minus(camera.up, camera.eye))"],
  "view/up-is-0-1-0": ["cross(l, camera.up)", "cross(l, [0, 1, 0])"],
  "view/r-not-unit": ["unit(cross(l, camera.up))", "cross(l, camera.up)"],
  "view/r-is-up-cross-l": ["cross(l, camera.up)", "cross(camera.up, l)"],
  "view/up-as-given": ["cross(r, l)", "camera.up"],
  "view/u-is-l-cross-r": ["cross(r, l)", "cross(l, r)"],
  "view/l-is-eye-minus-look": ["camera.look, camera.eye", "camera.eye, camera.look"],
  "view/no-rotation": ["[dot(r, p), dot(u, p), -dot(l, p)]", "p"],
  "view/cross-product-sign": ["a[2] * b[0] - a[0] * b[2]", "a[0] * b[2] - a[2] * b[0]"],
  "project/fov-in-radians": ["* Math.PI / 360", "/ 2"],
  "project/fov-not-halved": ["/ 360", "/ 180"],
  "project/tangent-halved": ["Math.tan(degrees * Math.PI / 360)", "Math.tan(degrees * Math.PI / 180) / 2"],
  "project/fovx-equals-fovy": ["fovY * aspect", "fovY"],
  "project/fovx-divided-by-aspect": ["fovY * aspect", "fovY / aspect"],
  "project/r-is-t-times-aspect": ["1 / half(fovY * aspect)", "y / aspect"],
  "project/r-and-t-swapped": ["x * p[0] / w, y * p[1]", "y * p[0] / w, x * p[1]"],
  "project/near-and-far-swapped": ["[near, far] = ", "[far, near] = "],
  "project/missing-two": ["- 2 * far * near", "- far * near"],
  "project/z-row-sign": ["const z = (-", "const z = -(-"],
  "project/w-is-plus-z": ["w = -p[2]", "w = p[2]"],
  "project/last-element-is-one": ["w = -p[2]", "w = 1 - p[2]"],
  "project/depth-from-0-to-1": ["-(far + near) / (far - near) * p[2] - 2 * far", "-far / (far - near) * p[2] - far"],
  "project/depth-is-linear": ["(-(far + near) / (far - near) * p[2] - 2 * far * near / (far - near)) / w", "(-2 * p[2] - far - near) / (far - near)"],
  "project/z-not-divided": ["(far - near)) / w", "(far - near))"],
  "project/no-divide": ["[x * p[0] / w, y * p[1] / w, z]", "[x * p[0], y * p[1], z * w]"],
  "project/divided-twice": ["n.toFixed", "(n / w).toFixed"],
  "project/depth-divided-twice": ["w, z]", "w, z / w]"],
  "project/depth-in-view-space": ["w, z]", "w, p[2]]"],
  "zbuf/no-half-pixel-in-x": ["x0 = left + dx / 2", "x0 = left"],
  "zbuf/no-half-pixel-in-y": ["y0 = -bottom - dy / 2", "y0 = -bottom"],
  "zbuf/last-wins": [" && z < depths[pixel]", ""],
  "zbuf/upside-down": ["pixel = row * columns", "pixel = (rows - 1 - row) * columns"],
  "zbuf/mirrored": ["columns + column;", "columns + columns - 1 - column;"],
};

// The code of a right stage with a mistake.
export function codeOf(name) {
  const pairs = [...MISTAKES[name]];
  let code = RIGHT[name.split("/")[0]];
  while (pairs.length) code = code.replace(...pairs.splice(0, 2));
  return code;
}

// The names of the mistakes that make `text` of the inputs.
export async function mistakesIn(tool, text, inputs) {
  const names = Object.keys(MISTAKES).filter(name => name.startsWith(`${tool}/`));
  const all = `return JSON.stringify([${names.map(name => `(input, config) => {${codeOf(name)}}`)}].map(stage => { try { return stage(input, config); } catch { return ""; } }))`;
  const made = JSON.parse(await runCode(all, inputs, () => {}));
  const isSame = other => tool === "zbuf" ? tidied(other) === tidied(text) : new StageText(other).names.length > 0 && !difference(text, other).first;
  return names.filter((_, i) => isSame(made[i]));
}
