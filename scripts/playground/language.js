// The language of scenes and configs, a line for each word: the table beside the editor, and what completion shows.

const CAMERA = [
  ["X Y Z", "first line: the eye"],
  ["X Y Z", "second line: the point looked at"],
  ["X Y Z", "third line: the direction that is up"],
  ["FOVY ASPECT NEAR FAR", "fourth line: the angle of view in degrees, fovX / fovY, and the near and far plane"],
  ["ratio", "at the end of that line: ASPECT is width / height"],
  ["frustum L R B T N F", "in place of these: the window's edges on the near plane, near, far"],
  ["ortho L R B T N F", "in place of these: the same for parallel rays"],
];
const COMMANDS = {
  triangle: ["X Y Z, three lines", "three corners, counterclockwise seen from the front"],
  sphere: ["X Y Z R", "center and radius; trace draws it"],
  translate: ["TX TY TZ", "moves what follows"],
  scale: ["SX SY SZ", "enlarges what follows"],
  rotate: ["ANGLE AX AY AZ", "turns what follows about an axis, by an angle in degrees"],
  push: ["", "saves the matrix"],
  pop: ["", "restores the saved matrix"],
  end: ["", "ends the scene"],
  color: ["R G B", "0 to 255: of the triangles that follow"],
  attributes: ["color normal", "corners go on with R G B, with NX NY NZ, or with both"],
  background: ["R G B", "0 to 255: where no triangle is"],
  light: ["X Y Z R G B", "a lamp: its position and its intensity, 1 is full"],
  ambient: ["R G B", "light from everywhere, 1 is full"],
  material: ["KA KD KS N [REFLECTANCE INDEX ALPHA]", "ambient, diffuse, specular, shininess; for trace, mirrors and glass"],
  absorption: ["R G B", "of the material above it: how strongly its inside absorbs light"],
  paint: ["R G B", "0 to 255: the color of the material above it"],
  attenuation: ["CONSTANT LINEAR QUADRATIC", "how light fades with distance"],
  use: ["K", "material K, from 0, for the triangles that follow"],
};
const CONFIG = [
  ["WIDTH HEIGHT", "first line: the size of the picture in pixels"],
  ["LEFT", "second line, if any: the left limit of x, such as -1; the right one is its opposite"],
  ["BOTTOM", "third line: likewise for y"],
  ["FRONT REAR", "fourth line: the limits of depth, such as -1 1"],
];

// SCENE_WORDS are those of libpipeline/scene/scene_commands.h, in their order (build.mjs).
export const ROWS = [["The camera", CAMERA], ["Commands", SCENE_WORDS.map(word => [`${word} ${COMMANDS[word][0]}`, COMMANDS[word][1]])], ["config.txt", CONFIG]];
export const COMPLETIONS = [...SCENE_WORDS.map(label => ({label, detail: COMMANDS[label][0], info: COMMANDS[label][1]})), ...["ortho", "frustum", "ratio"].map(label => ({label}))];
