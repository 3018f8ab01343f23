"""What is started, and what became of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.description.model import Model, World
from gazelle.diagnostics import SourceSpan
from gazelle.doctor.dry_start.node import DryNode

__all__ = ["ControllerStart", "DryStart", "Manager", "Program", "StartPlan"]


@dataclass(frozen=True, slots=True)
class Program:
    """A program that a launch starts, as its node is called.

    Attributes:
        name: of the node, without namespace.
        namespace: absolute.
        words: its own arguments.
        remappings: from → to, as written.
        span: place of the ``<node>`` tag.
    """

    name: str
    namespace: str = "/"
    words: tuple[str, ...] = ()
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
