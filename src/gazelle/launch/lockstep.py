"""Launches that repeat exactly: time stands still until the world is complete."""

from __future__ import annotations

import shlex
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace

from gazelle.launch.config import NodeSpec
from gazelle.launch.executables import Executable

__all__ = ["HeldStart", "holds_time", "is_simulator", "with_simulator_words"]

Startable = tuple[NodeSpec, Executable]
_SERVERS = frozenset({"gzserver", "gazebo", "debug", "perf"})
_PAUSED = frozenset({"-u", "--pause"})
_BOND = frozenset({"-b", "-bond", "--bond"})


def is_simulator(executable: Executable) -> bool:
    """Return whether a node is the simulator's server."""
    builtin = executable.builtin
    return builtin is not None and builtin.type in _SERVERS


def with_simulator_words(spec: NodeSpec, words: Sequence[str]) -> NodeSpec:
    """Return a simulator's node with more arguments."""
    return replace(spec, args=" ".join([spec.args, *words]).strip())


def holds_time(nodes: Sequence[Startable]) -> bool:
    """Return whether time is to be held: something is spawned, and no file asks for a pause."""
    servers = [spec for spec, executable in nodes if is_simulator(executable)]
    paused = any(_PAUSED & set(shlex.split(spec.args)) for spec in servers)
    return bool(servers) and not paused and any(_spawns(node) for node in nodes)


class HeldStart:
    """Starts spawners one after another, in the file's order, and then lets time go on.

    Started together they would race, and a model would appear at another time in every run.
    """

    def __init__(
        self,
        nodes: Sequence[Startable],
        *,
        start: Callable[[NodeSpec, Executable], object],
        release: Callable[[], None],
    ) -> None:
        self._start = start
        self._release = release
        self._waiting = deque(node for node in nodes if _spawns(node))
        self._current = ""

    @staticmethod
    def others(nodes: Sequence[Startable]) -> list[Startable]:
        """Return the nodes that start at once."""
        return [node for node in nodes if not _spawns(node)]

    def begin(self) -> None:
        """Start the first spawner."""
        self._next()

    def ended(self, spec: NodeSpec) -> None:
        """Hear that a node has ended."""
        if spec.full_name == self._current:
            self._next()

    def _next(self) -> None:
        if not self._waiting:
            self._current = ""
            self._release()
            return
        spec, executable = self._waiting.popleft()
        self._current = spec.full_name
        self._start(spec, executable)


def _spawns(node: Startable) -> bool:
    """Return whether a node puts a model into the world and ends (``-b`` would stay)."""
    spec, executable = node
    builtin = executable.builtin
    is_spawner = builtin is not None and builtin.target.endswith("spawn_model:run")
    return is_spawner and not _BOND & set(shlex.split(spec.args))
