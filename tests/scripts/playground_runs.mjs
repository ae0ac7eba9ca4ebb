// Runs tools of the playground as its worker does: node playground_runs.mjs TOOLS_FOLDER < RUNS, a JSON of [{tool, words, input, files, reads,
// isPiped}]; all bytes are in base64. Writes a line of JSON for each run.

import fs from "node:fs";
import path from "node:path";
import {pathToFileURL} from "node:url";

import {Tools} from "../../scripts/playground/tools.js";

const folder = path.resolve(process.argv[2]);

async function toolsOf(name) {
  const {default: createTool} = await import(pathToFileURL(path.join(folder, `${name}.js`)));
  return new Tools(createTool, await WebAssembly.compile(fs.readFileSync(path.join(folder, `${name}.wasm`))));
}

const tools = await toolsOf("all-tools"), importer = await toolsOf("mesh2scene");
const bytes = letters => Buffer.from(letters, "base64"), letters = data => data && Buffer.from(data).toString("base64");

for (const {tool, words, input, files, reads, isPiped} of JSON.parse(fs.readFileSync(0, "utf8"))) {
  const done = await (tool === "mesh2scene" ? importer : tools).run(tool, words, {input: bytes(input), files: Object.fromEntries(Object.entries(files).map(([name, data]) => [name, bytes(data)])), isPiped});
  const written = Object.fromEntries(reads.map(name => [name, letters(done.read(name))]));
  console.log(JSON.stringify({status: done.status, output: letters(done.output), messages: letters(done.messages), written}));
}
