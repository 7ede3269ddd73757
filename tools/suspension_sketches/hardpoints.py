"""Where the points of a sketch come from: a shipped vehicle, or the example on a suspension's own page."""

import pathlib
import re
import tomllib

from suspension_sketches.vectors import mirrored

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs/suspensions"


def vehicle_axle(vehicle, name):
    with open(ROOT / "vehicles" / vehicle, "rb") as file:
        car = tomllib.load(file)
    axle = next(axle for axle in car["axle"] if axle["name"] == name)
    return axle, tire_radius(car["tire"][axle["tire"]])


def tire_radius(tire):
    """Unloaded, of the vehicle's file or else of the property file that it names."""
    if "radius_m" in tire:
        return tire["radius_m"]
    file = (ROOT / "vehicles" / tire["file"]).read_text()
    return float(re.search(r"^UNLOADED_RADIUS\s*=\s*([\d.eE+-]+)", file, re.M)[1])


def page_axle(keyword):
    """The first example on the page that is a whole axle."""
    blocks = re.findall(r"^```toml\n(.*?)^```", (PAGES / f"{keyword}.md").read_text(), re.M | re.S)
    for block in blocks:
        axles = tomllib.loads(block).get("axle", [])
        if axles and "wheel" in axles[0]:
            return axles[0], axles[0]["wheel"]["center_m"][2] + 0.012
    raise SystemExit(f"docs/suspensions/{keyword}.md: no example with [axle.wheel]")


def points_of(axle):
    return {key: tuple(value) for key, value in axle["hardpoints"].items() if isinstance(value, list)}


def add_spring(sketch, axle, both=False, views=("front", "side")):
    spring = axle["spring"]
    sketch.spring(spring["body_m"], spring["at_m"], views=views)
    if both and "front" in views:
        sketch.spring(mirrored(spring["body_m"]), mirrored(spring["at_m"]), "", ["front"])
