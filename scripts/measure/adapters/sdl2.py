"""SDL's software renderer: SDL_RenderGeometry."""
import ctypes

from adapter import leave, library, serve

ARGB8888, BLENDMODE_NONE = 0x16362004, 0


class Vertex(ctypes.Structure):
    _fields_ = [("x", ctypes.c_float), ("y", ctypes.c_float), ("color", ctypes.c_uint8 * 4),
                ("u", ctypes.c_float), ("v", ctypes.c_float)]


sdl = library("SDL2-2.0", "libsdl2-2.0-0")
if not hasattr(sdl, "SDL_RenderGeometry"):
    leave("SDL2 is older than 2.0.18: it has no SDL_RenderGeometry")
for name in ("SDL_CreateRGBSurfaceWithFormatFrom", "SDL_CreateSoftwareRenderer"):
    getattr(sdl, name).restype = ctypes.c_void_p
version = (ctypes.c_uint8 * 3)()
sdl.SDL_GetVersion(version)


def coverage(case, number):
    pixels = ctypes.create_string_buffer(4 * case.width * case.height)
    surface = ctypes.c_void_p(
        sdl.SDL_CreateRGBSurfaceWithFormatFrom(pixels, case.width, case.height, 32, 4 * case.width, ARGB8888))
    renderer = ctypes.c_void_p(sdl.SDL_CreateSoftwareRenderer(surface))
    white = (ctypes.c_uint8 * 4)(255, 255, 255, 255)
    vertices = (Vertex * 3)(*(Vertex(*(float(x) + 0.5
                                       for x in case.pixels(point)), white, 0, 0)
                              for point in case.triangles[number]))
    sdl.SDL_RenderGeometry(renderer, None, vertices, 3, None, 0)
    sdl.SDL_RenderPresent(renderer)
    sdl.SDL_DestroyRenderer(renderer)
    sdl.SDL_FreeSurface(surface)
    return pixels.raw[::4]


serve(
    {
        "name": "SDL2",
        "version": ".".join(map(str, version)),
        "promise": (
            "nothing. It takes fractions, but its software renderer truncates corners to whole pixels; the "
            "adapter adds half a pixel, so that they are rounded."),
        "grid": 1,
    }, coverage)
