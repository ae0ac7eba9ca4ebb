// The state of the page as the end of an address: JSON, deflated, in the letters of base64 that an address may have.

const PREFIX = "#p=", STAGES_OF_ONES_OWN = ["model", "view", "project", "zbuf"], KINDS = ["js", "text"];
export const LONGEST = 60000;  // characters that browsers and mail programs pass on

const MOST_BYTES = 1 << 24;       // of a state
const LONGEST_LINE = 100000;      // that an editor can show

// All bytes of a stream, which may be far more than went in: an error beyond MOST_BYTES.
async function through(bytes, transform) {
  const parts = [], reader = new Blob([bytes]).stream().pipeThrough(transform).getReader();
  let size = 0;
  for (;;) {
    const {done, value} = await reader.read();
    if (done) break;
    parts.push(value);
    size += value.length;
    if (size > MOST_BYTES) throw new Error("it is too large");
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

// Letters for fromCharCode, which takes a limited number of arguments.
function lettersOf(bytes) {
  let letters = "";
  for (let at = 0; at < bytes.length; at += 8192) letters += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return letters;
}

export async function hashOf(state) {
  const bytes = await through(new TextEncoder().encode(JSON.stringify(state)), new CompressionStream("deflate-raw"));
  return PREFIX + btoa(lettersOf(bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

// The state in a hash, or null if it holds none.
export async function stateOf(hash) {
  if (!hash.startsWith(PREFIX)) return null;
  if (hash.length > LONGEST) throw new Error("it is too long");
  const letters = atob(hash.slice(PREFIX.length).replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = await through(Uint8Array.from(letters, letter => letter.charCodeAt(0)), new DecompressionStream("deflate-raw"));
  return checked(JSON.parse(new TextDecoder().decode(bytes)));
}

// A state from elsewhere, with texts where there have to be texts and nothing else.
export function checked(state) {
  const {version, scene, config, words, mine} = state || {};
  if (![version, scene, config].every(text => typeof text === "string") || typeof words !== "object" || words === null) throw new Error("it is none of this page's");
  expectLines(scene);
  expectLines(config);
  const {model = "", view = "", project = "", zbuf = "", trace} = words, known = {model, view, project, zbuf, ...(trace === undefined ? {} : {trace})};
  const stage = mine && STAGES_OF_ONES_OWN.includes(mine.tool) && KINDS.includes(mine.kind) && typeof mine.text === "string" ? {mine: {tool: mine.tool, kind: mine.kind, text: mine.text}} : {};
  if (stage.mine) expectLines(mine.text);
  return {...stage, version, scene, config, words: Object.fromEntries(Object.entries(known).map(([tool, text]) => [tool, String(text)]))};
}

// An error if a text has a line that would take the editor minutes.
export function expectLines(text) {
  for (let at = 0, end; at <= text.length; at = end + 1) {
    end = text.indexOf("\n", at);
    if (end < 0) end = text.length;
    if (end - at > LONGEST_LINE) throw new Error(`it has a line of more than ${LONGEST_LINE} characters`);
  }
}
