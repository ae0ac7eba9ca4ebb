"""libgd's gdImageFilledPolygon."""
import ctypes
import math

from adapter import library, serve

gd = library("gd", "libgd3")
gd.gdImageCreateTrueColor.restype = ctypes.c_void_p
gd.gdVersionString.restype = ctypes.c_char_p


def coverage(case, number):
    image = ctypes.c_void_p(gd.gdImageCreateTrueColor(case.width, case.height))
    corners = (ctypes.c_int * 6)(*(math.floor(x)
                                   for point in case.triangles[number]
                                   for x in case.pixels(point)))
    gd.gdImageFilledPolygon(image, corners, 3, 0xFFFFFF)
    pixels = bytes(
        gd.gdImageGetPixel(image, column, row) & 255
        for row in range(case.height)
        for column in range(case.width))
    gd.gdImageDestroy(image)
    return pixels


serve(
    {
        "name": "GD",
        "version": gd.gdVersionString().decode(),
        "promise": "nothing. Corners are whole pixels, and it draws the pixels of the outline, too.",
        "grid": 1,
    },
    coverage)
