// Runs the reader's JavaScript where it can harm nothing: in a worker, in a frame with its own origin, under policies of page and frame
// that let it load nothing but its own blobs, and for a limited time. FRAME is the frame's script; its hash is in the page's policy
// (build.mjs).

const LONGEST = 5000;   // milliseconds
const MOST_OUT = 1 << 26;  // characters
const MOST_PRINTED = 1000;  // lines, and characters of one

// The code that follows the reader's function in its worker.
const CALL = `{
  let count = 0;
  const wordOf = value => { try { return typeof value === "string" ? value : JSON.stringify(value) ?? String(value); } catch { return String(value); } };
  const print = (...values) => { if (count++ < ${MOST_PRINTED}) postMessage({printed: values.map(wordOf).join(" ").slice(0, ${MOST_PRINTED})}); };
  for (const name of ["log", "info", "warn", "error", "debug"]) console[name] = print;
  onmessage = ({data}) => {
    try {
      const text = String(stage(...data));  // refused here, since on a slow computer it may not reach the page in time
      postMessage(text.length > ${MOST_OUT} ? {error: "it returned too much"} : {text});
    } catch (error) {
      const [, line, column] = /blob:\\S*?:(\\d+):(\\d+)/.exec(error && error.stack) || [];
      postMessage({error: String(error), line: line - 1, column: Number(column)});
    }
  };
}`;

export const FRAME = `onmessage = ({data: {code}, ports: [port]}) => {
  const addressOf = script => URL.createObjectURL(new Blob([script], {type: "text/javascript"}));
  const address = addressOf("function stage(input, config) {\\n" + code + "\\n}\\n" + ${JSON.stringify(CALL)}), worker = new Worker(address);
  let count = 0;
  const answer = data => {
    worker.onmessage = worker.onerror = null;
    worker.terminate();
    const {text, error, line, column} = data || {};
    port.postMessage(typeof text === "string" ? {text} : typeof error === "string" ? {error: error.slice(0, 300), line, column} : {error: "it calls postMessage"});
  };
  const fail = event => answer({error: event.message || "the code cannot be read", line: event.lineno - 1, column: event.colno});
  // Firefox names a syntax error only where a worker imports the script.
  worker.onerror = event => { if (event.message) fail(event); else new Worker(addressOf("importScripts('" + address + "')")).onerror = fail; };
  worker.onmessage = ({data}) => {
    if (data && typeof data.printed === "string" && ++count <= ${MOST_PRINTED}) port.postMessage({printed: data.printed.slice(0, ${MOST_PRINTED})}); else if (!data || data.printed === undefined) answer(data);
  };
  port.onmessage = ({data}) => worker.postMessage(data);
};`;

// The text that the code returns for the inputs. Calls `print` with each line that it prints. Rejects with an error, with line and column
// if they are known, if the code fails or has not ended after LONGEST milliseconds.
export function runCode(code, inputs, print) {
  const frame = document.createElement("iframe");
  frame.setAttribute("sandbox", "allow-scripts");
  frame.hidden = true;
  frame.srcdoc = `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline' blob:; worker-src blob:"><script>${FRAME}</script>`;
  let timer = 0;
  return new Promise((resolve, reject) => {
    const {port1, port2} = new MessageChannel();
    timer = setTimeout(() => reject(new Error(`it has not ended after ${LONGEST / 1000} seconds`)), LONGEST);
    port1.onmessage = ({data: {text, error, line, column, printed}}) => {
      if (printed !== undefined) return print(printed);
      if (typeof text === "string" && text.length <= MOST_OUT) resolve(text);
      else reject(Object.assign(new Error(typeof text === "string" ? "it returned too much" : String(error)), line > 0 ? {line, column} : {}));
    };
    frame.onload = () => {
      frame.contentWindow.postMessage({code}, "*", [port2]);
      port1.postMessage(inputs);
    };
    document.body.append(frame);
  }).finally(() => {
    clearTimeout(timer);
    frame.remove();
  });
}
