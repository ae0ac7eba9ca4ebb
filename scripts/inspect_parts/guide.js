// The line segments that show the camera in world and view space, and the cube in normalized device coordinates.

const FAR_AWAY = 2;     // a far plane beyond this multiple of the farthest vertex is drawn nearer,
const DRAWN_AT = 1.5;   // at this multiple

const radians = degrees => degrees * Math.PI / 180;
const subtract = (a, b) => a.map((x, i) => x - b[i]);
const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const unit = v => v.map(x => x / Math.hypot(...v));

// The twelve edges of a box with four corners on each of two sides.
function boxLines(corners) {
  const pairs = [0, 1, 2, 3].flatMap(i => [[i, (i + 1) % 4], [i + 4, (i + 1) % 4 + 4], [i, i + 4]]);
  return pairs.map(([a, b]) => [corners[a], corners[b]]);
}

// left, right, bottom and top of the window on the near plane, near and far, in view space.
function windowOf(header) {
  const given = header.get("frustum") || header.get("ortho");
  if (given) return given;
  const [fovY, aspect, near, far] = header.get("perspective"), top = near * Math.tan(radians(fovY) / 2);
  const right = header.has("ratio") ? aspect * top : near * Math.tan(radians(fovY * aspect) / 2);
  return [-right, right, -top, top, near, far];
}

// The numbers after each keyword of a text's header; `ratio`, the word at the end of a projection, is a key without numbers.
export function headerOf(text) {
  const header = new Map();
  for (const line of text.slice(0, text.search(/^[-\d]/m) >>> 0).split("\n")) {
    const [keyword, ...words] = line.split(" ");
    header.set(keyword, words.map(Number));
    if (words.at(-1) === "ratio") header.set("ratio", []);
  }
  return header;
}

// The guide after a tool: `header` is that of model, `reach` the distance of the farthest vertex from the eye.
export function guideOf(tool, header, reach) {
  const named = (lines, corners, more) => ({guide: lines, labels: [{text: "near", at: corners[3]}, {text: "far", at: corners[7]}, ...more]});
  if (tool === "project") {
    const corners = [-1, 1].flatMap(z => [[-1, -1, z], [1, -1, z], [1, 1, z], [-1, 1, z]]);
    return {...named(boxLines(corners), corners, []), remark: ""};
  }
  const [left, right, bottom, top, near, far] = windowOf(header), isShortened = near < reach && far > FAR_AWAY * reach;
  let eye = [0, 0, 0], corners = [near, isShortened ? DRAWN_AT * reach : far].flatMap(distance => {
    const scale = header.has("ortho") ? 1 : distance / near;
    return [[left, bottom], [right, bottom], [right, top], [left, top]].map(([x, y]) => [x * scale, y * scale, -distance]);
  });
  if (tool === "model") {
    eye = header.get("eye");
    const back = unit(subtract(eye, header.get("look"))), x = unit(cross(header.get("up"), back)), y = cross(back, x);
    corners = corners.map(p => eye.map((e, i) => e + p[0] * x[i] + p[1] * y[i] + p[2] * back[i]));
  }
  const lines = [...boxLines(corners), ...corners.slice(0, 4).map(corner => [eye, corner])];
  return {...named(lines, corners, [{text: "eye", at: eye}]), remark: isShortened ? `far is at ${far}` : ""};
}
