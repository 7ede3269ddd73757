#!/usr/bin/env python3
"""Heights of OpenCRG's sample files by ASAM's own C library, which the wheel pycrg carries.

The test OpencrgReference reads what this prints. Made with

    pip install pycrg==2.2.0
    python3 tests/io/opencrg/reference.py > tests/io/opencrg/heights.txt

and with --points 1000 for a longer look; with --binary it writes crg-bin/ instead. Each case is a sample, or one with a section
inserted before its data definition, then
either "refused" or points (x, y) with the library's height, "none" where it has none. A file without modifiers is evaluated
where it lies, with missing heights filled in: the library leaves applying its own defaults to its caller.
"""

import argparse
import logging
import math
import pathlib
import random
import struct
import tempfile

import pycrg

HERE = pathlib.Path(__file__).parent
SAMPLES = HERE / "crg-txt"
BINARIES = HERE / "crg-bin"

OPTIONS = [
    "BORDER_MODE_U=0;BORDER_MODE_V=0",
    "BORDER_MODE_U=1;BORDER_MODE_V=1;BORDER_OFFSET_U=0.25;BORDER_OFFSET_V=-0.5",
    "BORDER_MODE_U=1;BORDER_OFFSET_V=-0.5",
    "BORDER_MODE_V=1;BORDER_OFFSET_U=0.25",
    "BORDER_OFFSET_U=0.25;BORDER_OFFSET_V=-0.5",
    "BORDER_MODE_U=3;BORDER_OFFSET_U=0.1;BORDER_OFFSET_V=0.2",
    "BORDER_MODE_U=4;BORDER_MODE_V=0",
    "BORDER_SMOOTH_UBEG=3;BORDER_SMOOTH_UEND=4.5",
    "BORDER_SMOOTH_UBEG=15;BORDER_SMOOTH_UEND=12",
    "BORDER_MODE_U=0;BORDER_MODE_U=1;BORDER_OFFSET_U=0.3;BORDER_OFFSET_U=0.1",
]
MODIFIERS = [
    "",
    "GRID_NAN_MODE=0",
    "GRID_NAN_MODE=1;GRID_NAN_OFFSET=0.1",
    "SCALE_Z_GRID=1.7;SCALE_SLOPE=0.5;SCALE_BANKING=2;SCALE_LENGTH=1.3;SCALE_WIDTH=0.8;SCALE_CURVATURE=1.4;GRID_NAN_MODE=2",
    "REFPOINT_X=10;REFPOINT_Y=-5;REFPOINT_PHI=0.3;REFPOINT_U_FRACTION=0.5;GRID_NAN_MODE=2",
    "REFPOINT_X=10;REFPOINT_Z=-5;REFPOINT_U=7;REFPOINT_V=0.5;GRID_NAN_MODE=1",
    "REFPOINT_U_FRACTION=1;REFPOINT_U_OFFSET=-3;REFPOINT_V_FRACTION=0.2;REFPOINT_V_OFFSET=0.1;GRID_NAN_MODE=2",
    "REFLINE_OFFSET_X=9;REFLINE_OFFSET_Z=1;REFLINE_OFFSET_PHI=1;REFLINE_ROTCENTER_X=4;GRID_NAN_MODE=2",
]
ROAD = [
    "REFERENCE_LINE_START_Z=0.4;REFERENCE_LINE_END_Z=1.2;REFERENCE_LINE_START_X=3",
    "REFERENCE_LINE_START_S=0.03;REFERENCE_LINE_END_Z=0.5;REFERENCE_LINE_START_B=0.02",
    "REFERENCE_LINE_INCREMENT=2;REFERENCE_LINE_START_PHI=1;REFERENCE_LINE_START_U=5",
    "REFERENCE_LINE_END_U=50;NO_SUCH_KEY=1;REFERENCE_LINE_START_X=1 m",
]
# Of one line with every channel and of one with none.
VARIED = ["handmade_curved_banked_sloped.crg", "handmade_straight.crg"]


# The header of ASAM's crg-bin/belgian_block.crg, where another number of rows and sections changes nothing.
HEADER = """$CT
Made by reference.py with the header of ASAM's crg-bin/belgian_block.crg; the heights are a formula's.
$
$ROAD_CRG_OPTS
warn_curv_local\t\t =  0.0000000000000000e+000
warn_curv_global\t =  1.0000000000000000e+000
$
$ROAD_CRG
reference_line_start_u   =  7.3000000000000000e+002
reference_line_end_u     =  7.3500000000000000e+002
reference_line_increment =  1.0000000000000000e-001
long_section_v_right     = -1.7000000000000000e+000
long_section_v_left      =  1.7000000000000000e+000
long_section_v_increment =  3.4000000000000000e-001
reference_line_start_s   =  0.0000000000000000e+000
reference_line_end_s     =  0.0000000000000000e+000
reference_line_start_b   =  0.0000000000000000e+000
reference_line_end_b     =  0.0000000000000000e+000
reference_line_start_x   =  2.3399574256406882e+002
reference_line_start_y   =  7.7718214098040477e+001
reference_line_start_phi =  2.6527974605560303e+000
reference_line_end_phi   =  2.3053245544433594e+000
reference_line_start_z   =  0.0000000000000000e+000
reference_line_end_z     =  0.0000000000000000e+000
reference_line_start_lon =  9.2328929134970767e+000
reference_line_start_lat =  4.8785742241122470e+001
reference_line_start_alt =  2.2100000000000000e+002
reference_line_end_alt   =  2.2100000000000000e+002
$
* written by crg_write at 2009-10-21 14:58:29
* written by ipl_write at 2009-10-21 14:58:29
$KD_DEFINITION
"""


