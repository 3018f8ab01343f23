"""Precompiled headers: which source of a package begins with which.

Reading ``ros/ros.h`` takes a compiler longer than the node that includes it. So it is compiled once
for the flags that nodes usually get, and a source that includes it is given the compiled one first.
The result is the same: a source that defines macros before its includes, or whose flags differ,
is compiled as it stands.
"""

from __future__ import annotations

import json
import re
import shlex
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from gazelle.announcements import announce
from gazelle.cpp.building.cache import cache_top
from gazelle.cpp.building.errors import CppBuildError
from gazelle.cpp.building.objects import Job, compiled, is_kept
from gazelle.cpp.building.runtime import roots_of
from gazelle.cpp.building.settings import Unit, write_if_changed
from gazelle.cpp.building.toolchain import Toolchain
from gazelle.cpp.runtime_libraries import HERE

__all__ = ["precompiled_header", "precompiled_table"]

_INCLUDED = {1: "ros/ros.h", 2: "rclcpp/rclcpp.hpp"}
_WORTH_IT = 4
"""So many sources have to want one of unusual flags before it is compiled for them."""

_DIRECTIVE = re.compile(r"^[ \t]*#[ \t]*(\w+)[ \t]*(.*)$")
_SEEN = re.compile(r"-(O|g|f|m|std=|DNDEBUG|D_|DBOOST|DEIGEN|DROS|DRCL|U)")
_SAME = re.compile(r"-(fPIC|fPIE|fpic|fpie|fdiagnostics\S*|fcolor\S*|fvisibility\S*|g1)$")
_LEFT_OUT = re.compile(r"-(march=native|mtune=native|std=(c|gnu)\+\+(98|03|0x|11|1y|14|1z|17))$")
_COMMENTS = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_DEPTH = 3


def precompiled_header(
    toolchain: Toolchain, generation: int, flags: tuple[str, ...] = (), *, make: bool = True
) -> Path | None:
    """Return a header beside which lies its compiled form, None where there is none.

    Args:
        toolchain: by what; only GCC's headers fall back to the source where flags differ.
        generation: of ROS.
        flags: beside the toolchain's.
        make: compile it where that has not been done.
    """
    if toolchain.kind != "gcc" or generation not in _INCLUDED:
        return None
    source = HERE / "runtime" / "precompiled" / f"gazelle_ros{generation}.hpp"
    job = Job(source, {**roots_of(generation), "own": source.parent}, flags, is_header=True)
    top = cache_top() / "headers"
    if not make and not is_kept(job, toolchain, top):
        return None
    if not is_kept(job, toolchain, top):
        announce(f"compiling headers of ROS {generation} for this machine, once")
    return compiled(job, toolchain, top) / source.name


def precompiled_table(unit: Unit, toolchain: Toolchain) -> Path | None:
    """Return the table of a package's sources and the headers they begin with, None for none."""
    if toolchain.kind != "gcc" or unit.generation not in _INCLUDED:
        return None
    sources = _sources(unit)
    counts = Counter(flags for _, flags in sources)
    headers: dict[tuple[str, ...], Path | None] = {}
    for flags, count in counts.items():
        try:
            headers[flags] = precompiled_header(
                toolchain, unit.generation, flags, make=not flags or count >= _WORTH_IT
            )
        except CppBuildError:
            # Flags that are wrong are the compiler's to tell, at the user's source.
            headers[flags] = None
    rows = [f"{source}\t{headers[flags]}\n" for source, flags in sources if headers[flags]]
    table = unit.build / "gazelle_precompiled.txt"
    write_if_changed(table, "".join(rows))
    return table if rows else None


def _sources(unit: Unit) -> list[tuple[str, tuple[str, ...]]]:
    """Return the sources that include the header first, and their flags."""
    try:
        text = (unit.build / "compile_commands.json").read_text(encoding="utf-8")
        commands = json.loads(text)
    except (OSError, ValueError):
        return []
    found = []
    for row in commands:
        source = Path(row["file"])
        if source.suffix == ".c" or not source.is_relative_to(unit.path):
            continue
        words = shlex.split(row["command"])
        folders = [Path(word[2:]) for word in words if word.startswith("-I") and len(word) > 2]
        own = [folder for folder in folders if folder.is_relative_to(unit.path)]
        if _includes(source, _INCLUDED[unit.generation], own, _DEPTH):
            found.append((str(source), _unusual(words)))
    return found


def _unusual(words: Iterable[str]) -> tuple[str, ...]:
    """Return the flags that matter for a compiled header, beside those that all get."""
    found = dict.fromkeys(
        word
        for word in words
        if _SEEN.match(word) and not _SAME.match(word) and not _LEFT_OUT.match(word)
    )
    usual = ("-O2", "-g1", "-fno-gnu-unique", "-ffp-contract=off", "-DROS_BUILD_SHARED_LIBS=1")
    kept = [
        word
        for word in found
        if word not in usual and not word.startswith(("-D_GLIBCXX_USE_DEP", "-DBOOST_", "-DEIGEN_"))
    ]
    return tuple(kept)


def _includes(file: Path, header: str, folders: list[Path], depth: int) -> bool:
    """Tell whether a file includes a header, by its own headers too, and defines nothing before."""
    try:
        text = file.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False
    guards: set[str] = set()
    for line in _COMMENTS.sub("", text).splitlines():
        found = _DIRECTIVE.match(line)
        if found is None:
            if line.strip():
                return False
            continue
        word, rest = found[1], found[2].strip()
        if word == "ifndef":
            guards.add(rest)
        elif word == "define" and rest not in guards:
            return False
        elif word == "include":
            name = rest.strip('<>"')
            if name == header:
                return True
            if depth and any(
                _includes(place / name, header, folders, depth - 1)
                for place in (file.parent, *folders)
                if (place / name).is_file()
            ):
                return True
    return False
