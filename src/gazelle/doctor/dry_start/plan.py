"""What is started without a process, the node it runs over, and what became of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.description.model import Model, World
from gazelle.diagnostics import SourceSpan
from gazelle.graph.names import remap, resolve
from gazelle.simulator.intra_process_node import (
    LocalNode,
    LocalPublisher,
    LocalService,
    LocalSubscription,
)

__all__ = ["ControllerStart", "DryNode", "DryStart", "Manager", "Program", "StartPlan"]


class DryNode(LocalNode):
    """A `LocalNode` with a name and remappings, as a launched simulator has them.

    Attributes:
        name: without namespace.
        namespace: absolute.
        offered: types of the topics published, by global name.
        heard: types of the topics listened to, by global name; empty for any type.
        remapped: names before remapping that a remapping was of use for.
        asked: all names before remapping.
        said: levels and texts of the log.
    """

    def __init__(
        self,
        name: str = "gazebo",
        namespace: str = "/",
        remappings: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__()
        self.name = name
        self.namespace = namespace.rstrip("/") or "/"
        self.full_name = resolve(name, self.namespace)
        self._rules = remap(remappings or {}, self.namespace, node=self.full_name)
        self.offered: dict[str, str] = {}
        self.heard: dict[str, str] = {}
        self.remapped: set[str] = set()
        self.asked: set[str] = set()
        self.said: list[tuple[str, str]] = []

    def resolve_name(self, name: str) -> str:
        """Return the global name after remapping."""
        plain = resolve(name, self.namespace, node=self.full_name)
        self.asked.add(plain)
        if plain in self._rules:
            self.remapped.add(plain)
        return self._rules.get(plain, plain)

    def create_publisher(self, topic: str, message_type: Any, **options: Any) -> LocalPublisher:
        """Offer a topic under its remapped name."""
        name = self.resolve_name(topic)
        self.offered[name] = str(getattr(message_type, "TYPE_NAME", ""))
        return super().create_publisher(name, message_type, **options)

    def create_subscription(
        self, topic: str, message_type: Any, callback: Callable[[Any], None], **options: Any
    ) -> LocalSubscription:
        """Receive a topic under its remapped name."""
        name = self.resolve_name(topic)
        announced = str(options.get("announced") or getattr(message_type, "TYPE_NAME", ""))
        self.heard.setdefault(name, announced)
        return super().create_subscription(name, message_type, callback, **options)

    def create_service(
        self, name: str, service_type: Any, handler: Callable[..., Any], **options: Any
    ) -> LocalService:
        """Offer a service under its remapped name."""
        return super().create_service(self.resolve_name(name), service_type, handler, **options)

    def log(self, level: Any, text: str) -> None:
        """Remember what is said."""
        self.said.append((str(level).lower(), text))


@dataclass(frozen=True, slots=True)
class Program:
    """A program that a launch starts, as its node is called.

    Attributes:
        name: of the node, without namespace.
        namespace: absolute.
        argv: its own arguments.
        remappings: from → to, as written.
        span: place of the ``<node>`` tag.
    """

    name: str
    namespace: str = "/"
    argv: tuple[str, ...] = ()
    remappings: Mapping[str, str] = field(default_factory=dict)
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class ControllerStart:
    """Controllers that a spawner loads.

    Attributes:
        manager: global name of the controller manager, such as ``/mira/controller_manager``.
        names: of the controllers.
        by: the spawner.
        type: a type that the spawner itself gives, empty for the parameters'.
        files: parameter files that the spawner passes on (ROS 2).
        starts: they are started too, not only loaded.
    """

    manager: str
    names: tuple[str, ...]
    by: Program
    type: str = ""
    files: tuple[str, ...] = ()
    starts: bool = True


@dataclass(frozen=True, slots=True)
class StartPlan:
    """Everything that becomes one simulated world.

    Attributes:
        server: the simulator.
        parameters: values of the ROS 1 parameter store by global name.
        text_files: files whose text is in parameters.
        spawners: ``spawn_model`` and ``spawn_entity.py``, in order.
        controllers: in order.
        models: brought into the world before anything is spawned.
        started_by: version of ROS of the launch, 0 for none.
    """

    server: Program
    parameters: Mapping[str, Any] = field(default_factory=dict)
    text_files: tuple[str, ...] = ()
    spawners: tuple[Program, ...] = ()
    controllers: tuple[ControllerStart, ...] = ()
    models: tuple[Model, ...] = ()
    started_by: int = 0


@dataclass(frozen=True, slots=True)
class Manager:
    """A controller manager that runs.

    Attributes:
        namespace: absolute.
        ros_version: 1 or 2.
        rows: per controller: name, type, state, joints.
    """

    namespace: str
    ros_version: int
    rows: tuple[tuple[str, str, str, tuple[str, ...]], ...] = ()


@dataclass(frozen=True, slots=True)
class DryStart:
    """A world as it is before its first step, and what it says in its first moments.

    Attributes:
        world: with every model that came into it.
        node: the simulator's node: topics, services, remaps that were of use.
        paused: it waits for someone to unpause it.
        unpaused_by: the spawner that unpauses it, empty for none.
        managers: controller managers.
        spawned: models in the world by the full name of the spawner.
        transforms: edges of tf, parent and child, and whether they are static.
        joint_states: names of joints by topic of JointState messages.
        diverged: why the first moments ended early, empty when they did not.
    """

    world: World
    node: DryNode
    paused: bool = False
    unpaused_by: str = ""
    managers: tuple[Manager, ...] = ()
    spawned: Mapping[str, str] = field(default_factory=dict)
    transforms: Mapping[tuple[str, str], bool] = field(default_factory=dict)
    joint_states: Mapping[str, frozenset[str]] = field(default_factory=dict)
    diverged: str = ""
