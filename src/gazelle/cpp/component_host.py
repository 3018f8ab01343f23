"""Components of C++ in a process of Python: a container runs them beside built-in nodes."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.cpp.building.runtime import ensure_runtime
from gazelle.cpp.host.context import HostContext
from gazelle.cpp.host.table import Core
from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.interfaces.codec import to_cdr

__all__ = ["ComponentError", "ComponentHost"]

_LIBRARY = "rclcpp_components"
_ROS_2 = 2
_Sink = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.POINTER(ctypes.c_uint8), ctypes.c_size_t)


class ComponentError(GazelleError):
    """A component cannot be made; the text is what its constructor, or the loader, said."""


class ComponentHost:
    """The components of C++ in this process; there is one in a process."""

    def __init__(self, graph: Graph, kind: str = "") -> None:
        """Load the runtime, compiled first where it is not, and let an executor spin.

        Args:
            graph: of the process.
            kind: ``mt`` for an executor of several threads, ``isolated`` for one a component.

        Raises:
            CppBuildError: the runtime cannot be compiled.
            NoToolchainError: there is no compiler.
            ComponentError: it does not start.
        """
        found = ensure_runtime([_LIBRARY], _ROS_2).libraries
        core = Core(found["core"])
        context = HostContext(core, lambda: graph)
        context.attach()
        # In the order of need; the last one is the one that is asked for.
        loaded: list[Any] = [
            ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL) for path in found.values()
        ]
        self._library = loaded[-1]
        self._asked(self._library.gazelle_components_start, ctypes.c_char_p(kind.encode()))

    def load(self, number: int, library: Path, plugin: str, request: Any) -> str:
        """Make a component and run it; returns the node's full name.

        Args:
            number: by which it is unloaded.
            library: the file that holds it.
            plugin: its class.
            request: ``composition_interfaces/srv/LoadNode_Request``.

        Raises:
            ComponentError: it cannot be made.
        """
        data = to_cdr(request)
        return self._asked(
            self._library.gazelle_components_load,
            ctypes.c_uint64(number),
            ctypes.c_char_p(str(library).encode()),
            ctypes.c_char_p(plugin.encode()),
            ctypes.c_char_p(data),
            ctypes.c_size_t(len(data)),
        )

    def unload(self, number: int) -> bool:
        """End a component; False when there is none of the number."""
        return int(self._library.gazelle_components_unload(ctypes.c_uint64(number))) == 0

    def close(self) -> None:
        """End all components."""
        self._library.gazelle_components_stop()

    @staticmethod
    def _asked(function: Callable[..., int], *arguments: Any) -> str:
        parts: list[bytes] = []

        def take(_context: Any, data: Any, size: int) -> None:
            parts.append(ctypes.string_at(data, size))

        status = function(*arguments, _Sink(take), None)
        text = b"".join(parts).decode("utf-8", "replace")
        if status != 0:
            raise ComponentError(text)
        return text
