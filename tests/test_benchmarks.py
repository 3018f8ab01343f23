"""Benchmarks are run seldom; what they take of Gazelle is there all the same."""

from __future__ import annotations

import ast
import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SCRIPTS = sorted(ROOT.glob("benchmarks/**/*.py"))


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_what_a_benchmark_imports_is_there(path: Path) -> None:
    missing = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "gazelle":
            missing += _missing(str(node.module), [alias.name for alias in node.names])
    assert not missing


def _missing(module: str, names: list[str]) -> list[str]:
    try:
        found = importlib.import_module(module)
    except ModuleNotFoundError:
        return [module]
    return [f"{module}.{name}" for name in names if not _has(found, name)]


def _has(module: object, name: str) -> bool:
    if hasattr(module, name):
        return True
    try:
        importlib.import_module(f"{module.__name__}.{name}")  # type: ignore[attr-defined]
    except ModuleNotFoundError:
        return False
    return True
