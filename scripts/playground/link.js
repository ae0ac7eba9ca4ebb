// The state of the page as the hash of an address: JSON, deflated, in base64 with letters that an address may have.

const PREFIX = "#p=", STAGES_OF_ONES_OWN = ["model", "view", "project", "zbuf"], KINDS = ["js", "text"];
const LONGEST = 60000;  // characters that browsers and mail programs pass on

const MOST_BYTES = 1 << 24;       // of a state
const LONGEST_LINE = 100000;      // that an editor can show
const LONGEST_BEGINNING = 1 << 16;  // of a scene, with the comments before its camera

// All bytes after a transform, which may be far more than before; an error beyond MOST_BYTES.
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

// The hash for a state, or null if it is too long for an address.
export async function hashOf(state) {
  const bytes = await through(new TextEncoder().encode(JSON.stringify(state)), new CompressionStream("deflate-raw"));
  if (bytes.length > LONGEST / 4 * 3 - PREFIX.length) return null;
  return PREFIX + btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

// The state in a hash, or null if it holds none.
export async function stateOf(hash) {
  if (!hash.startsWith(PREFIX)) return null;
  if (hash.length > LONGEST) throw new Error("it is too long");
  const letters = atob(hash.slice(PREFIX.length).replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = await through(Uint8Array.from(letters, letter => letter.charCodeAt(0)), new DecompressionStream("deflate-raw"));
  return checked(JSON.parse(new TextDecoder().decode(bytes)));
}

// A state from elsewhere, reduced to the known fields; an error if one has the wrong type.
export function checked(state) {
  const {version, scene, config, words, mine, others} = state || {};
  if (![version, scene, config].every(text => typeof text === "string") || typeof words !== "object" || words === null) throw new Error("it is none of this page's");
  expectLines(scene);
  expectLines(config);
  const {model = "", view = "", project = "", zbuf = "", trace} = words, known = {model, view, project, zbuf, ...(trace === undefined ? {} : {trace})};
  const stages = [mine, ...Array.isArray(others) ? others : []].map(stageOf), [first, ...rest] = stages, own = {...first ? {mine: first} : {}, ...rest.length ? {others: rest.filter(stage => stage)} : {}};
  return {...own, version, scene, config, words: Object.fromEntries(Object.entries(known).map(([tool, text]) => [tool, String(text)]))};
}

// A stage of one's own, or undefined.
function stageOf(given) {
  const {tool, kind, text} = given || {};
  if (!STAGES_OF_ONES_OWN.includes(tool) || !KINDS.includes(kind) || typeof text !== "string") return undefined;
  expectLines(text);
  return {tool, kind, text};
}

// "scene", "config", or "" for a text that begins like neither.
export function kindOf(text) {
  const isNumber = word => word !== "" && Number.isFinite(Number(word));
  const lines = text.slice(0, LONGEST_BEGINNING).split("\n").map(line => line.replace(/#.*/, "").trim().split(/\s+/)).filter(([first]) => first);
  const isCamera = lines.length > 3 && lines.slice(0, 3).every(words => words.length === 3 && words.every(isNumber)) && (/^(perspective|frustum|ortho)$/.test(lines[3][0]) || isNumber(lines[3][0]));
  if (isCamera) return "scene";
  const words = lines.flat();
  return words.length > 1 && words.length < 7 && words.every(isNumber) ? "config" : "";
}

// Throws an error if a text has a line so long that the editor would take minutes.
export function expectLines(text) {
  for (let at = 0, end; at <= text.length; at = end + 1) {
    end = text.indexOf("\n", at);
    if (end < 0) end = text.length;
    if (end - at > LONGEST_LINE) throw new Error(`it has a line of more than ${LONGEST_LINE} characters`);
  }
}
