"""Random scenes of the kind that the course gives out: a camera, nested transforms, triangles in front of the
camera."""


def numbers(rng, count, limit, decimals=1):
    return " ".join(f"{rng.uniform(-limit, limit):.{decimals}f}" for _ in range(count))


def axis(rng):
    return rng.choice(("1 0 0", "0 1 1", "1 2 3", "-1 0.5 2", "0.3 -0.2 0.9", "2 0 -1"))


def transform(rng):
    return rng.choice((lambda: "translate\n" + numbers(rng, 3, 1, 2),
                       lambda: "scale\n" + " ".join(f"{rng.uniform(0.5, 1.6):.2f}" for _ in range(3)),
                       lambda: f"rotate\n{rng.uniform(-170, 170):.0f} {axis(rng)}",
                       lambda: f"rotate\n{rng.choice((30, 45, -60, 90, 120))} {axis(rng)}"))()


def triangle(rng):
    return "triangle\n" + "\n".join(numbers(rng, 3, 1.5, rng.choice((1, 2, 5))) for _ in range(3))


def block(rng, depth):
    """Transforms, triangles and blocks between push and pop."""
    lines = [transform(rng) for _ in range(rng.randint(1, 2))] + [triangle(rng)]
    if depth < 3 and rng.random() < 0.7:
        lines += ["push", *block(rng, depth + 1), "pop"]
        lines += [transform(rng), triangle(rng)] if rng.random() < 0.7 else []
    return lines


def camera(rng):
    eye = [rng.choice((-1, 1)) * rng.uniform(3, 6) for _ in range(3)]
    near = rng.choice((1, 1.5, 2))
    fov_y, aspect = rng.uniform(35, 70), rng.choice((1, 1.25, 0.8, 1.4))
    return [
        " ".join(f"{x:.2f}" for x in eye),
        numbers(rng, 3, 0.6, 2),
        rng.choice(("0 1 0", "0.2 1 0.1", "-0.3 1.1 0.4", "0 2 0.5")),
        f"{fov_y:.1f} {aspect} {near} {rng.choice((30, 50, 100))}"]


def scene(rng):
    lines = camera(rng)
    for _ in range(rng.randint(1, 2)):
        lines += ["push", *rng.choice(([], ["push"])), *block(rng, 1), "pop"]
        if lines.count("push") > lines.count("pop"):
            lines += [transform(rng), triangle(rng), "pop"]
    return "\n".join([*lines, triangle(rng), "end", ""])


def config(rng, depths):
    """A config; `depths` are the z of the scene's points in NDC, of which the limits may cut some off."""
    width, height = rng.randint(40, 110), rng.randint(40, 110)
    kind = rng.choice(("default", "window", "limits", "limits"))
    if kind == "default":
        return f"{width} {height}\n-1\n-1\n-1 1\n"
    left, bottom = (f"-{rng.uniform(0.4, 1.2):.2f}" for _ in range(2))
    if kind == "window" or not depths:
        return f"{width} {height}\n{left}\n{bottom}\n-1 1\n"
    depths = sorted(depths)
    low, high = depths[len(depths) // 5], depths[-1 - len(depths) // 5]
    front, rear = rng.choice(((low, 1.0), (-1.0, high), (low, high)))
    return f"{width} {height}\n{left}\n{bottom}\n{front:.5f} {max(rear, front + 1e-3):.5f}\n"
