"""Picture files: reads BMP, PPM and PNG of 8 bits a channel, writes PNG. A picture is a width, a height and
rows of RGB bytes, top first."""
import itertools
import os
import re
import struct
import zlib

from lib.rim.command import CommandFailure
from lib.rim.input_file import name_of, read_input

MAX_SIDE = 65535  # zbuf's own limit; a column of millions of rows takes gigabytes in Python
MAX_PNG_PIXELS = 1 << 25  # a PNG of a few KB may claim millions, and Python is slow to filter bytes
PPM_HEADER = re.compile(rb"P6" + rb"(?:\s|#[^\n]*\n)+(\d{1,9})" * 3 + rb"\s")
MAX_PPM_HEADER = 4096
PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


class PictureError(CommandFailure):
    """Not a readable picture; `size` is its width and height, if they are not the ones expected."""
    size = None


def expect_size(width, height, size=None):
    """Raises a PictureError if the sides are out of range, or are not those of a given `size`."""
    if width <= 0 or height <= 0:
        raise PictureError(f"expected a width and a height of at least 1, found {width} x {height}")
    if size and size != (width, height):
        error = PictureError(f"expected {size[0]} x {size[1]} pixels, found {width} x {height}")
        error.size = width, height
        raise error
    if max(width, height) > MAX_SIDE:
        raise PictureError(f"expected at most {MAX_SIDE} columns and rows, found {width} x {height}")


def expect_bytes(width, height, row_bytes, pixel_bytes, channels=3):
    """Raises a PictureError if bytes are missing. Rows start `row_bytes` apart; there are `pixel_bytes`."""
    needed = (height - 1) * row_bytes + channels * width
    if needed > pixel_bytes:
        raise PictureError(
            f"expected {needed} bytes of {width} x {height} pixels, found {max(0, pixel_bytes)}")


def read_bmp(data, size, _):
    offset, header_size = struct.unpack_from("<I", data, 10)[0], struct.unpack_from("<I", data, 14)[0]
    if header_size < 40 or offset < 14 + header_size:
        raise PictureError("expected a BMP with a header of 54 bytes or more, and the pixels behind it")
    width, height, _, bits, compression = struct.unpack_from("<iiHHI", data, 18)
    if bits != 24 or compression != 0:
        raise PictureError(f"expected a BMP of 24 bits a pixel, not compressed, found "
                           f"{bits}{' and compressed' if compression else ''}")
    expect_size(width, abs(height), size)
    stride = (3 * width + 3) // 4 * 4
    expect_bytes(width, abs(height), stride, len(data) - offset)
    rows = []
    for y in range(abs(height)):
        row = bytearray(data[offset + y * stride:offset + y * stride + 3 * width])
        row[0::3], row[2::3] = row[2::3], row[0::3]  # BMP stores blue, green, red
        rows.append(bytes(row))
    return width, abs(
        height), rows if height < 0 else rows[::-1]  # the bottom row first, unless the height is negative


def read_ppm(data, size, _):
    header = PPM_HEADER.match(data[:MAX_PPM_HEADER])
    if not header:
        raise PictureError("expected width, height and the largest value behind P6")
    width, height, largest = map(int, header.groups())
    if largest != 255:
        raise PictureError(f"expected a PPM of 8 bits a channel, found a largest value of {largest}")
    expect_size(width, height, size)
    expect_bytes(width, height, 3 * width, len(data) - header.end())
    begins = range(header.end(), header.end() + 3 * width * height, 3 * width)
    return width, height, [data[begin:begin + 3 * width] for begin in begins]


def paeth(row, above, size):
    """A row with the filter Paeth undone: each byte was stored minus its predictor, whichever of a (left), b
    (above) and c (above left) is nearest to a + b - c."""
    if not any(row):
        return above  # from the left on, each pixel is predicted as the one above
    out = bytearray(len(row))
    for channel in range(size):
        a, c, column = 0, 0, bytearray()
        for x, b in zip(row[channel::size], above[channel::size]):
            to_a, to_b, nearest = b - c, a - c, b if b != c else a
            if to_a and to_b:
                to_a, to_b, to_c = abs(to_a), abs(to_b), abs(to_a + to_b)
                nearest = a if to_a <= to_b and to_a <= to_c else b if to_b <= to_c else c
            a, c = (x + nearest) & 255, b
            column.append(a)
        out[channel::size] = column
    return bytes(out)


