// Where the folder has what the page needs: in files beside it.

export const VERSION = PIPELINE_VERSION;

async function fetched(name) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
  return answer;
}

export const samples = async () => (await fetched("samples.json")).json();
export const toolModule = async () => WebAssembly.compile(await (await fetched("tools.wasm")).arrayBuffer());
export const workerAddress = () => "worker.js";
