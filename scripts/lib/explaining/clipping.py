"""The way of a triangle through `project`, in clip space before the divide: culled, dropped or cut,
exactly."""
import dataclasses
import string

# Distances of a point p = (x y z w) from the planes, at least 0 inside.
PLANES = {
    "near": lambda p: p[3] + p[2],
    "far": lambda p: p[3] - p[2],
    "left": lambda p: p[3] + p[0],
    "right": lambda p: p[3] - p[0],
    "bottom": lambda p: p[3] + p[1],
    "top": lambda p: p[3] - p[1],}
NEAREST_UNCUT = 1024  # --clip auto cuts triangles with a corner nearer to the eye plane than near / 1024


@dataclasses.dataclass
class Vertex:
    name: str  # 0, 1, 2 for the triangle's corners, letters for cuts
    point: tuple  # in clip space
    edge: str  # the triangle's edge or the plane along which the polygon goes on from here
    cut: str = ""  # the edge cut here, and the plane, in words


@dataclasses.dataclass
class Clipped:
    """The clipped polygon; `fate` is passed, culled, outside or cut, and `reason` says why."""
    fate: str
    reason: str
    polygon: list

    @property
    def pieces(self):
        """The polygon as a fan of triangles."""
        return [(self.polygon[0], *self.polygon[i:i + 2]) for i in range(1, len(self.polygon) - 1)]


def outside_of(p):
    """The names of the planes that a point is strictly outside of."""
    return [name for name, distance in PLANES.items() if distance(p) < 0]


def winding(points):
    """1 if the part in front of the eye is counterclockwise in NDC, -1 if clockwise, 0 if it is seen
    edge-on."""
    (ax, ay, _, aw), (bx, by, _, bw), (cx, cy, _, cw) = points
    determinant = aw * (bx * cy - by * cx) + bw * (cx * ay - cy * ax) + cw * (ax * by - ay * bx)
    return (determinant > 0) - (determinant < 0)


def cut_at(plane, polygon):
    """The part of a polygon inside a plane (Sutherland and Hodgman, 1974); empty if the part is only an edge
    or a corner."""
    distance = PLANES[plane]
    kept, has_inside = [], False
    for here, there in zip(polygon, polygon[1:] + polygon[:1]):
        a, b = distance(here.point), distance(there.point)
        along = f"the {plane} plane"
        has_inside |= a > 0
        if a >= 0:
            kept.append(dataclasses.replace(here, edge=along) if a == 0 and b < 0 else here)
        if a * b < 0:
            t = a / (a - b)
            point = tuple(p + t * (q - p) for p, q in zip(here.point, there.point))
            kept.append(Vertex("", point, along if a > 0 else here.edge, f"where {along} cuts {here.edge}"))
    return kept if has_inside or len(kept) == len(polygon) else []


def clip(corners, projection, clip_mode, cull_mode):
    """A Clipped of three points in clip space, by the words of --clip and --cull."""
    polygon = [Vertex(str(i), p, f"edge {i}-{(i + 1) % 3}") for i, p in enumerate(corners)]
    turn = winding(corners)
    if turn and cull_mode == ("front" if turn > 0 else "back"):
        way = "counterclockwise" if turn > 0 else "clockwise"
        return Clipped(
            "culled", f"its corners run {way} as the eye sees them: it shows its {cull_mode}, which --cull "
            f"{cull_mode} drops", [])
    if clip_mode == "none":
        return Clipped("passed", "--clip none cuts nothing", polygon)
    if clip_mode == "auto" and (projection.is_parallel or all(NEAREST_UNCUT * p[3] >= projection.near
                                                              for p in corners)):
        why = ("a parallel projection divides by 1"
               if projection.is_parallel else f"no corner comes near the eye (w < near / {NEAREST_UNCUT})")
        return Clipped("passed", f"not cut: {why}", polygon)
    planes = list(PLANES) if clip_mode in ("frustum", "reject") else ["near"]
    outside = [set(outside_of(p)) & set(planes) for p in corners]
    whole = [plane for plane in planes if all(plane in names for names in outside)]
    if whole:
        return Clipped("outside", f"dropped: all corners are outside the {whole[0]} plane", [])
    if not any(outside) or clip_mode == "reject":
        why = ("no plane has all corners outside" if clip_mode == "reject" else
               f"no corner is outside {'a' if len(planes) > 1 else 'the near'} plane")
        return Clipped("passed", f"not cut: {why}", polygon)
    for plane in planes:
        polygon = cut_at(plane, polygon)
        if not polygon:
            return Clipped("outside", f"dropped: nothing is left inside the {plane} plane", [])
    for vertex, letter in zip((vertex for vertex in polygon if vertex.cut), string.ascii_lowercase):
        vertex.name = letter
    return Clipped("cut", "", polygon)
