// The tools, compiled to WebAssembly: each run has an instance of its own, as it has a process in a shell.

const FIFO = 0o010000, KIND = 0o170000, FOLDER = 0o040555;  // S_IFIFO, S_IFMT, and S_IFDIR to read
const CRASHED = 70;  // the status of a tool that ran out of memory or stack
const IN = "/dev/shm/in", OUT = "/dev/shm/out", MESSAGES = "/dev/shm/messages";

const utf8 = new TextEncoder(), text = new TextDecoder();
const bytesOf = data => typeof data === "string" ? utf8.encode(data) : data;

export class Tools {
  // `createTool` is the factory that Emscripten makes, `module` the compiled WebAssembly.Module.
  constructor(createTool, module) { Object.assign(this, {createTool, module, spares: new Map()}); }

  // Makes an instance for the next run of each of these tools ahead of time.
  prepare(names) { for (const name of names) if (!this.spares.has(name)) this.spares.set(name, this.createTool(this.settingsOf(name))); }

  // Runs a tool in a folder with the `files`, {name: text or bytes}, and with `input` on its standard input. `isPiped` says whether
  // standard input and output are pipes. Returns status, output and messages as bytes, and `read(name)`, a file it wrote or null.
  async run(name, words, given) {
    this.prepare([name]);
    const tool = this.spares.get(name);
    this.spares.delete(name);
    return resultOf(await tool, words, given);
  }

  settingsOf(name) {
    const {module} = this;
    return {noInitialRun: true, thisProgram: name, instantiateWasm: (imports, receive) => receive(new WebAssembly.Instance(module, imports), module)};
  }
}

function resultOf(tool, words, {input = "", files = {}, isPiped = [false, false]} = {}) {
  const {FS} = tool;
  FS.mkdir("/work");
  FS.chdir("/work");
  const descriptors = {lookup: (_, name) => FS.getStreamChecked(Number(name)).node};  // Emscripten lacks /dev/fd
  FS.mkdir("/dev/fd");
  FS.mount({mount: () => Object.assign(FS.createNode(null, "/", FOLDER, 0), {node_ops: descriptors, stream_ops: {}})}, {}, "/dev/fd");
  for (const [path, data] of Object.entries(files)) FS.writeFile(path, bytesOf(data));
  const bytes = bytesOf(input);
  FS.writeFile(IN, bytes, {canOwn: true});  // no copy: the tool only reads it
  [[0, IN, "r"], [1, OUT, "w"], [2, MESSAGES, "w"]].forEach(([descriptor, path, mode]) => {
    FS.close(FS.streams[descriptor]);
    const stream = FS.open(path, mode);
    if (stream.fd !== descriptor) throw new Error(`descriptor ${stream.fd} in place of ${descriptor}`);
    if (isPiped[descriptor]) stream.node.mode = (stream.node.mode & ~KIND) | FIFO;
  });
  const out = FS.streams[1].node, messages = FS.streams[2].node, {write} = out.stream_ops;
  // Emscripten adds an eighth at a time, and leaves nine times the output to the garbage collector; room not used costs nothing.
  FS.streams[1].stream_ops = {...out.stream_ops, write(stream, buffer, offset, length, position, canOwn) {
    const before = out.contents, end = position + length;
    if (out.usedBytes && end > before.length) (out.contents = new Uint8Array(2 * Math.max(end, bytes.length))).set(before);
    return write(stream, buffer, offset, length, position, canOwn);
  }};
  let status;
  try {
    status = tool.callMain([...words]);
  } catch (trap) {
    if (trap.status === undefined) return {status: CRASHED, output: new Uint8Array(), messages: utf8.encode(`${tool.thisProgram}: ${trap.message}\n`), written: new Map(), read: () => null};
    status = trap.status;
  }
  const contents = node => node.contents ? node.contents.subarray(0, node.usedBytes) : new Uint8Array();
  // Read now: a later reference to the instance would keep all of its memory.
  const written = new Map(FS.readdir("/work").filter(path => FS.isFile(FS.stat(path).mode) && !(path in files)).map(path => [path, FS.readFile(path)]));
  return {status, output: contents(out), messages: contents(messages), written, read: path => written.get(path) || null};
}

export const textOf = bytes => text.decode(bytes);
