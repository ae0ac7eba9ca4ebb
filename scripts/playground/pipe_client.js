// The page's connection to the worker: runs the newest state, one run at a time.

const PAUSE = 250;  // milliseconds without an edit before the slow part of a run
const SOON = 400;   // milliseconds of a run before Stop is offered

export class PipeClient {
  // `module` is the compiled WebAssembly.Module, `workerAddress` the address of the worker's script. Calls `drawn` with the picture of a
  // run, `answered` with its whole answer, and `busy` with true when a run has taken a while, with false at its end.
  constructor(module, workerAddress, {drawn, answered, busy}) {
    Object.assign(this, {module, workerAddress, drawn, answered, busy, id: 0, running: null, next: null, waiting: new Map(), shown: []});
    this.start();
  }

  start() {
    this.worker = new Worker(this.workerAddress);  // no module: a page from the disk may not start one
    this.worker.onmessage = ({data}) => this.receive(data);
    this.worker.onerror = event => this.fail(event);
    this.worker.postMessage({module: this.module});
  }

  // Runs a state, at first quickly; after a pause without another state, with all fragments. `shown` are the stages whose texts are needed.
  run(state, isQuick = true) {
    clearTimeout(this.later);
    this.isPending = false;
    this.next = {state, isQuick};
    if (this.running === null) this.send();
  }

  send() {
    if (!this.next) return;
    this.running = ++this.id;
    const {state, isQuick} = Object.assign(this, this.next);
    this.worker.postMessage({id: this.running, state: {...state, shown: this.shown}, isQuick});
    this.next = null;
    this.timer = setTimeout(() => this.busy(true), SOON);
  }

  // The worker's answer to a question; {messages} if it is stopped.
  ask(question) {
    const id = ++this.id, timer = setTimeout(() => this.busy(true), SOON);
    return new Promise(resolve => {
      this.waiting.set(id, resolve);
      this.worker.postMessage({id, ...question});
    }).finally(() => {
      clearTimeout(timer);
      this.busy(false);
    });
  }

  receive(answer) {
    this.hasAnswered = true;
    if (this.waiting.has(answer.id)) {
      this.waiting.get(answer.id)(answer);
      return void this.waiting.delete(answer.id);
    }
    if (answer.picture) return this.drawn(answer.picture);
    this.end();
    this.isPending = answer.isQuick && !this.next;  // the slow part
    if (this.isPending) this.later = setTimeout(() => this.run(this.state, false), PAUSE);
    this.send();
    if (this.running !== null) return;  // a newer state runs: of this one, only the picture is shown
    try {
      this.answered(answer);
    } catch (error) {
      this.answered({failed: "page", messages: [{tool: "page", line: `page: this cannot be shown: ${error.message}`}]});
    }
  }

  end() {
    clearTimeout(this.timer);
    this.running = null;
    this.busy(false);
  }

  // Restarts a worker that has crashed, if it has ever answered.
  fail(event) {
    event.preventDefault();
    const line = event.message || "the browser does not start a worker here";
    if (this.hasAnswered) this.stop(line); else this.answered({failed: "page", messages: [{tool: "page", line}]});
  }

  // Ends the worker with all its runs, and starts a new one.
  stop(why = "stopped") {
    this.worker.terminate();
    this.end();
    for (const answer of this.waiting.values()) answer({text: "", messages: [{line: why}]});
    this.waiting.clear();
    this.start();
    this.answered({failed: "page", messages: [{tool: "page", line: why}]});
    this.send();
  }
}
