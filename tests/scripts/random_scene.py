"""A scene for tests of parts: triangles all over the picture, transforms that are in force for several of
them, and lights."""
import random

CAMERA = "1 0.5 4\n0 0 0\n0 1 0\n50 1.25 1 30 ratio\n"
LIGHT = ("push\ntranslate 0 1 0\nlight\n1 2 3 1 0.9 0.8\npop\nlight\n-3 1 2 0.4 0.4 1\nambient 0.2 0.2 0.2\n"
         "material 1 0.8 0.5 8\nbackground 5 10 15\n")


def scene_of_parts(is_lit, count=400, seed=7):
    rng = random.Random(seed)
    text = CAMERA + LIGHT * is_lit
    for i in range(count):
        x, y, z = (rng.uniform(-2.5, 2.5) for _ in range(3))
        text += "push\nrotate %d 1 2 3\n" % rng.randrange(360) if i % 3 == 0 else ""
        text += "triangle\n" + "".join(f"{x + rng.uniform(-0.5, 0.5):.7f} {y + rng.uniform(-0.5, 0.5):.7f} "
                                       f"{z + rng.uniform(-0.5, 0.5):.7f}\n" for _ in range(3))
        text += "pop\n" if i % 3 == 2 else ""
    return text + "end\n"
