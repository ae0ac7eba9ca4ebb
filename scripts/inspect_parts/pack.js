// The page's data: JSON, deflated, in base64. In the JSON, arrays of numbers are base64 too, or plain arrays.

export function bytesOf(base64) {
  if (typeof base64 !== "string") return base64;
  const letters = atob(base64), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);  // Uint8Array.from takes seconds for a large page
  return bytes;
}

export async function inflated(base64) {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return JSON.parse(await new Response(stream).text());
}

export const intsOf = data => typeof data === "string" ? new Int32Array(bytesOf(data).buffer) : data;
export const realsOf = data => typeof data === "string" ? new Float64Array(bytesOf(data).buffer) : data;
