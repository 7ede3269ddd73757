"""The code of docs/python and the README, word by word, each page from its top to its end."""

import re
from pathlib import Path

import pytest

import hamilcar

BLOCK = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)

NEEDED = (
    ("import jax", "jax"), ("import casadi", "casadi"), ("hamilcar.identify", "scipy"), ("hamilcar.gym", "gymnasium"),
    ("hamilcar.study", "scipy"), ("from distributed", "distributed"), ("study.sensitivity", "SALib"), ("pymoo.", "pymoo"),
    ("import optuna", "optuna"),
)


def pages():
    for folder in (Path(__file__).parents[2], Path(hamilcar.__file__).parent / "share" / "hamilcar"):
        if (folder / "docs" / "python").is_dir():
            found = sorted((folder / "docs" / "python").glob("*.md"))
            readme = folder / "README.md"
            return [page for page in [*found, readme] if page.is_file() and BLOCK.search(page.read_text())]
    return []


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.stem)
def test_code_of_a_page_runs(page, tmp_path, monkeypatch):
    if "plot" in page.read_text():
        pytest.importorskip("matplotlib").use("Agg")
    for text, module in NEEDED:
        if text in page.read_text():
            pytest.importorskip(module)
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in BLOCK.findall(page.read_text()):
        exec(compile(block, str(page), "exec"), names)


def test_there_are_pages():
    assert len(pages()) >= 3
