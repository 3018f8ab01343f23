"""Compiling files of ours, each once for a content: objects and precompiled headers are kept.

An object is kept with the digests of all files of ours that went into it. Whoever wants it again
looks whether these are as they were; so a change of one header compiles anew what includes it and
nothing else, in whatever order versions come and go.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from gazelle.cpp.building.cache import digest_of_file, digest_of_text, make_whole, only_one
from gazelle.cpp.building.errors import compiler_failure
from gazelle.cpp.building.toolchain import Toolchain

__all__ = ["Job", "Roots", "compiled", "is_kept", "link"]

_KEPT_VERSIONS = 4
_KEPT_HEADERS = 2
_DEPENDENCIES = "dependencies.json"

Roots = Mapping[str, Path]
"""Folders of ours that headers come from, by a label that stays when a folder's name changes."""


@dataclass(frozen=True, slots=True)
class Job:
    """A file to compile.

    Attributes:
        source: the file.
        roots: folders of headers, in order.
        flags: beside the toolchain's.
        is_header: it is precompiled for others to include.
    """

    source: Path
    roots: Roots
    flags: tuple[str, ...] = ()
    is_header: bool = False

    def command(self, toolchain: Toolchain) -> list[str]:
        """Return the compiler's words up to its input."""
        is_c = self.source.suffix == ".c"
        words = list(toolchain.c_command if is_c else toolchain.command)
        words += [flag for flag in toolchain.flags if not (is_c and flag.startswith("-std="))]
        for root in self.roots.values():
            words += ["-isystem", str(root)]
        return [*words, *toolchain.include_flags, *self.flags]


def compiled(job: Job, toolchain: Toolchain, top: Path) -> Path:
    """Return the folder with a job's product, ``object.o`` or the header's name with ``.gch``.

    Args:
        job: what to compile.
        toolchain: by what.
        top: below which products are kept.

    Raises:
        CppBuildError: the compiler refused it.
    """
    place = _place(job, toolchain, top)
    if found := _kept(place, job.roots):
        return found
    # Of the processes of a launch several want the same file: one compiles it.
    with only_one(place / ".lock", "compiling Gazelle's C++ libraries"):
        while True:
            if found := _kept(place, job.roots):
                return found
            if made := _made(job, toolchain, place):
                return made


def is_kept(job: Job, toolchain: Toolchain, top: Path) -> bool:
    """Tell whether a job's product is there, made of what its files are now."""
    return _kept(_place(job, toolchain, top), job.roots) is not None


def _place(job: Job, toolchain: Toolchain, top: Path) -> Path:
    words = (toolchain.key, job.source.name, *job.flags, *job.roots, str(job.is_header))
    return top / f"{job.source.stem}-{digest_of_text(*words, str(job.source.parent))}"


def _kept(place: Path, roots: Roots) -> Path | None:
    """Return the kept product whose files are all as they were."""
    with contextlib.suppress(OSError):
        for folder in sorted(place.iterdir(), key=_age):
            if not folder.name.startswith(".") and _is_fresh(folder, roots):
                os.utime(folder)
                return folder
    return None


def _age(folder: Path) -> float:
    try:
        return -folder.stat().st_mtime
    except OSError:
        return 0.0


def _is_fresh(folder: Path, roots: Roots) -> bool:
    try:
        listed = json.loads((folder / _DEPENDENCIES).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return all(
        label in roots and digest_of_file(roots[label] / path if path else roots[label]) == digest
        for label, path, digest in listed
    )


def _made(job: Job, toolchain: Toolchain, place: Path) -> Path | None:
    """Compile; None where a file changed meanwhile, so that nobody knows what was read."""
    place.mkdir(mode=0o700, parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".work-", dir=place) as scratch:
        product = f"{job.source.name}.gch" if job.is_header else "object.o"
        output, listing = Path(scratch) / product, Path(scratch) / "dependencies"
        began = time.time_ns()
        command = job.command(toolchain)
        command += ["-x", "c++-header"] if job.is_header else []
        command += [str(job.source), "-o", str(output), "-MD", "-MF", str(listing)]
        command += [] if job.is_header else ["-c"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise compiler_failure(f"compiling '{job.source.name}'", done.stderr + done.stdout)
        dependencies = _own_dependencies(job, listing.read_text(encoding="utf-8"))
        for label, path, _ in dependencies:
            file = job.roots[label] / path if path else job.roots[label]
            with contextlib.suppress(OSError):
                if file.stat().st_mtime_ns > began:
                    return None
        text = json.dumps(dependencies)
        target = place / digest_of_text(text)
        with make_whole(target) as folder:
            output.rename(folder / product)
            if job.is_header:
                # Whose flags do not fit reads the header itself.
                shutil.copyfile(job.source, folder / job.source.name)
            (folder / _DEPENDENCIES).write_text(text, encoding="utf-8")
    _forget_old(place, _KEPT_HEADERS if job.is_header else _KEPT_VERSIONS)
    return target


def _own_dependencies(job: Job, listing: str) -> list[tuple[str, str, str]]:
    """Return label, path below it and digest of the files of ours that the compiler read."""
    words = listing.partition(":")[2].replace("\\\n", " ").replace("\\ ", "\0").split()
    tops = [(label, f"{root.resolve()}{os.sep}") for label, root in job.roots.items()]
    found: dict[tuple[str, str], str] = {}
    for word in words:
        path = os.path.realpath(word.replace("\0", " "))
        for label, top in tops:
            if path.startswith(top):
                found[label, path[len(top) :]] = digest_of_file(path)
                break
    return sorted((label, path, digest) for (label, path), digest in found.items())


def _forget_old(place: Path, most: int) -> None:
    with contextlib.suppress(OSError):
        kept = [item for item in place.iterdir() if not item.name.startswith(".")]
        for folder in sorted(kept, key=_age)[most:]:
            shutil.rmtree(folder, ignore_errors=True)


def link(objects: Sequence[Path], toolchain: Toolchain, output: Path, flags: Sequence[str]) -> None:
    """Link objects to a shared library.

    Raises:
        CppBuildError: the linker refused it.
    """
    command = [*toolchain.link_command, "-shared", "-fPIC", *map(str, objects), "-o", str(output)]
    done = subprocess.run([*command, *flags], capture_output=True, text=True, check=False)
    if done.returncode:
        raise compiler_failure(f"linking '{output.name}'", done.stderr + done.stdout)
