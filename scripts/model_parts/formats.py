"""A mesh as the bytes of a model file."""
import base64
import json
import struct

HEADER = "made by pipeline make-model"


def number(x):
    return f"{x:.6f}".rstrip("0").rstrip(".")


def line_of(vector):
    return " ".join(map(number, vector))


def obj(mesh):
    lines = ["# " + HEADER]
    # Colors after the coordinates are common, though not in the format's definition.
    lines += [
        "v " + line_of(p) + color
        for p, color in zip(mesh.vertices, [" " + line_of(x / 255 for x in c)
                                            for c in mesh.colors] or [""] * len(mesh.vertices))]
    lines += ["vn " + line_of(n) for n in mesh.normals]
    lines += ["f " + " ".join(f"{i + 1}//{i + 1}" for i in triangle) for triangle in mesh.triangles]
    return "".join(line + "\n" for line in lines).encode()


def ply(mesh):
    lines = ["ply", "format ascii 1.0", "comment " + HEADER, f"element vertex {len(mesh.vertices)}"]
    lines += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    if mesh.colors:
        lines += [f"property uchar {name}" for name in ("red", "green", "blue")]
    lines += [f"element face {len(mesh.triangles)}", "property list uchar int vertex_indices", "end_header"]
    lines += [
        " ".join(map(line_of, numbers))
        for numbers in zip(mesh.vertices, mesh.normals, *([mesh.colors] if mesh.colors else []))]
    lines += ["3 " + " ".join(map(str, triangle)) for triangle in mesh.triangles]
    return "".join(line + "\n" for line in lines).encode()


def stl(mesh):
    """The binary form: 80 bytes of anything, a count, then 50 bytes a triangle. It has no colors, and normals
    only of triangles: they are 0 here, since every reader calculates them."""
    parts = [HEADER.encode().ljust(80, b"\0"), struct.pack("<I", len(mesh.triangles))]
    for triangle in mesh.triangles:
        corners = [x for i in triangle for x in mesh.vertices[i]]
        parts.append(struct.pack("<12fH", 0, 0, 0, *corners, 0))
    return b"".join(parts)


def linear(channel):
    """The linear value of an sRGB one from 0 to 255 (IEC 61966-2-1)."""
    x = channel / 255
    return x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055)**2.4


def gltf(mesh):
    """glTF 2.0 in one file: the numbers are in a base64 URI. Its colors are linear."""
    positions = b"".join(struct.pack("<3f", *p) for p in mesh.vertices)
    normals = b"".join(struct.pack("<3f", *n) for n in mesh.normals)
    indices = b"".join(struct.pack("<3I", *triangle) for triangle in mesh.triangles)
    colors = b"".join(struct.pack("<3f", *map(linear, color)) for color in mesh.colors)
    data = positions + normals + indices + colors
    FLOAT, UNSIGNED = 5126, 5125
    views, accessors, offset = [], [], 0
    for part, component, count, kind in ((positions, FLOAT, len(
            mesh.vertices), "VEC3"), (normals, FLOAT, len(
                mesh.normals), "VEC3"), (indices, UNSIGNED, 3 * len(mesh.triangles), "SCALAR"),
                                         (colors, FLOAT, len(mesh.colors), "VEC3")):
        if not part:
            continue
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        accessors.append({
            "bufferView": len(accessors), "componentType": component, "count": count, "type": kind})
        offset += len(part)
    accessors[0]["min"] = [min(p[i] for p in mesh.vertices) for i in range(3)]
    accessors[0]["max"] = [max(p[i] for p in mesh.vertices) for i in range(3)]
    document = {
        "asset": {"version": "2.0", "generator": HEADER}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{
            "mesh": 0}], "meshes": [{
                "primitives": [{
                    "attributes": {"POSITION": 0, "NORMAL": 1, **({"COLOR_0": 3} if colors else {})},
                    "indices": 2}]}], "buffers": [{
                        "byteLength": len(data),
                        "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": views, "accessors": accessors}
    return (json.dumps(document) + "\n").encode()


FORMATS = {"obj": obj, "ply": ply, "stl": stl, "gltf": gltf}
