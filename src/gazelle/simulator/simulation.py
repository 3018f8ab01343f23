"""The plain Python way in: a world, models in it, steps."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING, Any, Self, cast

from gazelle.description.model import Model, World
from gazelle.diagnostics import Diagnostics
from gazelle.diagnostics.suggestions import nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.rich_display import shown_by
from gazelle.simulator.description_sources import Source, loaded_from, models_from, world_from
from gazelle.simulator.intra_process_node import LocalNode
from gazelle.simulator.node_interfaces import NodePort, SubscriptionPort
from gazelle.simulator.run_history import RunHistory
from gazelle.simulator.simulation_handles import (
    SimJoint,
    SimLink,
    SimModel,
    SimSensor,
)
from gazelle.simulator.simulation_parameters import Parameters, give_parameters
from gazelle.simulator.world_controller_managers import ControlRegistry
from gazelle.simulator.world_server import ServerSettings, WorldServer
from gazelle.workspace import Workspace

if TYPE_CHECKING:
    from gazelle.graph.actions import LocalGoal
    from gazelle.simulator.notebook_ports import LiveWorldPort, PlotPort, ViewPort
    from gazelle.simulator.simulation_handles import SimControllers

__all__ = ["Simulation", "full_name"]


@shown_by("robots:simulation_bundle")
class Simulation:
    """A world with its robots, stepped from Python.

    Needs no graph, no display and no ROS: topics work within the process, sensors are read
    directly, plug-ins run as in Gazebo. Time is simulated and goes on in `step` and `run` only.

    Example:
        >>> sim = Simulation.load("robot.urdf", world="empty")
        >>> sim.joint("roll_joint").command(0.1)
        >>> sim.run(seconds=2.0)
    """

    def __init__(
        self,
        world: World | None = None,
        *,
        workspace: Workspace | None = None,
        diagnostics: Diagnostics | None = None,
        node: NodePort | None = None,
        seed: int = 0,
        parameters: Parameters | None = None,
    ) -> None:
        """Start with a world; `load` is the usual way in.

        Args:
            world: an empty one without ground when None.
            workspace: finds packages and models; made from the environment when None.
            diagnostics: collects findings; a new list when None.
            node: a node of a graph; topics stay inside this process when None.
            seed: of all noise.
            parameters: see `load`.
        """
        node = LocalNode() if node is None else node
        controls = ControlRegistry()
        if parameters is not None:
            give_parameters(parameters, node.parameters, controls)
        self.diagnostics = Diagnostics() if diagnostics is None else diagnostics
        self._workspace = workspace or Workspace.discover()
        self.server = WorldServer(
            world or World(),
            node=node,
            workspace=self._workspace,
            diagnostics=self.diagnostics,
            settings=ServerSettings(seed),
            controls=controls,
            progress=_say_to_person,
        )
        self._history = RunHistory(self.server)
        self._live: LiveWorldPort | None = None
        self._views: list[ViewPort] = []
        self._pace: float | None = None

    @classmethod
    def load(  # noqa: PLR0913 - users give all by keyword
        cls,
        source: Source | None = None,
        *,
        world: str | os.PathLike[str] | World | None = "empty",
        name: str | None = None,
        pose: Pose | None = None,
        mappings: Mapping[str, str] | None = None,
        workspace: Workspace | None = None,
        node: NodePort | None = None,
        seed: int = 0,
        parameters: Parameters | None = None,
    ) -> Self:
        """Load a world and put a robot into it.

        Args:
            source: a URDF, xacro or SDF file, its text, a model folder or the name of a known
                model; a world file stands for itself; None for the world alone.
            world: a world file, the name of a known world (``empty`` has ground and sun), a
                `World`, or None for nothing at all.
            name: of the robot in the world; its own when None.
            pose: where it stands; where the file puts it when None.
            mappings: xacro arguments.
            workspace: finds packages and models; made from the environment when None.
            node: a node of a graph, when topics shall leave this process.
            seed: of all noise.
            parameters: of controllers and plug-ins: a mapping, a YAML file or several. What has
                a ``ros__parameters`` level is ROS 2's, the rest is set in the ROS 1 store.

        Raises:
            GazelleError: a parameter file cannot be read.
            UserFileError: a file has errors, all of them at once.
            NotFoundError: there is no such file, model or world.
        """
        workspace = workspace or Workspace.discover()
        diagnostics = Diagnostics()
        loaded = loaded_from(source, workspace, diagnostics, mappings=mappings)
        if loaded.world is not None:
            chosen = loaded.world
        elif isinstance(world, World):
            chosen = world
        else:
            chosen = world_from(world, workspace, diagnostics)
        diagnostics.raise_if_errors()
        placed = tuple(_placed(model, name, pose) for model in loaded.models)
        chosen = replace(chosen, models=(*chosen.models, *placed))
        return cls(
            chosen,
            workspace=workspace,
            diagnostics=diagnostics,
            node=node,
            seed=seed,
            parameters=parameters,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.close()

    def close(self) -> None:
        """End views; release topics, services and threads."""
        for view in self._views:
            view.close()
        self._views.clear()
        if self._live is not None:
            self._live.close()
            self._live = None
        self._history.close()
        self.server.close()

    @property
    def world(self) -> World:
        """The world as it is now."""
        return self.server.engine.world

    @property
    def time_s(self) -> float:
        """Simulated time."""
        return self.server.engine.time_ns * 1e-9

    @property
    def time_ns(self) -> int:
        """Simulated time, exact."""
        return self.server.engine.time_ns

    @property
    def step_s(self) -> float:
        """Length of a step."""
        return self.server.engine.step_ns * 1e-9

    def run(self, *, seconds: float) -> None:
        """Let this much simulated time pass, rounded up to whole steps.

        It takes as little real time as it can; see `view` for when somebody looks.

        Raises:
            ValueError: a negative or infinite time.
            SimulationDivergedError: the state became non-finite.
        """
        if not 0 <= seconds < math.inf:
            raise ValueError(f"run() needs a time of 0 s or more, not {seconds}")
        count = math.ceil(round(seconds * 1e9) / self.server.engine.step_ns)
        if self._live is None:
            self.step(count)
        else:
            self._live.run(count, self._pace)

    def step(self, count: int = 1) -> None:
        """Take steps; everything due on the way (plug-ins, sensors with subscribers) happens."""
        self.server.step(count)

    def view(
        self,
        *,
        height_px: int = 480,
        real_time_factor: float | None = 1.0,
        origin: str | None = None,
    ) -> ViewPort:
        """Show the world live: in the cell of a notebook, elsewhere at the `url` that is returned.

        The page is there until `close` of what is returned or of the simulation; cells go on and
        step the simulation meanwhile. Where the page cannot be reached, and in a notebook that is
        saved, the cell shows a picture, and a replay of the run once something has moved.

        Args:
            height_px: of the page in the cell.
            real_time_factor: `run` is not faster than so many times real time while a page looks;
                None lets it be as fast as it can. `step` always is.
            origin: of the notebook's page, such as ``http://localhost:8888``; the first page on
                this machine that shows the view when None. No other page can.

        Raises:
            GazelleError: no port is free for the page's server.
        """
        # Studio is a layer above.
        show = import_module("gazelle.notebook.live_view").show
        self._pace = real_time_factor
        view, self._live = show(self, self._live, height_px=height_px, origin=origin)
        self._views.append(view)
        return cast("ViewPort", view)

    def plot(self, *names: str) -> PlotPort:
        """Plot joints, links, sensors and topics over the run; a notebook shows it as a chart.

        Joints and links are recorded from the start. Efforts, sensors and topics are from the
        first plot of them on: plot, run, and look at the plot again.

        Args:
            names: ``JOINT/position``, ``/velocity`` or ``/effort``; ``LINK/x``, ``y``, ``z``,
                ``roll``, ``pitch`` or ``yaw`` in the world, or a model's; a number of a sensor's
                record, ``imu/linear_acceleration_m_s2[0]``; or of a topic's messages,
                ``/odom/twist/twist/linear/x``.

        Raises:
            NotFoundError: there is no such thing; the message names the nearest.
            GazelleError: nothing was named, or it is no number.

        Example:
            >>> sim.run(seconds=5)
            >>> sim.plot("joint_1/position", "joint_1/velocity").save("joint_1.png")
        """
        # Charts are a layer above.
        made = import_module("gazelle.notebook.plots").plot(self, self._history, names)
        return cast("PlotPort", made)

    def pause(self) -> None:
        """Stop time for a server that runs on its own (`WorldServer.run`)."""
        self.server.pause()

    def unpause(self) -> None:
        """Let time go on again."""
        self.server.unpause()

    def reset(self) -> None:
        """Go back to the start: time 0, all models where they began, noise from its seed."""
        self.server.reset()

    def state_hash(self) -> str:
        """Return a hash of the whole physical state: equal for equal runs."""
        return self.server.engine.state_hash()

    def spawn(
        self,
        source: Source,
        *,
        name: str | None = None,
        pose: Pose | None = None,
        mappings: Mapping[str, str] | None = None,
    ) -> SimModel:
        """Bring a model into the running world; see `load` for the arguments.

        Raises:
            UserFileError: the file has errors.
            NotFoundError: there is no such file or model.
            EngineError: the name is taken.
        """
        found = Diagnostics()
        models = models_from(source, self._workspace, found, mappings=mappings)
        self.diagnostics.extend(found)
        found.raise_if_errors()
        if not models:
            raise NotFoundError("model", str(source), hint="the file holds no model")
        placed = [self.server.spawn(_placed(model, name, pose)) for model in models]
        return SimModel(self.server, placed[0].name)

    def delete(self, name: str) -> None:
        """Remove a model.

        Raises:
            NotFoundError: there is no such model.
        """
        self.server.delete(self.model(name).name)

    def joint(self, name: str) -> SimJoint:
        """Return a joint by ``joint`` (if only one model has it) or ``model::joint``.

        Raises:
            NotFoundError: there is none; the message names the nearest.
        """
        engine = self.server.engine
        return SimJoint(engine.joint(full_name("joint", name, engine.joint_names)))

    def link(self, name: str) -> SimLink:
        """Return a link by ``link`` (if only one model has it) or ``model::link``.

        Raises:
            NotFoundError: there is none; the message names the nearest.
        """
        engine = self.server.engine
        return SimLink(engine.link(full_name("link", name, engine.link_names)))

    def sensor(self, name: str) -> SimSensor:
        """Return a sensor by ``sensor``, ``link::sensor`` or ``model::link::sensor``.

        Raises:
            NotFoundError: there is none; the message names the nearest.
        """
        places = self.server.sensor_places()
        return SimSensor(self.server, places[full_name("sensor", name, places)])

    def model(self, name: str) -> SimModel:
        """Return a model.

        Raises:
            NotFoundError: there is none; the message names the nearest.
        """
        names = [model.name for model in self.world.models]
        if name not in names:
            raise NotFoundError("model", name, nearest=nearest_names(name, names))
        return SimModel(self.server, name)

    def controller_manager(self, namespace: str = "") -> SimControllers:
        """Return a robot's controllers.

        Args:
            namespace: of the controller manager; not needed while there is only one.

        Raises:
            NotFoundError: no robot has one, or several have.
        """
        from gazelle.simulator.simulation_handles import SimControllers

        return SimControllers(self.server, self.server.controls.manager(namespace))

    def send_goal(
        self, action: str, goal: Any, *, on_feedback: Callable[[Any], None] | None = None
    ) -> LocalGoal:
        """Send a goal to an action of this simulation, such as ``/arm/follow_joint_trajectory``.

        Args:
            action: global name.
            goal: the goal message, or a mapping of its fields.
            on_feedback: called within `step` with each feedback message.

        Returns:
            a handle with ``status``, ``result``, ``feedback`` and ``cancel()``.

        Raises:
            NotFoundError: nobody offers the action here; the message names the nearest.
            InterfaceError: a field of the goal is wrong.
        """
        return self.server.controls.action(action).submit(goal, on_feedback=on_feedback)

    def publish(self, topic: str, message: Any) -> None:
        """Publish one message, for example a command, to whoever listens.

        Messages of other simulations and processes are reached when `node` is a graph's.
        """
        node = self.server.node
        if isinstance(node, LocalNode):
            node.publish(topic, message)
            return
        publisher = node.create_publisher(topic, type(message))
        publisher.publish(message)
        publisher.unregister()

    def subscribe(self, topic: str, callback: Callable[[Any], None]) -> SubscriptionPort:
        """Receive a topic: `callback` is called within `step`, when a message is published."""
        return self.server.node.create_subscription(topic, None, callback, inline=True)


def full_name(kind: str, name: str, existing: Iterable[str]) -> str:
    """Return the one full name (``model::part``) that `name` means.

    A name without its model is enough while it is unique.

    Raises:
        NotFoundError: there is none, or several models have it; the message lists the nearest
            names or all that fit.
    """
    names = tuple(existing)
    if name in names:
        return name
    fitting = [item for item in names if item.endswith(f"::{name}")]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        hint = "several have this name: " + ", ".join(f"'{item}'" for item in fitting)
        raise NotFoundError(kind, name, hint=hint)
    by_last = {item.split("::", 1)[-1]: item for item in names}
    nearest = nearest_names(name, [*by_last, *names])
    hint = "" if nearest else "there are: " + ", ".join(f"'{item}'" for item in names[:12])
    raise NotFoundError(kind, name, nearest=nearest, hint=hint)


def _placed(model: Model, name: str | None, pose: Pose | None) -> Model:
    return replace(
        model,
        name=name or model.name,
        T_world_model=model.T_world_model if pose is None else pose,
    )


def _say_to_person(text: str) -> None:
    """Tell of long work on a terminal; programs that read standard error are left in peace."""
    if sys.stderr.isatty():
        sys.stderr.write(f"{text}\n")
