// Sends a scene through the pipe, as a shell runs `model < scene.txt | view | project | zbuf config.txt`, and makes the inspector's data.

import {difference, theirPictureOf, theirsOf} from "./own_stage.js";
import {partOf} from "./thinning.js";
import {textOf} from "./tools.js";

export const STAGES = ["model", "view", "project", "zbuf"];
const BELTS = "8";  // of facets in place of a sphere, for project and zbuf
const TITLES = {model: "world space", view: "view space", project: "normalized device coordinates"};
const MOST_TRIANGLES = 2000000;  // and the largest number of one, since the panels have tables up to it
const MOST_DRAWN = 20000;        // triangles in a panel
const FILES = {model: "stage1.txt", view: "stage2.txt", project: "stage3.txt", zbuf: "z_buffer.txt"}, SAVED_IMAGE = "out.bmp";
const EXACT = ["--digits", "exact"];
const IMAGE = "out.ppm", COUNTS = "counts.txt", FRAGMENTS = "fragments.txt", TRIANGLES = "triangles.npy", DEPTHS = "depths.npy";

// The failure of a stage; `messages` come from all stages so far.
export class StageFailure extends Error {
  constructor(tool, status, messages) { super(`${tool}: exit status ${status}`); Object.assign(this, {tool, status, messages}); }
}

export const wordsOf = options => options.trim().split(/\s+/).filter(word => word);
const isEqual = (a, b) => a.length === b.length && a.every((x, i) => x === b[i]);
const linesOf = (text, tool) => text.split("\n").filter(line => line).map(line => ({tool, line}));
const pairsOf = text => text.split("\n").filter(line => line).map(line => line.split(" "));

export class Pipe {
  constructor(tools) { Object.assign(this, {tools, kept: new Map()}); }

  // Runs a stage, unless its last run for this `place` had the same words and input.
  async stage(tool, words, input, files, place = tool) {
    const key = [...words, ...Object.values(files)], before = this.kept.get(place);
    if (before && before.input === input && isEqual(before.key, key)) return before;
    if (place === "model") this.kept.clear();  // all else is made from it, and large
    const started = performance.now();
    const done = await this.tools.run(tool, words, {input, files, isPiped: [tool !== "model", tool !== "zbuf"]});
    const result = {...done, tool, key, input, seconds: (performance.now() - started) / 1000, text: textOf(done.messages)};
    this.kept.set(place, result);
    return result;
  }

  // The data of an Inspector, with the whole texts of the stages in `shown`, and the messages of every stage. With `isQuick`, only the
  // visible fragment of each pixel is listed: all fragments take ten times as long as the picture. Calls `drawn` with the picture as soon as
  // it is there. Throws a StageFailure.
  async run({scene, config, words, own, shown}, isQuick, drawn) {
    const isTraced = typeof words.trace === "string";
    if (/(^| )--rows\b/.test(words.zbuf)) throw new Error("--rows draws a part of the picture, which this page cannot show");
    const results = [], messages = [], logs = isQuick && !/--samples/.test(words.zbuf) ? ["--triangle-array", TRIANGLES, "--depth-array", DEPTHS] : ["--fragments", FRAGMENTS];
    const taken = (done, expected) => {
      messages.push(...linesOf(done.text, done.tool));
      if (done.status !== 0) throw new StageFailure(done.tool, done.status, messages);
      if (!done.read(expected)) throw new StageFailure("page", 0, [...messages, {tool: done.tool, line: textOf(done.output).trimEnd()}]);  // --help or --version
    };
    let input = scene, picture = null;
    for (const tool of STAGES) {
      const isLast = tool === "zbuf", own = wordsOf(words[tool]);
      if (isTraced ? tool === "project" : isLast) {
        // The picture alone takes a fifth of the time.
        const by = isTraced ? "trace" : tool, all = ["config.txt", ...wordsOf(words[by]), "-o", IMAGE, .../--z-buffer/.test(words[by]) ? [] : ["--z-buffer", "none"]];
        const drawing = await this.stage(by, all, isTraced ? results[1].output : input, {"config.txt": config}, "picture");
        if (isTraced || drawing.status !== 0) taken(drawing, IMAGE);
        picture = drawing.read(IMAGE) && imageOf(drawing.read(IMAGE));
        if (isQuick && picture) drawn(picture);
      }
      const all = isLast ? ["config.txt", ...own, "-o", IMAGE, ...logs, "--stats", COUNTS] : [...own, "--stats", COUNTS];
      const done = await this.stage(tool, all, input, isLast ? {"config.txt": config} : {});
      // If trace draws, project and zbuf run for the panels alone.
      taken(isTraced && done.status === 0 && results.length > 1 ? {...done, text: ""} : done, COUNTS);
      results.push(done);
      input = tool === "view" && isTraced ? await this.faceted(results, scene) : done.output;
    }
    const [, rule] = words.zbuf.match(/--coverage[ =]+(\S+)/) || [], options = [...wordsOf(words.project), ...rule ? ["--coverage", rule] : []];
    const data = {...this.inspected(results, config, shown), ...picture, isTraced, options, coverage: rule}, isLarge = data.step > 1;
    if (own && isLarge) messages.push({tool: "page", line: `page: note: a stage of your own is compared in scenes of up to ${MOST_DRAWN} triangles`});
    else if (own && !isTraced) data.theirs = await this.withOwn(own, results, {config, words, picture});
    return {data, messages, isQuick: logs[0] !== "--fragments" && !isLarge};
  }