def unfiltered(kind, row, above, size=3):
    """A row of a PNG of `size` bytes a pixel, with its filter undone."""
    if kind == 0:
        return row
    if kind == 2:
        return bytes((x + b) & 255 for x, b in zip(row, above))
    if kind == 4:
        return paeth(row, above, size)
    if kind not in (1, 3):
        raise PictureError(f"expected a filter from 0 to 4, found {kind}")
    out = bytearray(len(row))
    for channel in range(size):
        if kind == 1:
            sums = (sum_ & 255 for sum_ in itertools.accumulate(row[channel::size]))
        else:
            sums = itertools.accumulate(zip(row[channel::size], above[channel::size]), lambda a, x:
                                        (x[0] + (a + x[1]) // 2) & 255, initial=0)
            next(sums)
        out[channel::size] = bytes(sums)
    return bytes(out)


def png_chunks(data):
    """Pairs of a kind and a body."""
    at = 8
    while at + 8 <= len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        yield kind, data[at + 8:at + 8 + size]
        at += 12 + size


def laid_over(row, behind):
    """A row of red, green, blue and straight alpha (not multiplied into colors) over one color, as RGB."""
    out = bytearray(len(row) // 4 * 3)
    for channel in range(3):
        out[channel::3] = bytes(
            (x * a + behind[channel] * (255 - a) + 127) // 255 for x, a in zip(row[channel::4], row[3::4]))
    return bytes(out)


def png_lines(data, size=None, takes_alpha=True):
    """Width, height, the bytes of a pixel, and the rows of a PNG, each with its filter before it."""
    if data[12:16] != b"IHDR":
        raise PictureError("expected a PNG with a header, found none")
    width, height, *form = struct.unpack_from(">IIBBBBB", data, 16)
    expect_size(width, height, size)
    has_alpha = form == [8, 6, 0, 0, 0]
    if form != [8, 2, 0, 0, 0] and not (has_alpha and takes_alpha):
        raise PictureError("expected a PNG of 8 bits RGB without interlacing" +
                           ", found one with alpha (an opaque background leaves it out)" * has_alpha)
    if width * height > MAX_PNG_PIXELS:
        raise PictureError(f"expected a PNG of at most {MAX_PNG_PIXELS} pixels, found {width} x {height}")
    channels = 4 if has_alpha else 3
    stride = channels * width + 1
    stream, pixels = zlib.decompressobj(), bytearray()
    for kind, body in png_chunks(data):
        if kind == b"IDAT" and len(pixels) < stride * height:  # the stream may hold more than the header says
            pixels += stream.decompress(body, stride * height - len(pixels))
    expect_bytes(width, height, stride, len(pixels) - 1, channels)
    begins = range(0, stride * height, stride)
    return width, height, channels, [bytes(pixels[begin:begin + stride]) for begin in begins]


def read_png(data, size, behind):
    """A PNG with alpha is laid over the color `behind`; without one it is refused."""
    width, height, channels, lines = png_lines(data, size, behind is not None)
    rows, above = [], bytes(channels * width)
    for line in lines:
        above = unfiltered(line[0], line[1:], above, channels)
        rows.append(laid_over(above, behind) if channels == 4 else above)
    return width, height, rows


READERS = {b"BM": read_bmp, b"P6": read_ppm, b"\x89P": read_png}


def is_picture(data):
    return data[:2] in READERS


def picture_of(data, path, behind=None, size=None):
    """The picture in the bytes of a file, whatever its name. Transparent pixels show the color `behind`, as
    three bytes; without it, alpha is an error. If the header has another `size` than a given width and
    height, nothing is unpacked."""
    if not is_picture(data):
        raise PictureError(f"{name_of(path)}: expected a BMP, PPM or PNG")
    try:
        return READERS[data[:2]](data, size, behind)
    except (struct.error, zlib.error) as error:
        raise PictureError(f"{name_of(path)}: not a whole picture ({error})") from None
    except PictureError as error:
        error.args = (f"{name_of(path)}: {error}",)
        raise


def read_picture(path):
    """The picture in a file."""
    return picture_of(read_input(path), path)


def png_chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


PNG_END = png_chunk(b"IEND", b"")


def png(width, height, rows):
    """The bytes of a PNG."""
    return png_of_lines(width, height, 3, [b"\0" + row for row in rows])


def png_of_lines(width, height, channels, lines, level=9):
    """The bytes of a PNG of rows with their filters."""
    header = struct.pack(">IIBBBBB", width, height, 8, 6 if channels == 4 else 2, 0, 0, 0)
    pixels = zlib.compress(b"".join(lines), level)
    return PNG_SIGNATURE + png_chunk(b"IHDR", header) + png_chunk(b"IDAT", pixels) + PNG_END


def size_of(picture):
    """Width and height of a picture file as zbuf writes it."""
    if picture[:2] == b"P6":
        return tuple(map(int, PPM_HEADER.match(picture[:MAX_PPM_HEADER]).groups()[:2]))
    return struct.unpack_from(*((">II", picture, 16) if picture[:2] == b"\x89P" else ("<ii", picture, 18)))


def is_complete(path):
    """True if a picture file, as zbuf writes it, is as long as its header says; a PNG has its end."""
    with open(path, "rb") as file:
        head = file.read(MAX_PPM_HEADER)
        length = file.seek(0, os.SEEK_END)
        file.seek(max(0, length - len(PNG_END)))
        end = file.read()
    if head[:2] == b"BM":
        return length == int.from_bytes(head[2:6], "little")
    header = PPM_HEADER.match(head)
    return length == header.end() + 3 * int(header[1]) * int(header[2]) if header else end == PNG_END


def with_pixels_of(picture, others):
    """A picture file as zbuf writes it, with pixels of other such files: pairs of a file and places."""
    width, height = size_of(picture)
    if picture[:2] == b"\x89P":  # no filter of zbuf's looks at the row above, so other rows stay as they are
        *_, size, lines = png_lines(picture)
        for other, places in others:
            copy_pixels(lines, png_lines(other)[3], places, width, size)
        return png_of_lines(width, height, size, lines, level=4)  # as zbuf does
    stride, first = 3 * width, len(picture) - 3 * width * height
    if picture[:2] == b"BM":  # rows from the bottom
        stride = -((3 * width + 3) // 4 * 4)
        first = len(picture) + stride
    whole = bytearray(picture)
    for other, places in others:
        for place in places:
            at = first + place // width * stride + place % width * 3
            whole[at:at + 3] = other[at:at + 3]
    return bytes(whole)


def copy_pixels(lines, others, places, width, size):
    """Copies the pixels at the places; all rows have their filters."""
    for row in {place // width for place in places}:
        for of in (lines, others):
            of[row] = bytearray(b"\0" + unfiltered(of[row][0], of[row][1:], None, size))
    for place in places:
        row, at = place // width, 1 + place % width * size
        lines[row][at:at + size] = others[row][at:at + size]
