// Where the single file has what the page needs: in itself, compressed.

import {bytesOf, inflated} from "../inspect_parts/pack.js";

export const VERSION = PIPELINE_VERSION;
const dataOf = id => document.getElementById(id).textContent.trim();

export const samples = () => inflated(dataOf("samples-data"));

export async function toolModule() {
  const stream = new Blob([bytesOf(dataOf("tools-data"))]).stream().pipeThrough(new DecompressionStream("deflate"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

export const workerAddress = async () => URL.createObjectURL(new Blob([dataOf("worker-script")], {type: "text/javascript"}));

export const python = null;  // which would be four times as large as all else
