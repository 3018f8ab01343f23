"""``gazelle warm``: all kernels compiled ahead, so that nothing waits for them later."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterable
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["main"]

_WARM_UPS = {
    "sensors": "gazelle.sensors.kernel_warm_up",
    "mapping": "gazelle.mapping.slam.kernel_warm_up",
    "motion": "gazelle.motion.kernel_warm_up",
    "navigation": "gazelle.navigation.kernel_warm_up",
}
"""Modules whose ``warm_up()`` runs every kernel of an area, as it is run otherwise."""
_COMPILED, _KEPT, _FAILED = "compiled", "kept", "failed"
_STOP_S = 5.0


class _Work(NamedTuple):
    """A process that compiles the kernels of one area."""

    process: subprocess.Popen[str]
    what: str
    compile_s: int


class _Found(NamedTuple):
    """What the processes told.

    Attributes:
        compiled: names of kernels.
        folders: where kernels are kept; an empty name for those that are not.
        faults: what was written to the standard error.
        failed: processes that broke.
    """

    compiled: list[str]
    folders: set[str]
    faults: list[str]
    failed: list[str]


def main(argv: list[str]) -> int:
    """Compile all kernels; 1 where they could not be compiled or kept."""
    options = _parser().parse_args(argv)
    if options.only:
        return _compile(options.only)
    began = time.perf_counter()
    found = _compile_all(max(1, options.jobs))
    for line in dict.fromkeys(found.faults):
        print(line, file=sys.stderr)
    if found.failed:
        print(f"gazelle warm: {', '.join(found.failed)} could not be compiled", file=sys.stderr)
        return 1
    where = _common(found.folders)
    if where is None:
        print("gazelle warm: the kernels work, but cannot be kept: see above", file=sys.stderr)
        return 1
    if found.compiled:
        seconds = time.perf_counter() - began
        print(f"{len(found.compiled)} kernels compiled in {seconds:.0f} s, kept in {where}")
    else:
        print(f"nothing is to be done: all kernels are kept in {where}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle warm",
        description="Compile all kernels for this machine (cameras, SLAM, arm planning, "
        "navigation), which the first use of each does otherwise. What is kept already stays.",
    )
    parser.add_argument(
        "-j", "--jobs", type=int, default=os.cpu_count() or 1, metavar="N",
        help="processes at a time; as many as there are cores otherwise",
    )  # fmt: skip
    parser.add_argument("--only", choices=_WARM_UPS, help=argparse.SUPPRESS)
    return parser


def _compile_all(jobs: int) -> _Found:
    """Compile every area in a process of its own, the longest first."""
    from rich.console import Console
    from rich.progress import Progress

    from gazelle.kernels import AREAS

    found = _Found([], set(), [], [])
    areas = sorted(AREAS, key=lambda area: -area.compile_s)
    waiting, running = list(areas), threading.Semaphore(jobs)
    started: list[_Work] = []
    with Progress(console=Console(stderr=True), transient=True) as bar:
        rows = {area.package: bar.add_task(area.what, total=None) for area in areas}
        threads: list[threading.Thread] = []
        try:
            for area in waiting:
                running.acquire()
                words = [sys.executable, "-m", "gazelle.cli", "warm", "--only", area.package]
                process = subprocess.Popen(
                    words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
                )
                work = _Work(process, area.what, area.compile_s)
                started.append(work)
                thread = threading.Thread(
                    target=_follow, args=(work, found, bar, rows[area.package], running)
                )
                threads.append(thread)
                thread.start()
            for thread in threads:
                thread.join()
        except BaseException:
            for work in started:
                work.process.terminate()
            for work in started:
                work.process.wait(_STOP_S)
            raise
    return found


def _follow(work: _Work, found: _Found, bar: Any, row: Any, running: threading.Semaphore) -> None:
    """Take what a process tells until it ends."""
    process = work.process
    assert process.stdout is not None
    assert process.stderr is not None
    faults: list[str] = []
    errors = threading.Thread(target=lambda: faults.extend(process.stderr or ()))
    errors.start()
    for line in process.stdout:
        word, _, rest = line.rstrip("\n").partition(" ")
        if word == "total":
            bar.update(row, total=int(rest))
        elif word == _COMPILED:
            found.compiled.append(rest)
            bar.advance(row)
        elif word == _KEPT:
            found.folders.add(rest)
    errors.join()
    if process.wait():
        found.failed.append(work.what)
    found.faults.extend(line.rstrip("\n") for line in faults)
    bar.update(row, total=1, completed=1)
    running.release()


def _compile(package: str) -> int:
    """Compile the kernels of one area in this process, and tell of each."""
    from gazelle.announcements import announce_by
    from gazelle.kernels import KernelSource, compiling, kernels
    from gazelle.kernels.kept_code import folder_of

    announce_by(_only_faults)

    def tell(source: KernelSource, _: float) -> None:
        print(f"{_COMPILED} {source.name}", flush=True)

    warm_up = import_module(_WARM_UPS[package]).warm_up
    # Those whose names begin with an underscore are compiled with what calls them.
    own = [one for one in kernels() if not one.source.function.__name__.startswith("_")]
    print(f"total {len(own)}", flush=True)
    with compiling(tell):
        warm_up()
    for folder in sorted({str(folder_of(kernel.source) or "") for kernel in kernels()}):
        print(f"{_KEPT} {folder}", flush=True)
    return 0


def _only_faults(text: str) -> None:
    """Pass on what went wrong: that kernels are compiled is seen."""
    if "\n  fix: " in text:
        print(text, file=sys.stderr, flush=True)


def _common(folders: Iterable[str]) -> str | None:
    """Return the folder around all; None where some kernels are not kept."""
    known = set(folders)
    if not known or "" in known:
        return None
    if {Path(folder).name for folder in known} == {"__pycache__"}:
        return f"{os.path.commonpath(known)} (__pycache__ beside each module)"
    return os.path.commonpath(known)
