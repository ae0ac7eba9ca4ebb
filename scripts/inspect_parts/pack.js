// The page's data: JSON, deflated, in base64; arrays of numbers in base64 once more.

export function bytesOf(base64) {
  const letters = atob(base64), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);  // Uint8Array.from takes seconds for a large page
  return bytes;
}

export async function inflated(base64) {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return JSON.parse(await new Response(stream).text());
}

export const intsOf = base64 => new Int32Array(bytesOf(base64).buffer);
export const realsOf = base64 => new Float64Array(bytesOf(base64).buffer);
