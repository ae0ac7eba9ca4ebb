"""cairo. usage: cairo.py none|default, the word being its antialiasing"""
import ctypes
import sys

from adapter import library, serve

FORMAT_A8 = 2
ANTIALIAS = {"default": 0, "none": 1}[sys.argv[1]]
PROMISE = {
    "none":
        "nothing but that a pixel is either filled or not. Corners are rounded to 1/256 of a pixel.",
    "default":
        "each pixel is as opaque as the part of it that the triangle covers, about. Where two parts meet in "
        "a pixel, the background shines through."
}

cairo = library("cairo", "libcairo2")
for name in ("cairo_image_surface_create", "cairo_create", "cairo_image_surface_get_data",
             "cairo_version_string"):
    getattr(cairo, name).restype = ctypes.c_void_p
cairo.cairo_version_string.restype = ctypes.c_char_p
for name in ("cairo_move_to", "cairo_line_to"):
    getattr(cairo, name).argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double]


def coverage(case, number):
    surface = ctypes.c_void_p(cairo.cairo_image_surface_create(FORMAT_A8, case.width, case.height))
    context = ctypes.c_void_p(cairo.cairo_create(surface))
    cairo.cairo_set_antialias(context, ANTIALIAS)
    a, b, c = (map(float, case.pixels(point)) for point in case.triangles[number])
    cairo.cairo_move_to(context, *a)
    cairo.cairo_line_to(context, *b)
    cairo.cairo_line_to(context, *c)
    cairo.cairo_close_path(context)
    cairo.cairo_fill(context)
    cairo.cairo_surface_flush(surface)
    stride = cairo.cairo_image_surface_get_stride(surface)
    data = ctypes.string_at(cairo.cairo_image_surface_get_data(surface), stride * case.height)
    cairo.cairo_destroy(context)
    cairo.cairo_surface_destroy(surface)
    return b"".join(data[row * stride:row * stride + case.width] for row in range(case.height))


serve(
    {
        "name": "cairo" +
                (", antialiased" if ANTIALIAS == 0 else ""), "version": cairo.cairo_version_string().decode(),
        "promise": PROMISE[sys.argv[1]], "grid": 1 / 256, "is_antialiased": ANTIALIAS == 0}, coverage)
