"""The command line: ``python -m hamilcar`` is the program ``hamilcar`` that stands in this package."""

import os
import sys
from pathlib import Path


def _program() -> str:
    here = Path(__file__).resolve().parent
    for place in (here / "bin" / "hamilcar", Path(__file__).parent.parent.parent / "hamilcar"):  # a wheel; a build
        if place.is_file():
            return str(place)
    sys.exit("hamilcar: the program is missing from this installation")


def main() -> None:
    program = _program()
    os.execv(program, ["hamilcar", *sys.argv[1:]])


if __name__ == "__main__":
    main()
