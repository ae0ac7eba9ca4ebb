// The state of the page as the end of an address: JSON, deflated, in the letters of base64 that an address may have.

const PREFIX = "#p=";
export const LONGEST = 60000;  // characters that browsers and mail programs pass on

const through = async (bytes, stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

// Letters for fromCharCode, which takes only so many arguments at once.
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
  const letters = atob(hash.slice(PREFIX.length).replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = await through(Uint8Array.from(letters, letter => letter.charCodeAt(0)), new DecompressionStream("deflate-raw"));
  return checked(JSON.parse(new TextDecoder().decode(bytes)));
}

// A state from elsewhere, with texts where there have to be texts and nothing else.
export function checked({version, scene, config, words}) {
  if (![version, scene, config].every(text => typeof text === "string") || typeof words !== "object" || words === null) throw new Error("no state of this page");
  const {model = "", view = "", project = "", zbuf = ""} = words;
  return {version, scene, config, words: Object.fromEntries(Object.entries({model, view, project, zbuf}).map(([tool, text]) => [tool, String(text)]))};
}
