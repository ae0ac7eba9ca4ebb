// The page's end of the worker: one run at a time, of the newest state.

const PAUSE = 250;  // milliseconds without an edit, before the slow part
const SOON = 400;   // until it can be stopped

export class PipeClient {
  // `module` is the compiled WebAssembly.Module, `workerAddress` where the worker's script is. `drawn` is called with the picture of a run,
  // `answered` with all of its answer, `busy` with whether one has been under way for a while.
  constructor(module, workerAddress, {drawn, answered, busy}) {
    Object.assign(this, {module, workerAddress, drawn, answered, busy, id: 0, running: null, next: null, waiting: new Map()});
    this.start();
  }

  start() {
    this.worker = new Worker(this.workerAddress);  // no module: a page from the disk may not start one
    this.worker.onmessage = ({data}) => this.receive(data);
    this.worker.onerror = event => this.fail(event);
    this.worker.postMessage({module: this.module});
  }

  // At first quickly; if nothing else is to be done for a while, with all that belongs to it.
  run(state) {
    clearTimeout(this.later);
    this.isPending = false;
    this.next = {state, isQuick: true};
    if (this.running === null) this.send();
  }

  send() {
    if (!this.next) return;
    this.running = ++this.id;
    this.worker.postMessage({id: this.running, ...this.next});
    this.state = this.next.state;
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
    if (this.isPending) this.later = setTimeout(() => { this.isPending = false; this.next = {state: this.state, isQuick: false}; this.send(); }, PAUSE);
    this.send();
    if (this.running !== null) return;  // there is something newer: of this, the picture was all
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

  // A worker that ends by itself is started again, if it has ever answered.
  fail(event) {
    event.preventDefault();
    const line = event.message || "the browser does not start a worker here";
    if (this.hasAnswered) this.stop(line); else this.answered({failed: "page", messages: [{tool: "page", line}]});
  }

  // Ends what runs, whatever it is doing.
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
