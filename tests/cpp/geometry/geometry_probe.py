"""A library with C++'s geometry, called by ctypes."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from gazelle.cpp.building.runtime import ensure_runtime
from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain

__all__ = ["CppTree", "GeometryProbe"]

_SOURCE = Path(__file__).with_name("geometry_probe.cpp")
_SINK = ctypes.CFUNCTYPE(None, ctypes.c_char_p)
_NAMES = {1: "lookup", 2: "connectivity", 3: "extrapolation", 4: "invalid"}


class GeometryProbe:
    """Calls functions of C++; numbers in, numbers out."""

    def __init__(self, folder: Path) -> None:
        """Compile it."""
        try:
            find_toolchain()
        except NoToolchainError as error:
            pytest.skip(str(error))
        output = folder / "libgeometry_probe.so"
        command = [sys.executable, "-m", "gazelle.cpp.compile", str(_SOURCE), "-o", str(output)]
        command += ["--ros", "0", "--shared", "-f=-O1", "--lib", "tf2", "--lib", "kdl"]
        done = subprocess.run(command, check=False, capture_output=True)
        assert done.returncode == 0, done.stderr.decode()
        for library in ensure_runtime(["core", "tf2", "kdl"], 0).libraries.values():
            ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
        self.library = ctypes.CDLL(str(output))
        for name in ("eigen_check", "shortest_with_limits", "tree_chain_error"):
            getattr(self.library, name).restype = ctypes.c_double
        self.library.tree_new.restype = ctypes.c_void_p
        self.library.tree_request.restype = ctypes.c_uint64

    def numbers(self, name: str, *inputs: Sequence[float], sizes: Sequence[int]) -> Any:
        """Call a function with arrays of doubles; return those that it fills, or the one.

        Args:
            name: of the function.
            inputs: numbers that it reads.
            sizes: how many it writes, for each array.
        """
        outputs = [(ctypes.c_double * size)() for size in sizes]
        given = [(ctypes.c_double * len(one))(*one) for one in inputs]
        getattr(self.library, name)(*given, *outputs)
        lists = [list(one) for one in outputs]
        return lists[0] if len(lists) == 1 else lists


class CppTree:
    """`gazelle::FrameTree`, with the functions of `gazelle.graph.tf.TransformBuffer`."""

    def __init__(self, probe: GeometryProbe, cache_ns: int = 10_000_000_000) -> None:
        """Start empty."""
        self._library = probe.library
        self._tree = ctypes.c_void_p(self._library.tree_new(ctypes.c_int64(cache_ns)))

    def close(self) -> None:
        """Free it."""
        self._library.tree_delete(self._tree)

    def set(
        self, parent: str, child: str, stamp_ns: int, pose: Any, *, is_static: bool = False
    ) -> bool:
        """Add ``T_parent_child``; a pose is a position and a quaternion."""
        values = (ctypes.c_double * 7)(*pose.position_m, *pose.quat_xyzw)
        names = parent.encode(), child.encode()
        stamp = ctypes.c_int64(stamp_ns)
        return bool(
            self._library.tree_set(self._tree, *names, stamp, values, b"me", int(is_static))
        )

    def look_up(self, target: str, source: str, stamp_ns: int = 0) -> tuple[str, Any]:
        """Return the kind of failure (empty: none), and its text or stamp and pose."""
        found, pose, said, sink = self._answer()
        stamp = ctypes.c_int64(stamp_ns)
        code = self._library.tree_look_up(
            self._tree, target.encode(), source.encode(), stamp, ctypes.byref(found), pose, sink
        )
        return (_NAMES[code], said[0]) if code else ("", (found.value, list(pose)))

    def look_up_between(
        self, target: str, target_ns: int, source: str, source_ns: int, fixed: str
    ) -> tuple[str, Any]:
        """The same between two times."""
        found, pose, said, sink = self._answer()
        ends = (
            (target.encode(), ctypes.c_int64(target_ns)),
            (
                source.encode(),
                ctypes.c_int64(source_ns),
            ),
        )
        code = self._library.tree_look_up_between(
            self._tree, *ends[0], *ends[1], fixed.encode(), ctypes.byref(found), pose, sink
        )
        return (_NAMES[code], said[0]) if code else ("", (found.value, list(pose)))

    def why_not(self, target: str, source: str, stamp_ns: int = 0) -> str:
        """Return why it cannot be had, empty where it can."""
        said: list[str] = []
        sink = _SINK(lambda text: said.append(text.decode()))
        stamp = ctypes.c_int64(stamp_ns)
        is_there = self._library.tree_can(self._tree, target.encode(), source.encode(), stamp, sink)
        assert is_there == (not said[0])
        return said[0]

    def request(self, target: str, source: str, stamp_ns: int) -> int:
        """Ask to be told; `text` 4 has the answers."""
        stamp = ctypes.c_int64(stamp_ns)
        return int(self._library.tree_request(self._tree, target.encode(), source.encode(), stamp))

    def text(self, what: int) -> str:
        """Return frames as text (0), YAML (1) or dot (2), warnings (3), answers (4)."""
        said: list[str] = []
        self._library.tree_text(self._tree, what, _SINK(lambda text: said.append(text.decode())))
        return said[0]

    def chain(self, target: str, source: str) -> list[str]:
        """Return the frames from source to target."""
        said: list[str] = []
        sink = _SINK(lambda text: said.append(text.decode()))
        self._library.tree_chain(self._tree, target.encode(), source.encode(), sink)
        return said[0].split()

    def clear(self) -> None:
        """Forget what moves."""
        self._library.tree_clear(self._tree)

    def _answer(self) -> tuple[Any, Any, list[str], Any]:
        said: list[str] = []
        sink = _SINK(lambda text: said.append(text.decode()))
        return ctypes.c_int64(), (ctypes.c_double * 7)(), said, sink
