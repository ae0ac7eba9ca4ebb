// The page's data, deflated: in files beside it if it is IN_FOLDER (build.mjs), else within the page, in base64.

import {bytesOf} from "../inspect_parts/pack.js";

export const VERSION = PIPELINE_VERSION;

async function dataOf(name) {
  const answer = IN_FOLDER && await fetch(`${name}.bin`);
  if (answer && !answer.ok) throw new Error(`${name}.bin: ${answer.status}`);
  const bytes = answer ? await answer.arrayBuffer() : bytesOf(document.getElementById(`${name}-data`).textContent.trim());
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate")));
}

// {samples: {name: {scene, config, isTraced}}, pages: {name: text}, mistakes: {name: sentence}}
export const texts = async () => (await dataOf("texts")).json();
const moduleOf = name => async () => WebAssembly.compile(await (await dataOf(name)).arrayBuffer());
export const toolModule = moduleOf("tools"), importerModule = moduleOf("mesh2scene");
// A worker made from a blob is under the page's policy; a worker from a file would have none.
export const workerAddress = async () => URL.createObjectURL(new Blob([await (await dataOf("worker")).text()], {type: "text/javascript"}));
