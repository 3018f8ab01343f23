"""Splitting many meshes at once, in processes: CoACD takes one processor for seconds each.

A worker is this module run as a program. It is told of one mesh a line and keeps its pieces on
disk, where the process that loads the world finds them; so its death loses nothing but time.
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Iterable
from pathlib import Path

from gazelle.description.model import MeshShape
from gazelle.documents.npz_files import keeps_arrays
from gazelle.engine.collision_meshes import (
    MeshKey,
    decomposed,
    kept_file,
    mesh_key,
    pieces_folder,
)
from gazelle.errors import GazelleError
from gazelle.geometry import announce

__all__ = ["split_ahead"]

_MIN_COUNT = 4
_TELL_EVERY_S = 3.0
_DONE = b"done\n"


def split_ahead(shapes: Iterable[tuple[MeshShape, bool]]) -> None:
    """Have the pieces of meshes on disk that are not there yet, as far as it is worth while.

    Args:
        shapes: meshes that collide, and whether they are scenery, see `convex_pieces`.
    """
    missing = _missing(shapes)
    count = min(_processors(), len(missing))
    if len(missing) < _MIN_COUNT or count < 2 or not keeps_arrays(pieces_folder()):
        return
    announce(
        f"making convex pieces of {len(missing)} meshes in {count} processes, which takes some "
        f"seconds; this is done once and kept in '{pieces_folder()}'"
    )
    # The largest first: the processes end at about the same time.
    missing.sort(key=lambda key: -key.path.stat().st_size)
    work = _Work(missing)
    threads = [threading.Thread(target=work.go, daemon=True) for _ in range(count)]
    for one in threads:
        one.start()
    work.tell_until_done(threads)


def _missing(shapes: Iterable[tuple[MeshShape, bool]]) -> list[MeshKey]:
    keys: dict[MeshKey, None] = {}
    for shape, scenery in shapes:
        if shape.path is None:
            continue
        try:
            key = mesh_key(shape, shape.path, scenery=scenery)
        except OSError:
            continue  # told when the mesh is looked at
        if key.splitting:
            keys.setdefault(key)
    if len(keys) < _MIN_COUNT:
        return []
    files = {key: kept_file(key) for key in keys}
    return [key for key, file in files.items() if file is not None and not file.exists()]


def _processors() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class _Work:
    """Meshes that wait for a worker."""

    def __init__(self, keys: list[MeshKey]) -> None:
        self._left = deque(keys)
        self._count = len(keys)
        self._done: list[str] = []

    def go(self) -> None:
        """Feed one worker until nothing is left, or it has died."""
        worker = subprocess.Popen(
            [sys.executable, "-m", "gazelle.engine.decomposition_workers"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # Nothing is left to be written to one that has died.
            bufsize=0,
            # Ctrl-C is for the process that loads; its end is theirs.
            start_new_session=True,
        )
        assert worker.stdin is not None and worker.stdout is not None
        with worker:
            while self._left:
                try:
                    key = self._left.popleft()
                except IndexError:
                    break
                try:
                    worker.stdin.write(_line(key))
                except OSError:
                    break
                if worker.stdout.readline() != _DONE:
                    break
                self._done.append(key.path.name)

    def tell_until_done(self, threads: list[threading.Thread]) -> None:
        """Say now and then how far they are."""
        told_s, told = time.monotonic(), 0
        for thread in threads:
            while thread.is_alive():
                thread.join(0.1)
                if len(self._done) > told and time.monotonic() - told_s > _TELL_EVERY_S:
                    told_s, told = time.monotonic(), len(self._done)
                    announce(f"{told} of {self._count} meshes: '{self._done[-1]}'")


def _line(key: MeshKey) -> bytes:
    return json.dumps([str(key.path), *key[1:]]).encode() + b"\n"


def _main() -> None:
    for line in sys.stdin.buffer:
        path, modified_ns, scale, *rest = json.loads(line)
        key = MeshKey(Path(path), modified_ns, tuple(scale), *rest)
        # What is wrong with a mesh is told by the process that loads the world.
        with contextlib.suppress(GazelleError, OSError, ValueError):
            decomposed(key)
        sys.stdout.buffer.write(_DONE)
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    _main()
