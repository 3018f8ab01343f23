"""Who gives or takes an array is told its shape by the docstring."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[1] / "src" / "gazelle"
# Layers whose docstrings are complete; the others are still to be done.
DONE = (
    "bag",
    "bridge",
    "cli",
    "compat",
    "control",
    "description",
    "documents",
    "engine",
    "geometry",
    "graph",
    "interfaces",
    "mapping",
    "motion",
    "navigation",
    "nodes",
    "noise",
    "notebook",
    "sensors",
    "simulator",
    "studio",
    "testing",
    "workspace",
)
_ARRAYS = {"Array", "BoolArray", "FloatArray", "Indices", "IntArray", "NDArray", "Poses", "ndarray"}
_SHAPE = re.compile(
    r"\([\w`.…*+/ −-]+,[\w`.…*+/ ,−-]*\)|[\w)] ?× ?[\w(]|\bshapes?\b", re.IGNORECASE
)


def _files(layer: str) -> Iterator[Path]:
    """Yield the modules of a layer, which may be a single one."""
    folder = SOURCE / layer
    yield from folder.rglob("*.py") if folder.is_dir() else [folder.with_suffix(".py")]


def _public(body: list[ast.stmt]) -> Iterator[ast.FunctionDef]:
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
            if isinstance(node, ast.ClassDef):
                yield from _public(node.body)
            elif not any(ast.unparse(one).endswith(".setter") for one in node.decorator_list):
                yield node


def _has_array(function: ast.FunctionDef) -> bool:
    given = function.args
    arguments = (*given.posonlyargs, *given.args, *given.kwonlyargs)
    hints = [one.annotation for one in arguments if one.annotation] + [function.returns]
    names = (node for hint in hints if hint for node in ast.walk(hint))
    return any(isinstance(node, ast.Name) and node.id in _ARRAYS for node in names)


@pytest.mark.parametrize("layer", DONE)
def test_public_functions_with_arrays_tell_a_shape(layer: str) -> None:
    silent = [
        f"{path.relative_to(SOURCE)}:{function.lineno} {function.name}"
        for path in sorted(_files(layer))
        if not any(part.startswith("_") for part in path.relative_to(SOURCE).parts)
        for function in _public(ast.parse(path.read_text(encoding="utf-8")).body)
        if _has_array(function) and not _SHAPE.search(ast.get_docstring(function) or "")
    ]
    assert not silent, "no shape in the docstring of\n" + "\n".join(silent)
