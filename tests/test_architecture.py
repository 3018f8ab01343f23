"""The order of layers in docs/architecture.md is the order of imports."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "gazelle"
# Launch files and programs of built-in packages are read and run as users' are.
OF_PACKAGES = "gazelle.workspace.builtin."
# A text that is a module's name, with a function behind it, or with what a format string adds.
_NAMED = re.compile(r"""["'](gazelle(?:\.\w+)+)(?::\w+)?[.:]?(?=["'{])""")


def _layers() -> dict[str, int]:
    """Rank by row of the table; layers of one row may import each other."""
    rank: dict[str, int] = {}
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    table = text.partition("## Names that point upwards")[0]
    rows = [line for line in table.splitlines() if line.startswith("| `gazelle")]
    for row, line in enumerate(rows):
        for name in re.findall(r"`(gazelle[\w.]*)`", line.split("|")[1]):
            rank[name] = row
    return rank


class Module(NamedTuple):
    """What the tests look at in a file: that of two thousand syntax trees is not kept."""

    path: Path
    imports: frozenset[str]
    named: frozenset[str]


@cache
def _modules() -> tuple[Module, ...]:
    drop_ins = SOURCE / "compat" / "modules"
    paths = sorted(path for path in SOURCE.rglob("*.py") if drop_ins not in path.parents)
    return tuple(map(_read, paths))


def _read(path: Path) -> Module:
    text = path.read_text(encoding="utf-8")
    statements = list(_statements(ast.parse(text)))
    named = frozenset(name for name in _NAMED.findall(text) if _is_module(name))
    return Module(path, _imports(statements), named)


def _is_module(name: str) -> bool:
    place = SOURCE.parent.joinpath(*name.split("."))
    return place.is_dir() or place.with_suffix(".py").is_file()


def _statements(tree: ast.Module) -> Iterator[ast.stmt]:
    """Yield all statements; expressions, the most of a tree, hold none."""
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        for block in ("body", "orelse", "finalbody", "handlers", "cases"):
            children = getattr(node, block, ())
            waiting += children
            yield from (child for child in children if isinstance(child, ast.stmt))


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


def _imports(statements: list[ast.stmt]) -> frozenset[str]:
    found: set[str] = set()
    for node in statements:
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= (
                {f"gazelle.{alias.name}" for alias in node.names}
                if node.module == "gazelle"
                else {node.module}
            )
    return frozenset(name for name in found if name.split(".")[0] == "gazelle")


def test_no_layer_imports_a_higher_one() -> None:
    layers = _layers()
    wrong = []
    for one in _modules():
        module = _module_name(one.path)
        for name, other in _upwards(module, one.imports, layers):
            wrong.append(f"{module} imports {name} ({other})")
    assert not wrong, "\n".join(wrong)


def test_no_layer_names_a_higher_one_by_text_but_for_the_stated_exceptions() -> None:
    layers, allowed = _layers(), _names_upwards()
    wrong, needed = [], set()
    for one in _modules():
        module = _module_name(one.path)
        for name, other in _upwards(module, one.named, layers):
            pair = (_layer_of(module, layers), other)
            needed.add(pair)
            if pair not in allowed:
                wrong.append(f"{module} names {name} ({other})")
    assert not wrong, "\n".join(wrong)
    assert allowed == needed, "docs/architecture.md allows names that nobody needs"


def test_every_function_that_is_named_by_text_lies_in_a_module() -> None:
    entries = re.compile(r"""["'](gazelle(?:\.\w+)+):\w+["']""")
    wrong = [
        f"{one.path.relative_to(ROOT)}: {name}"
        for one in _modules()
        for name in entries.findall(one.path.read_text(encoding="utf-8"))
        if not _is_module(name)
    ]
    assert not wrong, "\n".join(wrong)


def _upwards(
    module: str, names: frozenset[str], layers: dict[str, int]
) -> Iterator[tuple[str, str]]:
    """Yield those names, with their layers, that lie above the layer of a module."""
    if module == "gazelle" or module.startswith(OF_PACKAGES):
        return
    own = _layer_of(module, layers)
    for name in sorted(names):
        other = _layer_of("gazelle._version" if name == "gazelle.__version__" else name, layers)
        if other != own and layers[other] > layers[own]:
            yield name, other


def _names_upwards() -> set[tuple[str, str]]:
    """Return the pairs of layers of the table of exceptions."""
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    section = text.partition("## Names that point upwards")[2].partition("\n## ")[0]
    rows = [line.split("|")[1:3] for line in section.splitlines() if line.startswith("| `")]
    word = re.compile(r"`(gazelle[\w.]*)`")
    return {(own, other) for first, second in rows for own in word.findall(first)
            for other in word.findall(second)}  # fmt: skip


def test_every_subpackage_is_a_layer() -> None:
    layers = _layers()
    folders = {f"gazelle.{path.parent.name}" for path in SOURCE.glob("*/__init__.py")}
    assert folders <= set(layers)


def test_nothing_imports_by_a_forbidden_name() -> None:
    forbidden = {"utils", "helpers", "misc", "manager", "common"}
    assert not [path for path, *_ in _modules() if path.stem in forbidden]
