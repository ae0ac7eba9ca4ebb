"""Color and light for reference_pipeline.py: the picture of a lit scene, by ray casting in view space.

The unlit pipeline gives the visible triangle of each pixel. The ray through the pixel's center intersects that triangle's
plane in view space; the barycentric weights there give color, normal and position for the lighting formula. Nothing is
interpolated on the screen, pieces of clipped triangles are ignored, and no code is shared with libpipeline.
"""
import math

import reference_pipeline as plain

DEFAULTS = {"background": (0, 0, 0), "ambient": (0, 0, 0), "material": (1, 1, 0, 1), "attenuation": (1, 0, 0)}


def floats(vector):
    return tuple(map(float, vector))


def unit(v):
    length = math.sqrt(plain.dot(v, v))
    return plain.times(1 / length, v) if length else v


def mean(weights, vectors):
    return tuple(plain.dot(weights, axis) for axis in zip(*vectors))


class LitScene(plain.Scene):
    """A scene with its `looks`, lights in world space, and each triangle's color and normals in world space."""

    def __init__(self, text):
        self.looks, self.lights, self.color, self.names = dict(DEFAULTS), [], None, []
        self.colors, self.normals = [], []
        super().__init__(text)

    def other_command(self, command, transform):
        if command == "attributes":
            while self.words[self.next] in ("color", "normal"):
                self.names.append(self.word())
        elif command == "color":
            self.color = self.point()
        elif command == "light":
            self.lights.append((plain.applied(transform, self.point()), self.point()))
        else:
            self.looks[command] = self.numbers(len(DEFAULTS[command]))

    def triangle(self, transform):
        corners, colors, normals = [], [], []
        for _ in range(3):
            corners.append(plain.applied(transform, self.point()))
            colors.append(self.point() if "color" in self.names else self.color)
            if "normal" in self.names:
                normals.append(self.world_normal(transform, self.point()))
        self.colors.append(colors)
        self.normals.append(normals)
        return corners

    @staticmethod
    def world_normal(transform, n):
        """The normal's image, by the cofactors of the matrix: its inverse transpose up to the determinant."""
        _, x, y, z = transform
        cofactors = (plain.cross(y, z), plain.cross(z, x), plain.cross(x, y))
        determinant = plain.dot(x, cofactors[0])
        return plain.times(1 if determinant > 0 else -1, mean(n, cofactors))


def lit(p, normal, color, lights, looks, is_ortho):
    """The lighting formula at a point of view space."""
    to_eye = (0.0, 0.0, 1.0) if is_ortho else unit(plain.times(-1, p))
    n = unit(normal)
    n = plain.times(-1, n) if plain.dot(n, to_eye) < 0 else n
    ka, kd, ks, shininess = looks["material"]
    constant, linear, quadratic = looks["attenuation"]
    result = [c * ka * a for c, a in zip(color, looks["ambient"])]
    for place, intensity in lights:
        way = plain.subtract(place, p)
        distance = math.sqrt(plain.dot(way, way))
        to_light = unit(way)
        if plain.dot(n, to_light) <= 0:
            continue
        half = unit(plain.add(to_light, to_eye))
        arriving = 1 / (constant + linear * distance + quadratic * distance ** 2)
        diffuse = kd * plain.dot(n, to_light)
        highlight = 255 * ks * max(0.0, plain.dot(n, half)) ** shininess
        for i in range(3):
            result[i] += arriving * intensity[i] * (color[i] * diffuse + highlight)
    return result


def weights_of(corners, start, way):
    """The corners' weights where the ray from `start` intersects their plane; a pixel's center may lie slightly outside."""
    volumes = [plain.dot(plain.subtract(corners[i - 2], start), plain.cross(plain.subtract(corners[i - 1], start), way))
               for i in range(3)]
    weights = [max(0.0, volume / sum(volumes)) for volume in volumes]
    return [weight / sum(weights) for weight in weights]


def lit_image(scene, config, owners, model):
    """The rows of the image as real colors; `owners` gives the visible triangle of each pixel, or None."""
    left, right, bottom, top, near, _ = floats(plain.window(scene.projection))
    is_ortho = scene.projection[0] == "ortho"
    l = plain.normalized(plain.subtract(scene.look, scene.eye))
    r = plain.normalized(plain.cross(l, scene.up))
    u = plain.cross(r, l)

    def turned(v):
        return floats((plain.dot(r, v), plain.dot(u, v), -plain.dot(l, v)))

    looks = {name: floats(values) for name, values in scene.looks.items()}
    lights = [(turned(plain.subtract(place, scene.eye)), floats(intensity)) for place, intensity in scene.lights]
    surfaces = [([floats(p) for p in triangle], [turned(n) for n in normals], [floats(c) for c in colors])
                for triangle, normals, colors in zip(plain.view(scene), scene.normals, scene.colors)]

    def color_at(number, row, column):
        x = left + (config.x_of(column) + 1) / 2 * (right - left)
        y = bottom + (config.y_of(row) + 1) / 2 * (top - bottom)
        start, way = ((x, y, 0.0), (0.0, 0.0, -1.0)) if is_ortho else ((0.0, 0.0, 0.0), (x, y, -near))
        corners, normals, colors = surfaces[number]
        weights = weights_of(corners, start, way)
        if model == "flat":
            weights = [1 / 3] * 3
        if model == "flat" or not normals:
            normals = [plain.cross(plain.subtract(corners[1], corners[0]), plain.subtract(corners[2], corners[0]))] * 3
        if model == "gouraud":
            at_corners = [lit(*corner, lights, looks, is_ortho) for corner in zip(corners, normals, colors)]
            return mean(weights, [[min(255, channel) for channel in color] for color in at_corners])
        return lit(mean(weights, corners), mean(weights, normals), mean(weights, colors), lights, looks, is_ortho)

    return [[looks["background"] if number is None else color_at(number, row, column)
             for column, number in enumerate(line)] for row, line in enumerate(owners)]
