// Runs the pipe in a worker, so that the page stays responsive and can end it.

import createTool from "all-tools";
import createImporter from "mesh2scene";

import {Pipe, STAGES, StageFailure} from "./pipe.js";
import {Tools, textOf} from "./tools.js";
import {zipOf} from "./zip.js";

let pipe = null, tools = null;

// Messages from the page: {module} once; then {id, state, isQuick} for a run, answered first with its picture; {id, help} for a tool's
// --help-all; {id, saved}, a state, for a zip of its files; {id, model} for the scene that mesh2scene makes of files; and {id, single} for
// the result of one run of a tool.
self.onmessage = async ({data: {module, id, state, isQuick, help, saved, model, single}}) => {
  if (module) {
    tools = new Tools(createTool, module);
    pipe = new Pipe(tools);
    return;
  }
  try {
    if (help) return self.postMessage({id, text: textOf((await tools.run(help, ["--help-all"])).output)});
    if (model) return self.postMessage({id, ...await sceneOf(model)});
    if (single) {
      const {read, ...done} = await tools.run(single.tool, single.words, single);
      return self.postMessage({id, ...done});
    }
    if (saved) return self.postMessage({id, zip: zipOf(await pipe.filesOf(saved))});
    self.postMessage({id, ...await pipe.run(state, isQuick, picture => self.postMessage({id, picture}))});
    tools.prepare(STAGES);
  } catch (error) {
    const {tool, messages} = error instanceof StageFailure ? error : {tool: "page", messages: [{tool: "page", line: `page: ${error.message}`}]};
    self.postMessage({id, failed: tool, messages});
  }
};

async function sceneOf({importer, words, files}) {
  const done = await new Tools(createImporter, importer).run("mesh2scene", words, {files});
  return {scene: done.status === 0 && textOf(done.output), told: textOf(done.messages)};
}
