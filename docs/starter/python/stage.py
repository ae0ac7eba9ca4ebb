"""Three stages of the pipeline: reading and writing are done; the calculation is yours.

    python3 stage.py view < stage1.txt > stage2.txt

The first word is model, view or project. Try each with
    pipeline check-stage view -- python3 stage.py view
"""
import sys

said = set()


def to_do(text):
    """Says once on stderr what is missing; stdout is for the next stage."""
    if text not in said:
        said.add(text)
        print("to do: " + text, file=sys.stderr)


# Your part. A point is a list of three numbers, a matrix a list of four rows.


def transformed(matrix, command, numbers):
    """The current matrix after translate X Y Z, scale X Y Z or rotate DEGREES X Y Z."""
    to_do("transformed() in stage.py: multiply the matrix by the command's, which goes on the right")
    return matrix


def to_world(matrix, p):
    """A vertex of a triangle in world space."""
    to_do("to_world() in stage.py: multiply the matrix by the point (x, y, z, 1)")
    return p


def to_view(eye, look, up, p):
    """A point of world space in view space: the eye at the origin, looking down -z."""
    to_do("to_view() in stage.py: subtract the eye, then turn by the rows r, u and -l")
    return p


def to_ndc(fov_y, aspect, near, far, p):
    """A point of view space in normalized device coordinates. The angle is in degrees."""
    to_do("to_ndc() in stage.py: multiply by the perspective matrix, then divide by w")
    return p


# The rest is done.


def write(p, count):
    """Writes a vertex, and a blank line after every third."""
    print("%.7f %.7f %.7f" % tuple(p), end="\n\n" if count % 3 == 2 else "\n")


def model(lines):
    """Reads a scene: four lines of the camera, then commands."""
    lines = [line for line in lines if line]
    for name, line in zip(("eye", "look", "up", "perspective"), lines):
        print(name, line)
    matrix, stack, count, i = [[float(r == c) for c in range(4)] for r in range(4)], [], 0, 4
    while lines[i] != "end":
        command, *words = lines[i].split()
        i += 1
        if command == "push":
            stack.append(matrix)
        elif command == "pop":
            matrix = stack.pop()
        elif command == "triangle":
            for line in lines[i:i + 3]:
                write(to_world(matrix, list(map(float, line.split()))), count)
                count += 1
            i += 3
        else:
            if not words:  # the numbers have a line of their own
                words, i = lines[i].split(), i + 1
            matrix = transformed(matrix, command, list(map(float, words)))


def later_stage(stage, lines):
    """Reads a header of words and numbers, then vertices. View passes the perspective on."""
    header, count = {}, 0
    for line in filter(None, lines):
        word, *rest = line.split()
        if word[0].isalpha():
            header[word] = [float(x) for x in rest if not x.isalpha()]
            if stage == "view" and word == "perspective":
                print(line)
            continue
        p = list(map(float, (word, *rest)))
        if stage == "view":
            p = to_view(header["eye"], header["look"], header["up"], p)
        else:
            p = to_ndc(*header["perspective"], p)
        write(p, count)
        count += 1


if __name__ == "__main__":
    for number, text in enumerate(sys.stdin.read().split("==\n")):  # one text, or many from conform --batch
        print("==\n" * (number > 0), end="")
        lines = [line.partition("#")[0].strip() for line in text.splitlines()]
        model(lines) if sys.argv[1] == "model" else later_stage(sys.argv[1], lines)
