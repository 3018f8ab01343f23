"""``spawn_model`` and ``spawn_entity.py`` run against a world in this process."""

from __future__ import annotations

import threading
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.doctor.dry_start.plan import Program
from gazelle.errors import GazelleError
from gazelle.graph.gazebo_names import world_names
from gazelle.graph.names import is_hidden, remap, resolve
from gazelle.simulator.local_node import LocalNode
from gazelle.simulator.spawn_model import spawn_model

__all__ = ["Spawning"]

_BOND_WORDS = frozenset({"-b", "-bond", "--bond"})


class Spawning:
    """One spawner: its own code runs, over a node that answers at once.

    Attributes:
        unpauses: it has asked for time to go on.
    """

    def __init__(
        self, program: Program, world_node: LocalNode, models: Callable[[], list[str]]
    ) -> None:
        """Prepare a spawner.

        Args:
            program: its node and arguments.
            world_node: the simulator's node, whose services are called.
            models: gives the names of the models in the world.
        """
        self.unpauses = False
        self._program = program
        self._world_node = world_node
        self._models = models
        self._node = _SpawnerNode(program, self)
        self._stop = threading.Event()

    def run(self, diagnostics: Diagnostics) -> str:
        """Spawn; report what goes wrong and return the name of the model that came, if one did."""
        before, errors = self._models(), len(diagnostics.errors)
        words = [word for word in self._program.words if word not in _BOND_WORDS]
        code = spawn_model(words, self._node, self._stop)
        new = [name for name in self._models() if name not in before]
        if code:
            self._report(diagnostics, is_explained=len(diagnostics.errors) > errors)
        elif not new and self._node.waits_for:
            text = f"'{self._node.full_name}' waits for {self._node.waits_for}"
            diagnostics.report("doctor.spawn-waits", text, self._program.span)
        return new[0] if new else ""

    def call(self, name: str, request: Any) -> Any:
        """Call a service of the simulator."""
        if name.endswith("/unpause_physics"):
            # Time shall not go on: what follows is to see the world before its first step.
            self.unpauses = True
            return None
        return self._world_node.call(self._offered(name), request)

    def offers(self, name: str) -> bool:
        """Tell whether the simulator has a service; who waits for another one is stopped."""
        if self._offered(name) in self._world_node.services:
            return True
        near = did_you_mean(name, (one for one in self._world_node.services if not is_hidden(one)))
        self.give_up(f"service {name}, which nobody offers" + (f"; {near}" if near else ""))
        return False

    def _offered(self, name: str) -> str:
        names = world_names(name)
        return next((one for one in names if one in self._world_node.services), name)

    def give_up(self, reason: str) -> None:
        """End a wait that nothing here can end."""
        self._node.waits_for = reason
        self._stop.set()

    def model_states(self, callback: Callable[[Any], None]) -> None:
        """Tell which models there are, for ``-wait``."""
        names, words = self._models(), self._program.words
        callback(SimpleNamespace(name=names))
        wanted = words[words.index("-wait") + 1]
        if wanted not in names:
            listed = ", ".join(names) or "none"
            text = f"model '{wanted}', which no spawner before it brings; there are: {listed}"
            self.give_up(text)

    def _report(self, diagnostics: Diagnostics, *, is_explained: bool) -> None:
        said = [text for level, text in self._node.said if level in {"error", "fatal"}]
        status = [text for _, text in self._node.said if text.startswith("Spawn status: ")]
        reason = status[-1].removeprefix("Spawn status: ") if status else "; ".join(said)
        if is_explained:
            reason = "SpawnModel: Failure - its description has errors, which are listed too"
        text = f"'{self._node.full_name}' cannot bring its model into the world: {reason}"
        diagnostics.report("doctor.spawn-fails", text, self._program.span)


class _SpawnerNode:
    """What `spawn_model` needs of a node."""

    def __init__(self, program: Program, spawning: Spawning) -> None:
        self._spawning = spawning
        self.namespace = program.namespace
        self.full_name = resolve(program.name, program.namespace)
        self._rules = remap(program.remappings, program.namespace, node=self.full_name)
        self.said: list[tuple[str, str]] = []
        self.waits_for = ""

    @property
    def parameters(self) -> _SpawnerNode:
        return self

    def get(self, name: str, default: Any = "") -> Any:
        return self._spawning._world_node.parameters.get(self.resolve_name(name), default)

    def resolve_name(self, name: str) -> str:
        return resolve(name, self.namespace, node=self.full_name, remappings=self._rules)

    def log(self, level: str, text: str, *, padded: bool = True) -> None:
        self.said.append((level, text))

    def create_client(self, name: str, _kind: Any) -> _Client:
        return _Client(self._spawning, self.resolve_name(name))

    def create_subscription(
        self, topic: str, _kind: Any, callback: Callable[[Any], None]
    ) -> SimpleNamespace:
        if topic.endswith("/model_states"):
            self._spawning.model_states(callback)
        else:
            self._spawning.give_up(f"a description on topic {self.resolve_name(topic)}")
        return SimpleNamespace(unregister=lambda: None)


class _Client:
    def __init__(self, spawning: Spawning, name: str) -> None:
        self._spawning = spawning
        self._name = name

    def wait_for_service(self, _timeout_s: float) -> bool:
        return self._spawning.offers(self._name)

    def call(self, request: Any) -> Any:
        try:
            return self._spawning.call(self._name, request)
        except KeyError as error:
            raise GazelleError(str(error)) from error
