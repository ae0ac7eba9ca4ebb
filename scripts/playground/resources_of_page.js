// Where the single file has what the page needs: in itself, compressed.

import {bytesOf, inflated} from "../inspect_parts/pack.js";

export const VERSION = PIPELINE_VERSION;
const dataOf = id => document.getElementById(id).textContent.trim();

export const samples = () => inflated(dataOf("samples-data"));

const moduleOf = id => async () => {
  const stream = new Blob([bytesOf(dataOf(id))]).stream().pipeThrough(new DecompressionStream("deflate"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
};
export const toolModule = moduleOf("tools-data"), importerModule = moduleOf("importer-data");

export const workerAddress = async () => URL.createObjectURL(new Blob([dataOf("worker-script")], {type: "text/javascript"}));

export const python = null;  // which would be four times as large as all else
