// Runs the reader's JavaScript where it can harm nothing: in a worker of a frame of an origin of its own, under the page's policy, which
// and its own lets it load nothing; and not for long. The frame's script is the text of FRAME, whose hash is in the policy (build.mjs).

const LONGEST = 5000;   // milliseconds
const MOST_OUT = 1 << 26;  // characters

export const FRAME = `onmessage = ({data: {code}, ports: [port]}) => {
  const run = "onmessage = ({data}) => { try { postMessage({text: String(stage(...data))}); } catch (error) { postMessage({error: String(error)}); } };";
  const worker = new Worker(URL.createObjectURL(new Blob(["function stage(input, config) {\\n" + code + "\\n}\\n" + run], {type: "text/javascript"})));
  const answer = data => {
    worker.onmessage = worker.onerror = null;
    worker.terminate();
    const {text, error} = data || {};
    port.postMessage(typeof text === "string" ? {text} : {error: typeof error === "string" ? error.slice(0, 300) : "it answers by itself"});
  };
  worker.onerror = event => answer({error: (event.message || "the code cannot be read") + (event.lineno > 1 ? ", line " + (event.lineno - 1) : "")});
  worker.onmessage = ({data}) => answer(data);
  port.onmessage = ({data}) => worker.postMessage(data);
};`;

// What the code returns of the inputs; an error after LONGEST milliseconds, or with what went wrong.
export function runCode(code, ...inputs) {
  const frame = document.createElement("iframe");
  frame.setAttribute("sandbox", "allow-scripts");
  frame.hidden = true;
  frame.srcdoc = `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; worker-src blob:"><script>${FRAME}</script>`;
  let timer = 0;
  return new Promise((resolve, reject) => {
    const {port1, port2} = new MessageChannel();
    timer = setTimeout(() => reject(new Error(`it has not ended after ${LONGEST / 1000} seconds`)), LONGEST);
    port1.onmessage = ({data: {text, error}}) => {
      if (typeof text === "string" && text.length <= MOST_OUT) resolve(text);
      else reject(new Error(typeof text === "string" ? "it returned too much" : String(error)));
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
