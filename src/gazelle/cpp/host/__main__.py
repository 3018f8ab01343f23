"""``python -m gazelle.cpp.host FILE args…``: the process of a node that is written in C++.

The file is a shared object with a `main`. It has the main thread, the signals, standard input and
the exit code to itself, as if it were a program; what is Python stands aside until it is called.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from gazelle.process_lifetime import (
    collect_garbage_rarely,
    end_at_interrupts,
    end_with_parent,
)

__all__ = ["main", "run_node_file"]

_NOT_LOADED = 127
_NODE_MAIN = "gazelle_node_main"
_NAME_BYTES = 15
_PR_SET_NAME = 15


def main(argv: list[str]) -> int:
    """Run the file named first with the rest as its arguments; returns only where it cannot."""
    if not argv:
        sys.stderr.write("usage: python -m gazelle.cpp.host FILE [args…]\n")
        return 2
    end_at_interrupts()
    collect_garbage_rarely()
    end_with_parent()
    from gazelle.errors import GazelleError

    try:
        return run_node_file(Path(argv[0]), argv)
    except GazelleError as error:
        sys.stderr.write(f"{error}\n")
        return _NOT_LOADED


def run_node_file(path: Path, argv: list[str], runtime: Sequence[Path] = ()) -> NoReturn:
    """Load a node file and run its `main` in this thread; the process ends with it.

    Args:
        path: the file.
        argv: the arguments of its `main`, with the program's name.
        runtime: the runtime libraries, the core first; those that it was linked with by default.

    Raises:
        GazelleError: it, or a library that it needs, cannot be loaded.
    """
    from gazelle.cpp.host.context import HostContext
    from gazelle.cpp.host.table import Core

    core_path, *libraries = runtime or _linked_with(path)
    core = Core(_checked(core_path.resolve()))
    core.library.gazelle_prepare_process()
    context = HostContext(core)
    context.state["argv"] = argv[1:]
    context.attach()
    for library in libraries:
        _load(library)
    program = _load(path.resolve())
    _name_process(path.name)
    words = (ctypes.c_char_p * (len(argv) + 1))()
    # Programs may write into their arguments.
    buffers = [ctypes.create_string_buffer(os.fsencode(word)) for word in argv]
    for place, buffer in enumerate(buffers):
        words[place] = ctypes.cast(buffer, ctypes.c_char_p)
    run: Any = core.library.gazelle_run_main
    run.argtypes = (ctypes.c_void_p, ctypes.c_int, ctypes.c_void_p)
    run(_main_of(program), len(argv), words)
    raise AssertionError("the program has ended")


def _linked_with(path: Path) -> Sequence[Path]:
    from gazelle.cpp.building.runtime import libraries_for

    return libraries_for(path)


def _checked(path: Path) -> Path:
    from gazelle.errors import GazelleError

    if not path.is_file():
        raise GazelleError(f"{path} is not there any more\n  fix: build the package again")
    return path


def _load(path: Path) -> ctypes.CDLL:
    from gazelle.errors import GazelleError

    try:
        return ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL | os.RTLD_NOW)
    except OSError as error:
        from gazelle.graph.errors import coded

        raise GazelleError(
            coded("cpp.not-loaded", f"{path.name} cannot be loaded: {error}")
        ) from error


def _main_of(program: ctypes.CDLL) -> int:
    try:
        # A program of Python has a `main` of its own, which the file's own would give way to.
        return int(ctypes.c_void_p.in_dll(program, _NODE_MAIN).value or 0)
    except ValueError:
        return int(ctypes.cast(program.main, ctypes.c_void_p).value or 0)


def _name_process(name: str) -> None:
    """Show the program's name where processes are listed by their short names."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_NAME, os.fsencode(name)[:_NAME_BYTES], 0, 0, 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
