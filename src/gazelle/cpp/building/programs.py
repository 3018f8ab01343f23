"""Small programs that the build itself needs, compiled once."""

from __future__ import annotations

import subprocess
from pathlib import Path

from gazelle.cpp.building.cache import cache_top, digest_of_file, digest_of_text, make_whole
from gazelle.cpp.building.errors import compiler_failure
from gazelle.cpp.building.toolchain import ZIG_FLAGS, Toolchain
from gazelle.cpp.runtime_libraries import HERE

__all__ = ["launcher", "programs", "tool"]


def tool(name: str, toolchain: Toolchain, *flags: str) -> Path:
    """Return a program of ``runtime/tools``, compiled where that has not been done.

    Args:
        name: of its source without ``.c``.
        toolchain: by what.
        flags: beside the usual ones.

    Raises:
        CppBuildError: it does not compile.
    """
    source = HERE / "runtime" / "tools" / f"{name}.c"
    key = digest_of_text(toolchain.key, digest_of_file(source), *flags)
    folder = cache_top() / "tools" / f"{name}-{key}"
    if not (folder / name).is_file():
        with make_whole(folder) as made:
            command = [
                *toolchain.c_command,
                *toolchain.link_command[len(toolchain.command) :],
                "-O1",
                *flags,
                str(source),
                "-o",
                str(made / name),
            ]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode:
                raise compiler_failure(f"compiling '{source.name}'", done.stderr + done.stdout)
    return folder / name


def launcher(toolchain: Toolchain) -> Path:
    """Return the program that goes before the compiler, ``runtime/tools/compiler_words.c``."""
    return tool("compiler_words", toolchain)


def programs(toolchain: Toolchain) -> tuple[str, str, str, str]:
    """Return C++ compiler, C compiler, archiver and ranlib; the latter empty for CMake's choice."""
    if toolchain.kind == "zig":
        return _zig_programs(toolchain)
    return toolchain.command[0], toolchain.c_command[0], "", ""


def _zig_programs(toolchain: Toolchain) -> tuple[str, str, str, str]:
    """Return programs of one word each for zig's subcommands, which CMake wants."""
    folder = cache_top() / "tools" / f"zig-{toolchain.key}"
    names = ("c++", "cc", "ar", "ranlib")
    if not folder.is_dir():
        with make_whole(folder) as made:
            for name in names:
                file = made / f"zig-{name}"
                flags = " ".join(ZIG_FLAGS) if name in ("c++", "cc") else ""
                text = f"#!/bin/sh\nexec '{toolchain.command[0]}' {name} {flags} \"$@\"\n"
                file.write_text(text, encoding="utf-8")
                file.chmod(0o755)
    cxx, cc, archiver, ranlib = (str(folder / f"zig-{name}") for name in names)
    return cxx, cc, archiver, ranlib
