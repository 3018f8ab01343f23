"""What every node's file is linked with: see ``runtime/core/node_start.c``."""

from __future__ import annotations

import platform
import sys
from pathlib import Path

from gazelle.cpp.building.cache import cache_top
from gazelle.cpp.building.objects import Job, compiled
from gazelle.cpp.building.programs import tool
from gazelle.cpp.building.toolchain import Toolchain
from gazelle.cpp.runtime_libraries import HERE

__all__ = ["node_objects"]

_ALONE = (
    "-static-pie",
    "-fPIE",
    "-nostdlib",
    "-nostartfiles",
    "-ffreestanding",
    "-fno-stack-protector",
    "-fno-asynchronous-unwind-tables",
)


def node_objects(toolchain: Toolchain) -> list[Path]:
    """Return the objects that make a program of a shared library.

    Raises:
        CppBuildError: they do not compile.
    """
    source = HERE / "runtime" / "core" / "node_start.c"
    flags: tuple[str, ...] = ()
    if sys.platform == "linux" and platform.machine() in ("x86_64", "aarch64"):
        flags = (f'-DGAZELLE_INTERPRETER="{_interpreter(toolchain)}"',)
    job = Job(source, {"own": source.parent}, flags)
    return [compiled(job, toolchain, cache_top() / "objects") / "object.o"]


def _interpreter(toolchain: Toolchain) -> Path:
    """Return the program that the system runs for a node's file that is run by itself."""
    flags = [f'-DGAZELLE_PYTHON="{sys.executable}"', *_ALONE]
    if HERE.parents[1].name != "site-packages":
        flags.append(f'-DGAZELLE_PATH="{HERE.parents[1]}"')
    return tool("start_node", toolchain, *flags)
