"""Launches that repeat exactly: time stands still until the world is complete."""

from __future__ import annotations

import shlex
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace

from gazelle.launch.launch_config import NodeTag
from gazelle.launch.node_commands import Executable
from gazelle.node_specs.spec import NodeRole

__all__ = [
    "HeldStart",
    "holds_time",
    "is_simulator",
    "starts_in_turn",
    "with_simulator_args",
]

Startable = tuple[NodeTag, Executable]
_PAUSED = frozenset({"-u", "--pause"})
_BOND = frozenset({"-b", "-bond", "--bond"})
_MODEL_SPAWNERS = frozenset({NodeRole.MODEL_SPAWNER, NodeRole.ENTITY_SPAWNER})


def is_simulator(executable: Executable) -> bool:
    """Return whether a node is the simulator's server."""
    builtin = executable.builtin
    return builtin is not None and builtin.role is NodeRole.SIMULATOR


def with_simulator_args(spec: NodeTag, argv: Sequence[str]) -> NodeTag:
    """Return a simulator's node with more arguments."""
    return replace(spec, args=" ".join([spec.args, *argv]).strip())


def holds_time(nodes: Sequence[Startable]) -> bool:
    """Return whether time is to be held: something is spawned, and no file asks for a pause."""
    return starts_in_turn(nodes) and not any(
        _PAUSED & set(shlex.split(spec.args)) for spec in _servers(nodes)
    )


def starts_in_turn(nodes: Sequence[Startable]) -> bool:
    """Return whether spawners are to start one after another: models or controllers come."""
    return bool(_servers(nodes)) and any(_spawns(node) or _controls(node) for node in nodes)


class HeldStart:
    """Starts spawners one after another, and then lets time go on.

    Models come first, then controllers, each in the file's order. Started together they would
    race, and a model would appear, or a controller take over, at another time in every run.
    """

    def __init__(
        self,
        nodes: Sequence[Startable],
        *,
        start: Callable[[NodeTag, Executable], object],
        release: Callable[[], None],
    ) -> None:
        self._start = start
        self._release = release
        models = [node for node in nodes if _spawns(node)]
        controllers = [node for node in nodes if _controls(node)]
        self._waiting = deque([*models, *controllers])
        self._current = ""

    @staticmethod
    def others(nodes: Sequence[Startable]) -> list[Startable]:
        """Return the nodes that start at once."""
        return [node for node in nodes if not _spawns(node) and not _controls(node)]

    def begin(self) -> None:
        """Start the first spawner."""
        self._next()

    def ended(self, spec: NodeTag) -> None:
        """Hear that a node has ended."""
        if spec.full_name == self._current:
            self._next()

    def ready(self, spec: NodeTag) -> None:
        """Hear that a spawner of controllers, which stays, has started them."""
        self.ended(spec)

    def _next(self) -> None:
        if not self._waiting:
            self._current = ""
            self._release()
            return
        spec, executable = self._waiting.popleft()
        self._current = spec.full_name
        self._start(spec, executable)


def _servers(nodes: Sequence[Startable]) -> list[NodeTag]:
    return [spec for spec, executable in nodes if is_simulator(executable)]


def _spawns(node: Startable) -> bool:
    """Return whether a node puts a model into the world and ends (``-b`` would stay)."""
    spec, executable = node
    builtin = executable.builtin
    is_spawner = builtin is not None and builtin.role in _MODEL_SPAWNERS
    return is_spawner and not _BOND & set(shlex.split(spec.args))


def _controls(node: Startable) -> bool:
    """Return whether a node starts controllers and can say when it has."""
    spec, executable = node
    builtin = executable.builtin
    is_spawner = builtin is not None and builtin.role is NodeRole.CONTROLLER_SPAWNER
    # A node in a process of its own has no way to say that it is ready.
    return is_spawner and not spec.env and not spec.launch_prefix
