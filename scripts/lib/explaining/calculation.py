"""The pipeline's arithmetic on one triangle, exactly. Each stage begins, as the tools do, with the lossless
text of the one before."""
from lib.explaining.clipping import clip
from lib.maths.exact import coordinate, double
from lib.maths.matrices import Projection, applied, view_matrix

PROJECTIONS = ("perspective", "frustum", "ortho")


def points_of(words):
    return [tuple(map(double, vertex)) for vertex in words]


class Calculation:
    """Matrices, and the triangle's points in each space; `clipped` and `ndc` have its clipped pieces."""
    def __init__(self, stages, triangle):
        settings, camera = stages.settings, stages.camera()
        self.model_matrix = triangle.matrix()
        self.world = [applied(self.model_matrix, p)[:3] for p in points_of(triangle.points)]
        self.view_matrix = view_matrix(*(tuple(map(double, camera[name])) for name in ("eye", "look", "up")))
        self.view = [applied(self.view_matrix, p)[:3] for p in points_of(stages.world_lossless)]
        kind = next(name for name in PROJECTIONS if name in camera)
        self.projection = Projection(kind, camera[kind], settings.aspect)
        self.projection_matrix = self.projection.matrix()
        self.corners = [applied(self.projection_matrix, p) for p in points_of(stages.view_lossless)]
        self.clipped = clip(self.corners, self.projection, settings.clip or "auto", settings.cull)
        self.ndc = [[tuple(x / vertex.point[3] for x in vertex.point[:3]) for vertex in piece]
                    for piece in self.clipped.pieces]


def agrees(words, point, digits):
    """True if the words of a vertex in a stage text are a point's coordinates, correctly rounded."""
    if digits == "exact":
        return list(map(float, words)) == list(map(float, point))
    return words == [coordinate(x, digits) for x in point]
