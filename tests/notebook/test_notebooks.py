"""The notebooks of the documentation, cell by cell in this process."""

from __future__ import annotations

import ast
import json
from pathlib import Path
from typing import Any

import pytest

_FOLDER = Path(__file__).parents[2] / "docs" / "notebooks"
_SECONDS = {"drive": 4, "sense": 4, "control": 4, "map_and_navigate": 12, "move_an_arm": 20}
_MAX_BYTES = 20_000


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow(s)) for name, s in _SECONDS.items()]
)
def test_a_notebook_runs_from_the_first_cell_to_the_last(name: str) -> None:
    space: dict[str, Any] = {"__name__": "__main__"}
    try:
        shown = [_value(cell, space) for cell in _code(name)]
    finally:
        if "sim" in space:
            space["sim"].close()
    charts = [value for value in shown if hasattr(value, "_repr_mimebundle_")]
    assert charts
    assert all("text/html" in value._repr_mimebundle_() for value in charts)


def test_every_notebook_of_the_folder_is_run() -> None:
    assert {path.stem for path in _FOLDER.glob("*.ipynb")} == set(_SECONDS)


@pytest.mark.parametrize("path", sorted(_FOLDER.glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_notebook_is_kept_small_and_without_outputs(path: Path) -> None:
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed")
    assert path.stat().st_size < _MAX_BYTES
    nbformat.validate(json.loads(path.read_text(encoding="utf-8")))
    code = _code(path.stem)
    assert all(not cell["outputs"] and cell["execution_count"] is None for cell in code)


def _code(name: str) -> list[dict[str, Any]]:
    book = json.loads((_FOLDER / f"{name}.ipynb").read_text(encoding="utf-8"))
    return [cell for cell in book["cells"] if cell["cell_type"] == "code"]


def _value(cell: dict[str, Any], space: dict[str, Any]) -> Any:
    """Run a cell; return the value of its last line, as a notebook shows it."""
    tree = ast.parse("".join(cell["source"]))
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "<cell>", "exec"), space)
    if not isinstance(last, ast.Expr):
        return None
    return eval(compile(ast.Expression(last.value), "<cell>", "eval"), space)
