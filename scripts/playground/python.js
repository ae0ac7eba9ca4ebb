// Runs commands of the project in Python, beside the page; the tools that they start are the page's.

import createTool from "all-tools";

import {Tools} from "./tools.js";

let ready = null;

// `address` is the folder of Pyodide's files, `sources` has the commands' own, {path: text}, `driver` is run_command.py.
async function load({module, address, sources, driver}) {
  const tools = new Tools(createTool, module), {loadPyodide} = await import(`${address}pyodide.mjs`);
  const python = await loadPyodide({indexURL: address});
  python.registerJsModule("page", {
    run(tool, words, input, files) {
      const done = tools.runNow(tool, words.toJs(), {input: input.toJs(), files: files.toJs({dict_converter: Object.fromEntries})});
      return python.toPy({...done, written: Object.fromEntries(done.written)});
    },
  });
  for (const [path, text] of Object.entries(sources)) {
    python.FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
    python.FS.writeFile(path, text);
  }
  python.runPython(driver);
  return python.globals.get("run_command");
}

async function bytesOf(files) {
  const parts = Object.entries(files).map(async ([name, data]) => [name, new Uint8Array(await new Blob([data]).arrayBuffer())]);
  return Object.fromEntries(await Promise.all(parts));
}

// What is asked for: once what load takes, then {command, files}.
self.onmessage = async ({data}) => {
  try {
    if (data.module) ready = load(data);
    else self.postMessage({text: (await ready)(...data.command, await bytesOf(data.files))});
  } catch (error) {
    self.postMessage({problem: error.message});
  }
};