  // The files that `pipeline stages` writes (from lossless texts), with scene and config; without project's and zbuf's if trace draws.
  async filesOf({scene, config, words}) {
    const files = {"scene.txt": scene, "config.txt": config}, isTraced = typeof words.trace === "string";
    const run = async (tool, all, input) => {
      const done = await this.tools.run(tool, all, {input, files: {"config.txt": config}});
      if (done.status !== 0) throw new Error(textOf(done.messages).split("\n")[0]);
      return done;
    };
    let input = scene;
    for (const tool of isTraced ? ["model", "view"] : STAGES.slice(0, 3)) {
      const own = wordsOf(words[tool]), isLast = tool === "project";
      files[FILES[tool]] = (await run(tool, isLast ? own : [...own, "--bare"], input)).output;
      input = isLast ? files[FILES[tool]] : (await run(tool, [...wordsOf(words[tool].replace(/--digits[ =]+\S+/, "")), ...EXACT], input)).output;
    }
    const tool = isTraced ? "trace" : "zbuf", drawn = await run(tool, ["config.txt", ...wordsOf(words[tool]), "-o", SAVED_IMAGE], input);
    return {...files, [FILES.zbuf]: drawn.output, [SAVED_IMAGE]: drawn.read(SAVED_IMAGE)};
  }

  // Sends the reader's text, in place of a stage's output, through the later stages; the inspector's `theirs`.
  async withOwn({tool, text}, results, {config, words, picture: ours}) {
    if (tool === "zbuf") return theirPictureOf(text, ours);
    const place = STAGES.indexOf(tool);
    let input = new TextEncoder().encode(text), done = null;
    for (const next of STAGES.slice(place + 1)) {
      const isLast = next === "zbuf", own = wordsOf(words[next]);
      done = await this.stage(next, isLast ? ["config.txt", ...own, "-o", IMAGE] : own, input, isLast ? {"config.txt": config} : {}, `own ${next}`);
      if (done.status !== 0) break;
      input = done.output;
    }
    const picture = done.status === 0 ? imageOf(done.read(IMAGE)).pixels : null;
    return theirsOf(tool, place, difference(text, textOf(results[place].output)), picture, ours.pixels, done.text.split("\n")[0]);
  }

  // The input of project: the text of view, with facets in place of spheres.
  async faceted(results, scene) {
    if (!/^sphere$/m.test(textOf(results[1].output))) return results[1].output;
    const world = await this.stage("model", ["--facets", BELTS], scene, {}, "faceted model");
    return (await this.stage("view", [], world.output, {}, "faceted view")).output;
  }

  inspected(results, config, shown) {
    const counts = results.map(done => pairsOf(textOf(done.read(COUNTS)))), zbuf = results[3];
    const step = Math.max(1, Math.ceil(new Map(counts[0]).get("triangles") / MOST_DRAWN));
    const texts = results.slice(0, 3).map(done => partOf(done.output, shown.includes(done.tool) ? step : Infinity)), [model] = texts;
    if (model.count > MOST_TRIANGLES) throw new Error(`triangles are numbered up to ${model.count}, which is more than this page can show`);
    const {columns, rows} = imageOf(zbuf.read(IMAGE));
    const depths = shown.includes("zbuf") ? textOf(zbuf.output) : "", stages = texts.map((text, i) => this.stageData(results[i], text, counts[i], model.count));
    stages.push({tool: "zbuf", title: "pixels", seconds: zbuf.seconds, triangles: texts[2].pieces, bytes: zbuf.output.length, statistics: counts[3], text: depths});
    const log = zbuf.read(FRAGMENTS), fragments = log ? textOf(log) : seenOf(zbuf.read(TRIANGLES), zbuf.read(DEPTHS));
    return {
      scene: "scene.txt", config: "config.txt", triangles: model.count, spheres: model.spheres, step, shown, stages, notes: step > 1 ? ["Hidden fragments are left out."] : [], limits: limitsOf(config),
      explanations: [], fragments, leftOut: 0,
    };
  }

  stageData(done, {text, numbers, pieces, distinct}, statistics, count) {
    return {tool: done.tool, title: TITLES[done.tool], seconds: done.seconds, triangles: pieces, missing: count - distinct, bytes: done.output.length, statistics, numbers, text};
  }
}

// The words of a config's limits of x and y.
function limitsOf(config) {
  const words = config.replace(/#.*/g, "").split(/\s+/).filter(word => word).slice(2, 4);
  return words.length === 2 ? words : ["-1", "-1"];
}

// Columns, rows, and the red, green and blue of every pixel of a PPM.
function imageOf(bytes) {
  let at = 0;
  const words = [];
  while (words.length < 4) {
    const start = at;
    while (bytes[at] > 32) ++at;
    words.push(textOf(bytes.subarray(start, at++)));
  }
  return {columns: Number(words[1]), rows: Number(words[2]), pixels: bytes.subarray(at)};
}

// The numbers of a .npy file.
function numbersOf(bytes, Numbers) {
  const at = 10 + bytes[8] + 256 * bytes[9];
  return new Numbers(bytes.slice(at).buffer);
}

// The visible fragment of each pixel.
function seenOf(triangles, depths) {
  const names = Int32Array.from(numbersOf(triangles, BigInt64Array), Number), begins = new Int32Array(names.length + 1);
  names.forEach((name, p) => { begins[p + 1] = begins[p] + (name >= 0); });
  const shown = names.filter(name => name >= 0);
  return {begins, triangles: shown, depths: numbersOf(depths, Float64Array).filter(depth => !Number.isNaN(depth)), fates: new Uint8Array(shown.length)};
}
