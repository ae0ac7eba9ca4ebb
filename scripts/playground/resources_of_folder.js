// Where the folder has what the page needs: in files beside it.

export const VERSION = PIPELINE_VERSION;

async function fetched(name) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
  return answer;
}

export const samples = async () => (await fetched("samples.json")).json();
const moduleOf = name => async () => WebAssembly.compile(await (await fetched(name)).arrayBuffer());
export const toolModule = moduleOf("tools.wasm"), importerModule = moduleOf("mesh2scene.wasm");
// A worker from the page's own text is under the page's policy; one from a file would have none.
export const workerAddress = async () => URL.createObjectURL(await (await fetched("worker.js")).blob());

// What the worker for Python needs: its script, the address of Pyodide's files, and the project's commands.
export const python = async () => ({
  script: URL.createObjectURL(await (await fetched("python.js")).blob()), address: new URL(".", location.href).href, ...await (await fetched("commands.json")).json(),
});
