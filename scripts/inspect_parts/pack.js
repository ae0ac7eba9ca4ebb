// The page's data: JSON, deflated, in base64; arrays of numbers in base64 once more.

function bytesOf(base64) {
  return Uint8Array.from(atob(base64), letter => letter.charCodeAt(0));
}

async function inflated(base64) {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return JSON.parse(await new Response(stream).text());
}

const intsOf = base64 => new Int32Array(bytesOf(base64).buffer);
const realsOf = base64 => new Float64Array(bytesOf(base64).buffer);
