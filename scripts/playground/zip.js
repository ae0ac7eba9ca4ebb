// A zip archive of files, stored as they are (PKWARE, "APPNOTE.TXT", 6.3.10), without dates.

const REMAINDERS = Uint32Array.from({length: 256}, (_, byte) => {
  for (let bit = 0; bit < 8; ++bit) byte = byte & 1 ? 0xedb88320 ^ byte >>> 1 : byte >>> 1;
  return byte;
});
const utf8 = new TextEncoder();
const FIRST_DAY = 1 << 5 | 1;  // 1 January 1980

function checksum(bytes) {
  let crc = -1;
  for (const byte of bytes) crc = REMAINDERS[(crc ^ byte) & 255] ^ crc >>> 8;
  return ~crc;
}

// Little-endian, [bytes, number] each.
const record = (...fields) => Uint8Array.from(fields.flatMap(([size, number]) => Array.from({length: size}, (_, i) => number >>> 8 * i)));

// `files` are {name: text or bytes}, with names of ASCII.
export function zipOf(files) {
  const contents = [], directory = [];
  let at = 0;
  for (const [name, data] of Object.entries(files)) {
    const bytes = typeof data === "string" ? utf8.encode(data) : data, size = bytes.length;
    const common = [[2, 20], [2, 0], [2, 0], [2, 0], [2, FIRST_DAY], [4, checksum(bytes)], [4, size], [4, size], [2, name.length], [2, 0]];
    contents.push(record([4, 0x04034b50], ...common), name, bytes);
    directory.push(record([4, 0x02014b50], [2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), name);
    at += 30 + name.length + size;
  }
  const count = directory.length / 2, length = 46 * count + Object.keys(files).join("").length;
  return new Blob([...contents, ...directory, record([4, 0x06054b50], [2, 0], [2, 0], [2, count], [2, count], [4, length], [4, at], [2, 0])], {type: "application/zip"});
}
