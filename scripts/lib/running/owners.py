"""The triangle that each pixel shows, as zbuf --triangle-array writes it."""
import array

NOBODY = -1


def owners_in(path):
    """The numbers of the triangles in a file, from the top left; NOBODY where there is none."""
    data, found = path.read_bytes(), array.array("q")
    found.frombytes(data[10 + int.from_bytes(data[8:10], "little"):])  # after the header of NPY 1.0
    return found