def write_binaries():
    """Big-endian numbers of four and of eight bytes without ends of rows, the data on a limit of 80 bytes, as ipl_write leaves them."""
    sections, rows = 11, 51
    start, end = 2.6527974605560303, 2.3053245544433594  # as in the header, which leads straight on beyond the ends
    for form, code in (("KRBI", ">f"), ("KDBI", ">d")):
        text = HEADER + f"#:{form}\nU:reference line u,m,730.000,0.100\nD:reference line phi,rad\n"
        text += "".join(f"D:long section {i + 1},m\n" for i in range(sections)) + "$\n"
        text += "$" * (80 - len(text) % 80 + 79) + "\n"
        data = b""
        for row in range(rows):
            phi = start + (end - start) * (min(max(row - 1, 0), rows - 3) / (rows - 3)) ** 2
            heights = [0.02 * math.sin(1.3 * row + 0.7 * i * i) + 0.01 * math.cos(0.9 * row * i) for i in range(sections)]
            if row in (20, 21):
                heights[:3] = [math.nan] * 3
            data += b"".join(struct.pack(code, x) for x in [phi, *heights])
        BINARIES.mkdir(exist_ok=True)
        (BINARIES / f"{form.lower()}.crg").write_bytes(text.encode() + data)


def cases():
    for sample in sorted(SAMPLES.glob("*.crg")) + sorted(BINARIES.glob("*.crg")):
        yield sample, "", ""
    for name in VARIED:
        for section, texts in (("ROAD_CRG_OPTS", OPTIONS), ("ROAD_CRG_MODS", MODIFIERS), ("ROAD_CRG", ROAD)):
            for text in texts:
                yield SAMPLES / name, section, text


def opened(content, path):
    data = pycrg.DataSet.open(str(path), apply_modifiers=False)
    if b"$ROAD_CRG_MODS" not in content.upper():
        data.modifier_remove_all()
        data.modifier_set_int(pycrg.MOD_GRID_NAN_MODE, 2)
    data.modifiers_apply()
    return data


def points(data, count, beyond):
    """Half of them in the grid, half also around it."""
    source = random.Random(1)
    (u0, u1), (v0, v1) = data.u_range(), data.v_range()
    if v1 <= v0:  # sections by number without a left border
        v1 = v0 + 3
    with data.create_contact_point() as contact:
        for i in range(count):
            du, dv = (beyond * (u1 - u0), 0.3 * (v1 - v0)) if i % 2 else (0, 0)
            x, y = contact.uv_to_xy(source.uniform(u0 - du, u1 + du), source.uniform(v0 - dv, v1 + dv))
            yield round(x, 6), round(y, 6)


def height(data, x, y):
    with data.create_contact_point() as contact:  # a fresh one: the search remembers where it was
        z = contact.try_xy_to_z(x, y)
    return "none" if z is None or z != z else f"{z:.11f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=50, help="of each case")
    parser.add_argument("--binary", action="store_true", help="write crg-bin/")
    arguments = parser.parse_args()
    if arguments.binary:
        return write_binaries()
    logging.disable(logging.CRITICAL)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "crg-txt").symlink_to(SAMPLES.resolve())
        (folder / "varied").mkdir()
        for sample, section, insertion in cases():
            content = sample.read_bytes()
            print("file", sample.relative_to(HERE))
            if section:
                print("insert", section, insertion)
                lines = f"${section}\n" + insertion.replace(";", "\n") + "\n$\n"
                content = content.replace(b"$KD_", lines.encode() + b"$KD_", 1)
            path = folder / "varied" / sample.name
            path.write_bytes(content)
            try:
                data = opened(content, path)
            except pycrg.OpenCRGError:
                print("refused")
                continue
            # Beyond the ends of a line its header's headings lead on, which none of the changed headings do.
            beyond = 0 if "PHI" in insertion or "CURVATURE" in insertion else 0.1
            for x, y in points(data, arguments.points, beyond):
                print(x, y, height(data, x, y))


main()
