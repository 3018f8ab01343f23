"""The page of C++ headers: `python -m gazelle.cpp.documentation > docs/cpp_headers.md`."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

from gazelle.cpp.header_names import HeaderNames, names_in
from gazelle.cpp.provided_packages import REFUSED

__all__ = ["headers_markdown"]

_INCLUDE = Path(__file__).parent / "include"
_ROOTS = (
    ("common", "Both ROS 1 and ROS 2"),
    ("ros1", "ROS 1"),
    ("ros2", "ROS 2"),
)
_OURS = frozenset({"gazelle", "gazelle_abi.h"})
_ENDINGS = (".h", ".hpp", "")
_SHOWN = 40

_HEAD = """# C++ headers

What C++ of a package can include without a ROS, by header: Gazelle's own headers under the names of
the originals, see [how C++ is compiled](howto/cpp.md). Headers of messages, services and actions
are made of their definitions, for every type that Gazelle knows and for those of your workspace.
*Other names* are headers that only include the one in brackets.
This page is generated: `python -m gazelle.cpp.documentation > docs/cpp_headers.md`.
"""
_REFUSED_HEAD = """## Left out by name

A target that needs one of these is named and left out; what stands beside it is built.

| package | why |
| --- | --- |"""


def headers_markdown() -> str:
    """Return the page: a section per ROS, a table per package, a row per header."""
    lines = [_HEAD]
    for folder, title in _ROOTS:
        packages = _packages(_INCLUDE / folder)
        lines.append(f"## {title}\n")
        for package in sorted(packages):
            lines += [*_section(package, packages[package], _INCLUDE / folder), ""]
    lines.append(_REFUSED_HEAD)
    lines += [f"| {', '.join(f'`{name}`' for name in names)} | {why} |" for why, names in _why()]
    return "\n".join(lines) + "\n"


def _packages(root: Path) -> dict[str, list[Path]]:
    """Return the headers below a folder by the package whose name their first folder is."""
    found: dict[str, list[Path]] = {}
    for path in sorted(root.rglob("*")):
        inside = path.relative_to(root)
        if not path.is_file() or path.suffix not in _ENDINGS or inside.parts[0] in _OURS:
            continue
        package = inside.parts[0] if len(inside.parts) > 1 else "(no folder)"
        found.setdefault(package, []).append(path)
    return found


def _section(package: str, headers: list[Path], root: Path) -> Iterator[str]:
    """Yield the lines of a package: its table, then the headers that only include another one."""
    yield f"### {package}\n"
    rows, others = [], []
    for path in headers:
        name, names = path.relative_to(root).as_posix(), names_in(path)
        known = _declares(names)
        if known:
            rows.append(f"| `{name}` | {known} |")
        else:
            others.append(_as_another(name, names))
    if rows:
        yield "| header | declares |\n| --- | --- |"
        yield from rows
    if others:
        yield f"{chr(10) if rows else ''}Other names: {', '.join(others)}."


def _as_another(name: str, names: HeaderNames) -> str:
    meant = [f"`{one}`" for one in names.includes if "/" in one and not one.startswith("gazelle/")]
    return f"`{name}` ({', '.join(meant)})" if meant else f"`{name}`"


def _declares(names: HeaderNames) -> str:
    functions = _shown(f"{name}()" for name in names.functions)
    return ", ".join([*_shown(names.classes), *functions, *_shown(names.macros)])


def _shown(names: Iterable[str]) -> Iterator[str]:
    everything = list(names)
    yield from (f"`{name}`" for name in everything[:_SHOWN])
    if len(everything) > _SHOWN:
        yield f"{len(everything) - _SHOWN} more"


def _why() -> Iterator[tuple[str, list[str]]]:
    by_reason: dict[str, list[str]] = {}
    for name, why in REFUSED.items():
        by_reason.setdefault(why, []).append(name)
    yield from ((why, sorted(names)) for why, names in sorted(by_reason.items()))


if __name__ == "__main__":
    sys.stdout.write(headers_markdown())
