// Makes the page's files from its modules: node build.mjs NPM_FOLDER TOOLS_FOLDER VERSION DIR LICENSES. scripts/build-playground calls it.

import crypto from "node:crypto";
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";
import {fileURLToPath} from "node:url";
import zlib from "node:zlib";

const [npmFolder, toolsFolder, version, target, licensesFile] = process.argv.slice(2);
const here = path.dirname(fileURLToPath(import.meta.url)), root = path.join(here, "../..");
const {build} = createRequire(path.resolve(npmFolder, "package.json"))("esbuild");
const PAGES = ["scene", "stages", "ray-tracing", "your-own-stage", "why-is-my-picture-black"];  // of docs/, that the page has
const TITLE = "<title>Pipeline playground</title>";
const read = (...parts) => fs.readFileSync(path.join(...parts), "utf8");
const hashOf = script => `'sha256-${crypto.createHash("sha256").update(script).digest("base64")}'`;
const sceneWords = [...read(root, "libpipeline/scene/scene_commands.h").matchAll(/^ *\{"(\w+)", CommandKind::/gm)].map(([, word]) => word);
const packed = data => zlib.deflateSync(data, {level: 9});

async function bundled(entry, isInFolder, format = "esm") {
  const {outputFiles} = await build({
    entryPoints: [path.join(here, entry)], bundle: true, minify: true, write: false, format, target: "es2022", legalComments: "none", charset: "utf8",
    nodePaths: [path.resolve(npmFolder, "node_modules")], define: {PIPELINE_VERSION: JSON.stringify(version), SCENE_WORDS: JSON.stringify(sceneWords), IN_FOLDER: String(isInFolder)},
    external: ["module", "node:*"], logOverride: {"empty-import-meta": "silent"},
    alias: {"all-tools": path.resolve(toolsFolder, "all-tools.js"), mesh2scene: path.resolve(toolsFolder, "mesh2scene.js")},
  });
  return outputFiles[0].text;
}

// In a page, a script ends at the first "</script", and "<!--" begins a comment.
const inPage = script => script.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");

function pageOf(policy, style, script) {
  const parts = read(here, "../inspect_parts/page.html"), inspector = parts.slice(parts.indexOf("<header>"), parts.indexOf("</dialog>") + "</dialog>".length);
  const rules = `default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'; ${policy}`;
  const filled = {policy: `<meta http-equiv="Content-Security-Policy" content="${rules}">`, style, inspector, script};
  return read(here, "page.html").replace(/<!-- (policy|style|inspector|script) -->/g, (_, name) => filled[name]);
}

const style = `<style>\n${read(here, "../inspect_parts/page.css")}${read(here, "page.css")}</style>`;
const samples = Object.fromEntries(fs.readdirSync(path.join(root, "samples")).filter(name => fs.existsSync(path.join(root, "samples", name, "scene.txt")))
  .map(name => [name, {scene: read(root, "samples", name, "scene.txt"), config: read(root, "samples", name, "config.txt"), isTraced: fs.existsSync(path.join(root, "samples", name, "traced.bmp"))}]));
const mistakes = Object.fromEntries([...read(root, "tests/conformance/mistakes.txt").matchAll(/^(?:judge )?(\w+\/[\w-]+): (.*)/gm)].map(([, name, sentence]) => [name, sentence]));
const pages = Object.fromEntries(PAGES.map(name => [name, read(root, "docs", `${name}.md`)]));
const [wasm, importer] = ["all-tools", "mesh2scene"].map(name => fs.readFileSync(path.join(toolsFolder, `${name}.wasm`)));
const data = {tools: packed(wasm), mesh2scene: packed(importer), worker: packed(await bundled("worker.js", false, "iife")), texts: packed(JSON.stringify({samples, pages, mistakes}))};

const inner = inPage(await bundled("main.js", false));
const frame = hashOf((await import("./sandbox.js")).FRAME);  // of the page's only other script
const single = pageOf(`script-src ${hashOf(inner)} ${frame} blob: 'wasm-unsafe-eval'; worker-src blob:`, style,
  [...Object.entries(data).map(([name, bytes]) => `<script type="application/octet-stream" id="${name}-data">${bytes.toString("base64")}</script>`), `<script type="module">${inner}</script>`].join("\n"));
const folder = pageOf(`script-src 'self' ${frame} blob: 'wasm-unsafe-eval'; worker-src blob:; connect-src 'self'`, style, '<script type="module" src="main.js"></script>');

// In the single page, the licenses are a comment.
const licenses = `${read(root, "LICENSE")}\n${read(licensesFile)}`, page = `${single}\n<!--\n${licenses.replaceAll("-->", "->")}-->\n`;
const files = {"index.html": folder, "main.js": await bundled("main.js", true), "LICENSES.txt": licenses,
  ...Object.fromEntries(Object.entries(data).map(([name, bytes]) => [`${name}.bin`, bytes]))};

// Throws an error unless a path is free, or is a page of ours: a file, or a folder with nothing but our files.
function expectOurs(place, isFolder) {
  const status = fs.lstatSync(place, {throwIfNoEntry: false});
  if (!status) return;
  const page = isFolder ? path.join(place, "index.html") : place, isPage = fs.lstatSync(page, {throwIfNoEntry: false})?.isFile() && read(page).includes(TITLE);
  const hasMore = isFolder && (!status.isDirectory() || fs.readdirSync(place, {withFileTypes: true}).some(entry => !entry.isFile() || !Object.hasOwn(files, entry.name)));
  if (!isPage || hasMore) throw new Error(`${place} is in the way, and none of this page's`);
}

// Writes all files beside their places, and then moves them there.
function install() {
  const places = {single: path.join(target, "playground.html"), folder: path.join(target, "playground")};
  expectOurs(places.single, false);
  expectOurs(places.folder, true);
  const work = fs.mkdtempSync(path.join(target, ".playground-"));
  try {
    const written = [["playground.html", page], ...Object.entries(files).map(([name, contents]) => [path.join("playground", name), contents])];
    fs.mkdirSync(path.join(work, "playground"));
    for (const [name, contents] of written) fs.writeFileSync(path.join(work, name), contents);
    if (fs.existsSync(places.folder)) fs.renameSync(places.folder, path.join(work, "before"));
    fs.renameSync(path.join(work, "playground"), places.folder);
    fs.renameSync(path.join(work, "playground.html"), places.single);
    for (const [name, contents] of written)
      console.log(`${name}: ${Buffer.byteLength(contents)} bytes, ${zlib.gzipSync(contents, {level: 9}).length} compressed`);
  } catch (error) {
    if (fs.existsSync(path.join(work, "before")) && !fs.existsSync(places.folder)) fs.renameSync(path.join(work, "before"), places.folder);
    throw error;
  } finally {
    fs.rmSync(work, {recursive: true});
  }
}

// A signal waits until everything is in its place.
for (const name of ["SIGHUP", "SIGINT", "SIGTERM"]) process.on(name, () => process.exit(1));
try {
  install();
} catch (error) {
  console.error(`build-playground: ${error.message}`);
  process.exitCode = 1;
}
