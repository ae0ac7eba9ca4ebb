"""Drawing for plots: SVG in the reader's theme."""
import html

LIGHT = {
    "card": "#ffffff", "edge": "#d0d7de", "grid": "#e4e8ec", "axis": "#8c959f", "guide": "#afb8c1",
    "band": "#f8ecdc", "ink": "#1f2328", "soft": "#59636e", "series":
        ("#bf2045", "#b86e00", "#0a7d78", "#5b53c4")}
DARK = {
    "card": "#0d1117", "edge": "#3d444d", "grid": "#262c34", "axis": "#656c76", "guide": "#4d5560",
    "band": "#2b2214", "ink": "#e6edf3", "soft": "#9198a1", "series":
        ("#ff7088", "#eda63a", "#45c4bc", "#a79bff")}


def colors(theme):
    rules = """.card { fill: %(card)s; stroke: %(edge)s }
.grid { stroke: %(grid)s } .axis { stroke: %(axis)s }
.guide { stroke: %(guide)s } .band { fill: %(band)s } text { fill: %(ink)s } .soft { fill: %(soft)s }
""" % theme
    for i, color in enumerate(theme["series"]):
        rules += f".s{i} text, .s{i} .dot {{ fill: {color} }} .s{i} .front {{ stroke: {color} }}\n"
    return rules


# The card and everything on it follow the reader's theme.
STYLE = f"""
text {{ font: 12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif }}
.title {{ font-size: 14px; font-weight: 600 }}
.guide {{ stroke-dasharray: 1 3 }} .front {{ stroke-width: 2 }} .behind {{ fill: none; opacity: .7 }}
{colors(LIGHT)}@media (prefers-color-scheme: dark) {{
{colors(DARK)}}}
"""


def text(x, y, words, attributes=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" {attributes}>{html.escape(words)}</text>'


def line(kind, *points):
    return f'<polyline class="{kind}" fill="none" points="' + " ".join(f"{x:.1f},{y:.1f}"
                                                                       for x, y in points) + '"/>'


def dots(kind, points, radius):
    """Circles, as one shape."""
    circle = f"a{radius:g} {radius:g} 0 1 0 {2 * radius:g} 0a{radius:g} {radius:g} 0 1 0-{2 * radius:g} 0z"
    shapes = "".join(f"M{x - radius:.1f} {y:.1f}{circle}" for x, y in points)
    return f'<path class="{kind}" d="{shapes}"/>'


def document(width, height, title, parts, style=""):
    """The whole picture: a card with the parts on it."""
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}">', f"<title>{title}</title>", f"<style>{STYLE}{style}</style>",
        f'<rect class="card" x=".5" y=".5" width="{width - 1}" height="{height - 1}" rx="8"/>',
        *parts]) + "\n</svg>\n"


def spread_out(wanted, gap):
    """Positions as near as possible to the wanted ones (ascending), at least `gap` apart."""
    groups = []  # [sum of the positions that each would have as the group's first, count]
    for place in wanted:
        groups.append([place, 1])
        while len(groups) > 1 and groups[-2][0] / groups[-2][1] + groups[-2][1] * gap > groups[-1][
                0] / groups[-1][1]:
            total, count = groups.pop()
            groups[-1][0] += total - count * groups[-1][1] * gap
            groups[-1][1] += count
    return [total / count + i * gap for total, count in groups for i in range(count)]


def end_labels(points_of, gap=15):
    """Where the labels of lines stand that end at these points, {name: (x, y)}: beside the ends, and apart
    from one another."""
    names = sorted(points_of, key=lambda name: points_of[name][1])
    heights = spread_out([points_of[name][1] for name in names], gap)
    return {name: (points_of[name][0] + 9, y + 4) for name, y in zip(names, heights)}


LINES_TOP, LINES_BOTTOM = 80, 330  # of a panel of lines


def line_panels(title, panels):
    """A plot of panels side by side."""
    parts = (part for i, panel in enumerate(panels) for part in line_panel(80 + 465 * i, *panel))
    return document(940, 400, title, parts)


def line_panel(left, title, unit, ticks, counts, lines):
    """A panel with lines over numbers of triangles: `ticks` are (class, height, words), `counts` words,
    `lines` the heights of each by its name."""
    width, middle = 280, 'class="soft" text-anchor="middle"'
    columns = [left + 10 + j * (width - 20) / max(len(counts) - 1, 1) for j in range(len(counts))]
    yield text(left - 55, 34, title, 'class="title"')
    yield text(left - 55, 52, unit, 'class="soft"')
    for kind, y, words in ticks:
        yield line(kind, (left, y), (left + width, y))
        yield text(left - 8, y + 4, words, 'class="soft" text-anchor="end"')
    for x, words in zip(columns, counts):
        yield text(x, LINES_BOTTOM + 22, words, middle)
    yield text(left + width / 2, LINES_BOTTOM + 46, "triangles", middle)
    labels = end_labels({name: (columns[-1], heights[-1]) for name, heights in lines.items()})
    for j, (name, heights) in enumerate(lines.items()):
        yield f'<g class="s s{j % 4}">' + line("front", *zip(columns, heights))
        yield dots("dot", zip(columns, heights), 4) + text(*labels[name], name) + "</g>"
