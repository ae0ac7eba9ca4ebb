"""Drawing for plots: SVG in the reader's theme."""
import html

LIGHT = {
    "card": "#ffffff", "edge": "#d0d7de", "grid": "#e4e8ec", "axis": "#8c959f", "guide": "#afb8c1",
    "band": "#f8ecdc", "ink": "#1f2328", "soft": "#59636e",
    "series": ("#bf2045", "#b86e00", "#0a7d78", "#5b53c4")}
DARK = {
    "card": "#0d1117", "edge": "#3d444d", "grid": "#262c34", "axis": "#656c76", "guide": "#4d5560",
    "band": "#2b2214", "ink": "#e6edf3", "soft": "#9198a1",
    "series": ("#ff7088", "#eda63a", "#45c4bc", "#a79bff")}


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
        f'<rect class="card" x=".5" y=".5" width="{width - 1}" height="{height - 1}" rx="8"/>', *parts
    ]) + "\n</svg>\n"
