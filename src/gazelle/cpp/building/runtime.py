"""Runtime libraries, compiled once for a machine, a version and a compiler.

Each library lies in a folder named by what it is made of, so a running process keeps the one that
it has, whatever is installed or edited meanwhile.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from gazelle.announcements import announce
from gazelle.cpp.building.cache import (
    cache_top,
    digest_of_file,
    digest_of_text,
    forget_unused,
    make_whole,
    stat_signature,
    touch,
)
from gazelle.cpp.building.errors import CppBuildError
from gazelle.cpp.building.messages import known_messages
from gazelle.cpp.building.objects import Job, compiled, is_kept, link
from gazelle.cpp.building.toolchain import NoToolchainError, Toolchain, find_toolchain
from gazelle.cpp.runtime_libraries import (
    HERE,
    LIBRARIES,
    RuntimeLibrary,
    include_roots,
    with_needs,
)

__all__ = ["Runtime", "ensure_runtime", "headers_key", "libraries_for", "roots_of"]

_FILE_S = 2.5
"""What a core of an everyday machine takes for one file."""

_RECORD = "made_of.json"
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
        forget_unused(top)
        _write_state(state, signature, known)
    for path in known.values():
        touch(path.parent)
    return Runtime(chosen, generation, known)


def libraries_for(file: Path) -> list[Path]:
    """Return the runtime libraries that a node's file or a library of the user is linked with.

    They are in the order in which they are to be loaded. A process has one of each: later files get
    what earlier ones have got. A file that was compiled by another compiler, or with other headers
    than today's, gets those libraries that it was linked with, as long as they are there.

    Raises:
        CppBuildError: one cannot be compiled.
        NoToolchainError: one would have to be, and there is no compiler.
    """
    from gazelle.cpp.elf_file import needed_libraries

    linked: dict[str, Path | None] = {"core": None}
    waiting, seen = [file], {file}
    while waiting:
        for name, place in needed_libraries(waiting.pop()):
            short = name.removeprefix("libgazelle_").removesuffix(".so")
            if name.startswith("libgazelle_") and short in LIBRARIES:
                linked[short] = linked.get(short) or place
            elif place is not None and place not in seen:
                seen.add(place)
                waiting.append(place)
    rows = with_needs(tuple(linked))
    generation = max(row.generation for row in rows)
    chosen = _linked_before(rows, linked, generation)
    if chosen is None:
        chosen = ensure_runtime(tuple(linked), generation).libraries
    for path in chosen.values():
        touch(path.parent)
    return [_in_process.setdefault(row.name, chosen[row.name]) for row in rows]


_in_process: dict[str, Path] = {}


def _linked_before(
    rows: Sequence[RuntimeLibrary], linked: Mapping[str, Path | None], generation: int
) -> dict[str, Path] | None:
    """Return the libraries that a file was linked with, where today's do not fit it."""
    places = [place for place in linked.values() if place is not None]
    if not places:
        return None
    recorded = _recorded(places[0].parent)
    if recorded is None or recorded == (_today(), headers_key(generation)):
        return None
    found: dict[str, Path] = {}
    for place in places:
        found |= {path.name: path for path in _needed_by(place)}
    wanted = {row.name: found.get(row.file_name) for row in rows}
    return {name: path for name, path in wanted.items() if path} if all(wanted.values()) else None


def _needed_by(library: Path) -> list[Path]:
    """Return a library of ours and those that it was linked with."""
    try:
        listed = json.loads((library.parent / _RECORD).read_text(encoding="utf-8"))
        return [library, *(path for item in listed["needs"] if (path := Path(item)).is_file())]
    except (OSError, ValueError, LookupError, TypeError):
        # A library of before records were kept.
        return [library]


def _today() -> str:
    """Return the key of this machine's toolchain, empty where there is none any more."""
    try:
        return find_toolchain().key
    except NoToolchainError:
        return ""


def _recorded(folder: Path) -> tuple[str, str] | None:
    try:
        listed = json.loads((folder / _RECORD).read_text(encoding="utf-8"))
        return str(listed["toolchain"]), str(listed["headers"])
    except (OSError, ValueError, LookupError, TypeError):
        return None


def headers_key(generation: int) -> str:
    """Return a digest of the content of all headers of a ROS that are ours."""
    roots = (HERE / "include" / "common", HERE / "include" / f"ros{generation}")
    signature = stat_signature(roots) + str(known_messages(generation) if generation else "")
    file = cache_top() / "state" / f"headers-{generation}-{digest_of_text(str(HERE))}.json"
    try:
        kept = json.loads(file.read_text(encoding="utf-8"))
        if kept["signature"] == signature:
            return str(kept["key"])
    except (OSError, ValueError, LookupError, TypeError):
        kept = {}
    parts = [
        f"{path.relative_to(root)}:{digest_of_file(path)}"
        for root in roots
        for path in sorted(root.rglob("*"))
        if path.is_file()
    ]
    key = digest_of_text(*parts, str(known_messages(generation) if generation else ""))
    _write_json(file, {"signature": signature, "key": key})
    return key


def _build(rows: Sequence[RuntimeLibrary], toolchain: Toolchain, top: Path) -> dict[str, Path]:
    if not toolchain.has_boost:
        from gazelle.cpp.building.toolchain import INSTALL_HINT

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
    words = (toolchain.key, row.name, headers_key(row.generation))
    key = digest_of_text(*words, *map(str, objects), *map(str, needs))
    folder = top / "lib" / f"{row.name}-{key}"
    if not (folder / row.file_name).is_file():
        flags = [*map(str, needs), *(f"-l{name}" for name in row.system)]
        flags += [f"-Wl,-soname,{row.file_name}"] if sys.platform == "linux" else []
        flags += ["-Wl,-z,defs"] if sys.platform == "linux" else []
        with make_whole(folder) as made:
            link(objects, toolchain, made / row.file_name, flags)
            record = {
                "toolchain": toolchain.key,
                "headers": headers_key(row.generation),
                "needs": [str(path) for path in needs],
            }
            (made / _RECORD).write_text(json.dumps(record), encoding="utf-8")
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


def _write_state(file: Path, signature: str, libraries: Mapping[str, Path]) -> None:
    texts = {name: str(path) for name, path in libraries.items()}
    _write_json(file, {"signature": signature, "libraries": texts})


def _write_json(file: Path, value: Mapping[str, object]) -> None:
    # Where it cannot be kept it is found out again.
    with contextlib.suppress(OSError):
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        spare = file.with_name(f"{file.name}.{os.getpid()}")
        spare.write_text(json.dumps(value), encoding="utf-8")
        spare.replace(file)
