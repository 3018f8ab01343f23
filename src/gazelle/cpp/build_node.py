"""What every node's file is linked with: see ``runtime/core/node_start.c``."""

from __future__ import annotations

from pathlib import Path

from gazelle.cpp.build_cache import cache_top
from gazelle.cpp.build_objects import Job, compiled
from gazelle.cpp.runtime_libraries import HERE
from gazelle.cpp.toolchain import Toolchain

__all__ = ["node_objects"]


def node_objects(toolchain: Toolchain) -> list[Path]:
    """Return the objects that make a program of a shared library."""
    source = HERE / "runtime" / "core" / "node_start.c"
    job = Job(source, {"own": source.parent})
    return [compiled(job, toolchain, cache_top() / "objects") / "object.o"]
