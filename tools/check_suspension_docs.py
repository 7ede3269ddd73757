#!/usr/bin/env python3
"""Fails where docs/suspensions/ lags behind the recipes: a keyword without page, picture or line in the index, a key
that a page's table lacks or has too many, a kind or a default that is not the recipe's.

Recipes are read from hamilcar/suspension/*.cpp as text: a key is `{"key", kind, "meaning", ...}`, named keys
stand as `const(expr) HardpointKey name{...}`, and `with_steering(...)` adds those of that function.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs/suspensions"
STRING = r'"(?:[^"\\]|\\.)*"'
KEY = re.compile(r'\{\s*"(\w+)",\s*(?:HardpointKind::)?(point|direction|flag|number|length),\s*((?:' + STRING + r'\s*)+)'
                 r'(?:,\s*\{([^{}]*)\})?(?:,\s*(true|false))?\s*\}')
NAMED = re.compile(r"\bHardpointKey (\w+)\s*(?:=\s*one_for_both\(\s*)?(\{.*?\})\)?;", re.S)
RECIPE = re.compile(r"^const Recipe (\w+)_recipe\{(.*?)\};$", re.M | re.S)


def keys_in(code, named):
    """{key: (kind, default)} of the keys that stand in the code, also by name."""
    keys = {m[1]: (m[2], "steered" if m[5] == "true" else m[4]) for m in KEY.finditer(code)}
    for word in re.findall(r"\w+", re.sub(STRING, "", code)):
        keys.update(named.get(word, {}))
    return keys


def recipes():
    """{keyword: (keys, has a rocker)}"""
    out = {}
    for file in sorted((ROOT / "hamilcar/suspension").glob("*.cpp")):
        code = re.sub(r"//[^\n]*", "", file.read_text())
        named = {m[1]: keys_in(m[2], {}) for m in NAMED.finditer(code)}
        steering = re.search(r"with_steering\(std::vector.*?^\}", code, re.M | re.S)
        if steering:
            named["with_steering"] = keys_in(steering[0], {})
        for match in RECIPE.finditer(code):
            keyword = re.search(r'\.keyword = "(\w+)"', match[2])
            out[keyword[1] if keyword else match[1]] = (keys_in(match[2], named), ".may_have_rocker = true" in match[2])
    return out


def tables(page):
    """Keys of all tables `| key | kind | meaning | default |` of a page: {key: (kind, default, line)}."""
    out, inside = {}, False
    for number, line in enumerate(page.read_text().splitlines(), 1):
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|"):
            inside = False
        elif cells == ["key", "kind", "meaning", "default"]:
            inside = True
        elif inside and len(cells) == 4:
            for key in re.findall(r"`(\w+)`", cells[0]):
                out[key] = (cells[1], cells[3], number)
    return out


def stated_default(kind, default):
    """What the page has to say of a key without one, or None where it is free to choose its words."""
    if default == "steered":
        return None
    if kind == "point":
        return "required"
    if kind == "length":
        return "from the points"
    numbers = [float(x) for x in (default or "0").split(",")]
    return {"flag": str(bool(numbers[0])).lower(), "number": f"{numbers[0]:g}",
            "direction": "`[" + ", ".join(f"{x:g}" for x in numbers) + "]`"}[kind]


def check_page(keyword, keys, also):
    page = PAGES / f"{keyword}.md"
    name = page.relative_to(ROOT)
    if not page.is_file():
        yield f"{name}: missing; '{keyword}' is a suspension"
        return
    stated = tables(page)
    for key, (kind, default) in keys.items():
        if key not in stated:
            yield f"{name}: no '{key}' in its tables of keys"
            continue
        says_kind, says_default, line = stated[key]
        if says_kind != kind:
            yield f"{name}:{line}: '{key}' is a {kind}, not a {says_kind}"
        wanted = stated_default(kind, default)
        if wanted is not None and says_default != wanted:
            yield f"{name}:{line}: default of '{key}' is {wanted}, not {says_default}"
    for key in stated:
        if key not in keys and key not in also:
            yield f"{name}:{stated[key][2]}: '{key}' is no key of '{keyword}'"
    if f"pictures/{keyword}.svg" not in page.read_text() or not (PAGES / f"pictures/{keyword}.svg").is_file():
        yield f"{name}: no picture pictures/{keyword}.svg"


def problems():
    found = recipes()
    declared = re.findall(r"\b(\w+)_recipe\b", re.search(r"extern const Recipe ([^;]*);", (
        ROOT / "hamilcar/suspension/recipe.hpp").read_text())[1])
    for keyword in declared:
        if keyword not in found or not found[keyword][0]:
            yield f"hamilcar/suspension: '{keyword}' or its keys not found; is it written as the others are?"
    # Keys that are read elsewhere: of the corners with a program of their own, of a rocker, of rigid bodies.
    composition_file = (ROOT / "hamilcar/io/composition_file.cpp").read_text()
    own = set(re.findall(r'"(\w+_m)"', composition_file))
    rocker = keys_in(re.search(r"rocker_keys\{(.*?)\};", composition_file, re.S)[1], {})
    body = set(re.findall(r'table\.\w+(?:<3>)?\("(\w+)"', (ROOT / "hamilcar/io/body_file.cpp").read_text()))
    index = (PAGES / "README.md").read_text() if (PAGES / "README.md").is_file() else ""
    for keyword, (keys, has_rocker) in found.items():
        yield from check_page(keyword, {**keys, **(rocker if has_rocker else {})}, own | body | {"rod_on"})
    read = (ROOT / "hamilcar/io/linkage_file.cpp").read_text()
    linkage = set(re.findall(r'\b(?:table|axle)\.\w+(?:<3>)?\("(\w+)"', read)) | set(re.findall(
        r'part(?:_or_chassis)?\(\w+, "(\w+)"', read))
    page = PAGES / "linkage.md"
    text = page.read_text() if page.is_file() else ""
    for key in sorted(linkage - {"joint", "cut"} - set(tables(page) if text else ())):
        yield f"docs/suspensions/linkage.md: no '{key}' in its tables of keys"
    for keyword in [*found, "linkage"]:
        if f"({keyword}.md)" not in index:
            yield f"docs/suspensions/README.md: '{keyword}' is not in the index"
        if f"(../suspensions/{keyword}.md)" not in (ROOT / "docs/files/vehicle.md").read_text():
            yield f"docs/files/vehicle.md: no link to the page of '{keyword}'"


def main():
    lines = list(problems())
    for line in lines:
        print(line, file=sys.stderr)
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
