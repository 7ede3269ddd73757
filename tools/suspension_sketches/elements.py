"""What every picture is made of: colors and sizes [px], and the SVG of single elements. Places are (x, y), y down."""

FONT, LABEL, TITLE = "Helvetica, Arial, 'DejaVu Sans', sans-serif", 13, 14
INK, SOFT, CHASSIS, TIRE = "#24292f", "#6e7781", "#c4cad1", "#eceff2"
COLORS = {"carrier": "#1f6feb", "arm": "#1a7f37", "link": "#24292f", "driven": "#bc4c00", "rod": "#8250df",
          "spring": "#8c6d1f"}
LINK_WIDTH, THIN, JOINT = 3.2, 1.4, 4.6


def polygon(points, fill, stroke, width, opacity=1.0):
    corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return (f'<polygon points="{corners}" fill="{fill}" fill-opacity="{opacity}" stroke="{stroke}" '
            f'stroke-width="{width}" stroke-linejoin="round"/>')


def polyline(points, stroke, width, dash=""):
    corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return (f'<polyline points="{corners}" fill="none" stroke="{stroke}" stroke-width="{width}" '
            f'stroke-linecap="round" stroke-linejoin="round"{dashes}/>')


def circle(center, radius, fill, stroke, width):
    return (f'<circle cx="{center[0]:.1f}" cy="{center[1]:.1f}" r="{radius:.1f}" fill="{fill}" stroke="{stroke}" '
            f'stroke-width="{width}"/>')


def chassis_mark(at):
    return f'<rect x="{at[0] - 8.5:.1f}" y="{at[1] - 8.5:.1f}" width="17" height="17" rx="4" fill="{CHASSIS}"/>'


def text(at, words, color, size, anchor, halo=False):
    head = f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" font-family="{FONT}" font-size="{size}" text-anchor="{anchor}"'
    line = f'{head} fill="{color}">{words}</text>'
    if halo:
        around = 'fill="#ffffff" stroke="#ffffff" stroke-width="3.5" stroke-linejoin="round"'
        line = f"{head} {around}>{words}</text>\n" + line
    return line


def page(name, width, height, content):
    """A whole file: the content on a white sheet."""
    head = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
            f'viewBox="0 0 {width:.0f} {height:.0f}">',
            f"<title>{name}</title>",
            f'<rect x="0.5" y="0.5" width="{width - 1:.0f}" height="{height - 1:.0f}" rx="12" fill="#ffffff" '
            f'stroke="#d0d7de"/>']
    return "\n".join(head + content + ["</svg>", ""])
