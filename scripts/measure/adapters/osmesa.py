"""Mesa's software renderers, through OSMesa. usage: osmesa.py llvmpipe|softpipe"""
import ctypes
import os
import sys

from adapter import Case, library, serve

GL_COLOR_BUFFER_BIT, GL_DEPTH_BUFFER_BIT, GL_TRIANGLES, GL_FLAT = 0x4000, 0x100, 4, 0x1D00
GL_DEPTH_TEST, GL_DITHER, GL_UNSIGNED_BYTE, GL_SUBPIXEL_BITS, GL_VERSION = (0x0B71, 0x0BD0, 0x1401, 0x0D50,
                                                                            0x1F02)
OSMESA_RGBA, OSMESA_Y_UP = 0x1908, 0x11

os.environ["GALLIUM_DRIVER"] = sys.argv[1]
gl = library("OSMesa", "libosmesa6")
gl.OSMesaCreateContextExt.restype = ctypes.c_void_p
gl.glGetString.restype = ctypes.c_char_p
gl.glVertex3f.argtypes = [ctypes.c_float] * 3
context = ctypes.c_void_p(gl.OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, None))
buffers = {}  # Mesa keeps the addresses of the last ones


def begin(case: Case):
    """A cleared picture of the case's size, as its bytes."""
    size = case.width, case.height
    buffer = buffers.setdefault(size, ctypes.create_string_buffer(4 * case.width * case.height))
    if not gl.OSMesaMakeCurrent(context, buffer, GL_UNSIGNED_BYTE, *size):
        sys.exit("OSMesa takes no picture of this size")
    gl.OSMesaPixelStore(OSMESA_Y_UP, 0)
    gl.glViewport(0, 0, *size)
    gl.glDisable(GL_DITHER)
    gl.glShadeModel(GL_FLAT)
    gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    return buffer


def draw(points, color):
    gl.glColor3ub(*color)
    gl.glBegin(GL_TRIANGLES)
    for point in points:
        gl.glVertex3f(*map(float, point))
    gl.glEnd()


def coverage(case, number):
    buffer = begin(case)
    gl.glDisable(GL_DEPTH_TEST)
    draw([(*case.ndc(point)[:2], 0) for point in case.triangles[number]], (255, 255, 255))
    gl.glFinish()
    return buffer.raw[::4]


def seen(case):
    buffer = begin(case)
    gl.glEnable(GL_DEPTH_TEST)
    for number, triangle in enumerate(case.triangles, 1):
        draw([case.ndc(point) for point in triangle], (number & 255, number >> 8, 0))
    gl.glFinish()
    return [low + 256 * high - 1 for low, high in zip(buffer.raw[::4], buffer.raw[1::4])]


buffer = ctypes.create_string_buffer(4)
gl.OSMesaMakeCurrent(context, buffer, GL_UNSIGNED_BYTE, 1, 1)
bits = ctypes.c_int()
gl.glGetIntegerv(GL_SUBPIXEL_BITS, ctypes.byref(bits))
serve(
    {
        "name": f"Mesa {sys.argv[1]}", "version": gl.glGetString(GL_VERSION).decode().split("Mesa ")[-1],
        "promise":
            f"a triangle has the pixels whose centers are inside; a center on a shared edge belongs to "
            f"exactly one of the two triangles. "
            f"Corners are rounded to 1/{2 ** bits.value} of a pixel.", "grid": 2**-bits.value}, coverage,
    seen)
