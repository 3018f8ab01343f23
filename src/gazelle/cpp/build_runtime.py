"""The runtime libraries and generated headers, compiled once for a machine, a version and a compiler.

Each library lies in a folder named by what it is made of, so a running process keeps the one that
it has, whatever is installed or edited meanwhile.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from gazelle.announcements import announce
from gazelle.cpp.build_cache import (
    cache_top,
    digest_of_text,
    make_whole,
    stat_signature,
    touch,
)
from gazelle.cpp.build_errors import CppBuildError
from gazelle.cpp.build_messages import known_messages
from gazelle.cpp.build_objects import Job, compiled, is_kept, link
from gazelle.cpp.runtime_libraries import (
    HERE,
    LIBRARIES,
    RuntimeLibrary,
    include_roots,
    with_needs,
)
from gazelle.cpp.toolchain import Toolchain, find_toolchain

__all__ = ["Runtime", "ensure_runtime", "libraries_for", "roots_of"]

_FILE_S = 2.5
"""What a core of an everyday machine takes for one file."""

_WARNINGS = ("-Wall", "-Wextra")


@dataclass(frozen=True, slots=True)
class Runtime:
    """Runtime libraries that are there.

    Attributes:
        toolchain: they were compiled by.
        generation: of ROS, 0 where they belong to none.
        libraries: their files by name, needed ones first.
    """

    toolchain: Toolchain
    generation: int
    libraries: dict[str, Path]


def roots_of(generation: int) -> dict[str, Path]:
    """Return the folders of headers for a ROS by label, generated ones last."""
    roots = {f"include{place}": root for place, root in enumerate(include_roots(generation))}
    if generation:
        roots["messages"] = known_messages(generation)
    return roots


def ensure_runtime(
    names: Sequence[str], generation: int, toolchain: Toolchain | None = None
) -> Runtime:
    """Return libraries with what they need, compiled where that has not been done.

    Args:
        names: of libraries, see `gazelle.cpp.runtime_libraries`.
        generation: of ROS, 0 for none.
        toolchain: that of this machine when None.

    Raises:
        CppBuildError: one cannot be compiled.
        NoToolchainError: there is no compiler.
    """
    chosen = toolchain or find_toolchain()
    rows = with_needs(tuple(names))
    top = cache_top()
    state = top / "state" / f"{chosen.key}-{digest_of_text(str(generation), *sorted(names))}.json"
    signature = stat_signature((HERE / "include", HERE / "runtime")) + "".join(
        str(path) for path in roots_of(generation).values()
    )
    known = _read_state(state, signature)
    if known is None:
        known = _build(rows, chosen, top)
        _write_state(state, signature, known)
    for path in known.values():
        touch(path.parent)
    return Runtime(chosen, generation, known)


def libraries_for(file: Path) -> list[Path]:
    """Return the runtime libraries that a node's file or a library of the user is linked with.

    They are in the order in which they are to be loaded.

    Raises:
        CppBuildError: one cannot be compiled.
    """
    from gazelle.cpp.elf_file import needed_libraries

    names: dict[str, None] = {"core": None}
    waiting, seen = [file], {file}
    while waiting:
        current = waiting.pop()
        for name, place in needed_libraries(current):
            short = name.removeprefix("libgazelle_").removesuffix(".so")
            if name.startswith("libgazelle_") and short in LIBRARIES:
                names[short] = None
            elif place is not None and place not in seen:
                seen.add(place)
                waiting.append(place)
    generation = max((LIBRARIES[name].generation for name in names), default=0)
    rows = with_needs(tuple(names))
    generation = max(row.generation for row in rows)
    return list(ensure_runtime(tuple(names), generation).libraries.values())


def _build(rows: Sequence[RuntimeLibrary], toolchain: Toolchain, top: Path) -> dict[str, Path]:
    if not toolchain.has_boost:
        from gazelle.cpp.toolchain import INSTALL_HINT

        raise CppBuildError(f"there are no headers of Boost here\n  fix: {INSTALL_HINT}")
    jobs: dict[str, list[Job]] = {}
    for row in rows:
        roots = roots_of(row.generation)
        roots["own"] = HERE / "runtime" / (row.folder or row.name)
        jobs[row.name] = [Job(source, roots, _WARNINGS) for source in row.sources]
    everything = [job for row_jobs in jobs.values() for job in row_jobs]
    fresh = sum(not is_kept(job, toolchain, top / "objects") for job in everything)
    if fresh:
        announce(
            f"compiling Gazelle's C++ libraries for this machine, once ({fresh} files, about "
            f"{_about(fresh / (os.cpu_count() or 1) * _FILE_S)})",
            key="compiling runtime",
        )
    workers = max(1, os.cpu_count() or 1)
    objects: dict[str, list[Path]] = {}
    with ThreadPoolExecutor(workers) as pool:
        futures = {
            name: [pool.submit(compiled, job, toolchain, top / "objects") for job in row_jobs]
            for name, row_jobs in jobs.items()
        }
        try:
            for name, waiting in futures.items():
                objects[name] = []
                for future in waiting:
                    objects[name].append(future.result() / "object.o")
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    built: dict[str, Path] = {}
    for row in rows:
        built[row.name] = _linked(row, objects[row.name], built, toolchain, top)
    return built


def _about(seconds: float) -> str:
    if seconds < 45:
        return f"{max(5, round(seconds / 5) * 5)} seconds"
    minutes = max(1, round(seconds / 60))
    return "a minute" if minutes == 1 else f"{minutes} minutes"


def _linked(
    row: RuntimeLibrary,
    objects: Sequence[Path],
    built: dict[str, Path],
    toolchain: Toolchain,
    top: Path,
) -> Path:
    needs = [built[need.name] for need in with_needs((row.name,)) if need.name != row.name]
    key = digest_of_text(toolchain.key, row.name, *map(str, objects), *map(str, needs))
    folder = top / "lib" / f"{row.name}-{key}"
    if not (folder / row.file_name).is_file():
        flags = [*map(str, needs), *(f"-l{name}" for name in row.system)]
        flags += [f"-Wl,-soname,{row.file_name}"] if sys.platform == "linux" else []
        flags += ["-Wl,-z,defs"] if sys.platform == "linux" else []
        with make_whole(folder) as made:
            link(objects, toolchain, made / row.file_name, flags)
    return folder / row.file_name


def _read_state(file: Path, signature: str) -> dict[str, Path] | None:
    try:
        kept = json.loads(file.read_text(encoding="utf-8"))
        libraries = {str(name): Path(path) for name, path in kept["libraries"].items()}
        if kept["signature"] == signature and all(path.is_file() for path in libraries.values()):
            return libraries
    except (OSError, ValueError, LookupError, AttributeError, TypeError):
        # Nothing kept, or half a file: it is made anew.
        return None
    return None


def _write_state(file: Path, signature: str, libraries: dict[str, Path]) -> None:
    import contextlib

    text = json.dumps(
        {"signature": signature, "libraries": {name: str(path) for name, path in libraries.items()}}
    )
    with contextlib.suppress(OSError):
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        spare = file.with_name(f"{file.name}.{os.getpid()}")
        spare.write_text(text, encoding="utf-8")
        spare.replace(file)
