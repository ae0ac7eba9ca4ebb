// The page's end of the worker that runs commands in Python. It is made when a command is first asked for, since Python takes 6 MB.

export class PythonClient {
  // `resources` are what the worker loads; `busy` is called with whether it has something to do.
  constructor(module, resources, busy) { Object.assign(this, {module, resources, busy, worker: null, answer: null}); }

  // What a command, a list of words, prints in a folder with the files, {name: text, bytes or Blob}. One at a time.
  ask(command, files) {
    if (this.answer) return Promise.reject(new Error("Another command is under way."));
    this.busy(true);
    return new Promise((resolve, reject) => {
      this.answer = {resolve, reject};
      this.start().then(worker => worker.postMessage({command, files})).catch(error => this.stop(error.message));
    }).finally(() => {
      this.answer = null;
      this.busy(false);
    });
  }

  async start() {
    if (this.worker) return this.worker;
    const {script, ...rest} = await this.resources();
    this.worker = new Worker(script, {type: "module"});
    this.worker.onmessage = ({data: {text, problem}}) => { if (problem !== undefined) this.stop(problem); else if (this.answer) this.answer.resolve(text); };
    this.worker.onerror = event => { event.preventDefault(); this.stop(event.message || "Python does not start here."); };
    this.worker.postMessage({module: this.module, ...rest});
    return this.worker;
  }

  stop(why = "stopped") {
    if (this.worker) this.worker.terminate();
    this.worker = null;
    if (this.answer) this.answer.reject(new Error(why));
  }
}
