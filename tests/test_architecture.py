"""The order of layers in docs/architecture.md is the order of imports."""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "gazelle"
LONGEST_FILE = 500
LONGEST_FUNCTION = 40


def _layers() -> dict[str, int]:
    """Rank by row of the table; layers of one row may import each other."""
    rank: dict[str, int] = {}
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    rows = [line for line in text.splitlines() if line.startswith("| `gazelle")]
    for row, line in enumerate(rows):
        for name in re.findall(r"`(gazelle[\w.]*)`", line.split("|")[1]):
            rank[name] = row
    return rank


def _modules() -> list[Path]:
    drop_ins = SOURCE / "compat" / "modules"
    return sorted(path for path in SOURCE.rglob("*.py") if drop_ins not in path.parents)


def _module_name(path: Path) -> str:
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _layer_of(module: str, layers: dict[str, int]) -> str:
    parts = module.split(".")
    while parts:
        if ".".join(parts) in layers:
            return ".".join(parts)
        parts.pop()
    raise AssertionError(f"{module} belongs to no layer of docs/architecture.md")


def _imports(tree: ast.AST) -> set[str]:
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= (
                {f"gazelle.{alias.name}" for alias in node.names}
                if node.module == "gazelle"
                else {node.module}
            )
    return {name for name in found if name.split(".")[0] == "gazelle"}


def test_no_layer_imports_a_higher_one() -> None:
    layers = _layers()
    wrong = []
    for path in _modules():
        module = _module_name(path)
        if module == "gazelle":
            continue
        own = _layer_of(module, layers)
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for name in sorted(_imports(tree)):
            other = _layer_of("gazelle._version" if name == "gazelle.__version__" else name, layers)
            if other != own and layers[other] > layers[own]:
                wrong.append(f"{module} ({own}) imports {name} ({other})")
    assert not wrong, "\n".join(wrong)


def test_every_subpackage_is_a_layer() -> None:
    layers = _layers()
    folders = {f"gazelle.{path.parent.name}" for path in SOURCE.glob("*/__init__.py")}
    assert folders <= set(layers)


def test_files_and_functions_stay_short() -> None:
    wrong = []
    for path in _modules():
        text = path.read_text(encoding="utf-8")
        if len(text.splitlines()) > LONGEST_FILE:
            wrong.append(f"{path.relative_to(ROOT)} has more than {LONGEST_FILE} lines")
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                body = node.body[1:] if ast.get_docstring(node) else node.body
                length = (node.end_lineno or 0) - body[0].lineno + 1 if body else 0
                if length > LONGEST_FUNCTION and not _is_compiled(node):
                    wrong.append(f"{path.relative_to(ROOT)}:{node.lineno} {node.name}: {length}")
    assert not wrong, "\n".join(wrong)


def _is_compiled(node: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    """Numba kernels are one loop nest by nature; splitting them costs speed."""
    return any("njit" in ast.unparse(decorator) for decorator in node.decorator_list)


def test_nothing_imports_by_a_forbidden_name() -> None:
    forbidden = {"utils", "helpers", "misc", "manager", "common"}
    assert not [path for path in _modules() if path.stem in forbidden]
