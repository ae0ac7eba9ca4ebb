"""Pictures in files: BMP, PPM and PNG of 8 bits a channel read, PNG written. A picture is a width, a height and rows of
RGB bytes, top first."""
import struct
import zlib


class PictureError(Exception):
    """Not a picture that can be read."""


def read_bmp(data):
    offset, = struct.unpack_from("<I", data, 10)
    width, height, _, bits = struct.unpack_from("<iiHH", data, 18)
    if bits != 24:
        raise PictureError(f"expected a BMP of 24 bits a pixel, found {bits}")
    stride = (3 * width + 3) // 4 * 4
    rows = []
    for y in range(abs(height)):
        row = bytearray(data[offset + y * stride:offset + y * stride + 3 * width])
        row[0::3], row[2::3] = row[2::3], row[0::3]  # BMP stores blue, green, red
        rows.append(bytes(row))
    return width, abs(height), rows if height < 0 else rows[::-1]  # the bottom row first, unless the height is negative


def read_ppm(data):
    words, at = [], 0
    while len(words) < 4:
        while data[at:at + 1].isspace():
            at += 1
        if data[at:at + 1] == b"#":
            at = data.index(b"\n", at)
            continue
        end = at
        while end < len(data) and not data[end:end + 1].isspace():
            end += 1
        words.append(data[at:end])
        at = end
    width, height, largest = map(int, words[1:])
    if largest != 255:
        raise PictureError(f"expected a PPM of 8 bits a channel, found a largest value of {largest}")
    pixels = data[at + 1:]
    return width, height, [pixels[3 * width * y:3 * width * (y + 1)] for y in range(height)]


def unfiltered(kind, row, above):
    """A row of a PNG of three bytes a pixel without its filter."""
    out = bytearray(row)
    for i, value in enumerate(row):
        a, b, c = (out[i - 3] if i >= 3 else 0), above[i], (above[i - 3] if i >= 3 else 0)
        if kind == 4:  # the one of a, b and c that is nearest to a + b - c
            guess = min((a, b, c), key=lambda x: abs(a + b - c - x))
        else:
            guess = (0, a, b, (a + b) // 2)[kind]
        out[i] = (value + guess) & 255
    return bytes(out)


def read_png(data):
    at, body = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        chunk = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colors, _, _, interlaced = struct.unpack(">IIBBBBB", chunk)
            if (bits, colors, interlaced) != (8, 2, 0):
                raise PictureError("expected a PNG of 8 bits RGB without interlacing")
        elif kind == b"IDAT":
            body += chunk
        at += 12 + size
    pixels, stride = zlib.decompress(body), 3 * width + 1
    rows = [bytes(3 * width)]
    for y in range(height):
        line = pixels[y * stride:(y + 1) * stride]
        rows.append(unfiltered(line[0], line[1:], rows[-1]) if line[0] else line[1:])
    return width, height, rows[1:]


READERS = {b"BM": read_bmp, b"P6": read_ppm, b"\x89P": read_png}


def is_picture(data):
    return data[:2] in READERS


def read_picture(path):
    """The picture in a file, whatever its name."""
    with open(path, "rb") as file:
        data = file.read()
    if not is_picture(data):
        raise PictureError(f"{path}: expected a BMP, PPM or PNG")
    try:
        width, height, rows = READERS[data[:2]](data)
    except (ValueError, IndexError, struct.error, zlib.error, UnboundLocalError) as error:
        raise PictureError(f"{path}: not a whole picture ({error})") from error
    except PictureError as error:
        raise PictureError(f"{path}: {error}") from error
    if len(rows) != height or any(len(row) != 3 * width for row in rows):
        raise PictureError(f"{path}: not a whole picture")
    return width, height, rows


def png(width, height, rows):
    """The bytes of a PNG."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")
