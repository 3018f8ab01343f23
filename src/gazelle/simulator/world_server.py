"""The world server: what gzserver with gazebo_ros is elsewhere."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from gazelle.description.model import ContactSpec, Model, PluginTag, World
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import SimulationDivergedError
from gazelle.geometry import Pose, announcing
from gazelle.simulator.command_queue import CommandQueue, error_text, telling
from gazelle.simulator.divergence_recovery import OnDivergence, Recovery
from gazelle.simulator.input_validation import Arrival, Inputs
from gazelle.simulator.intra_process_node import LocalNode
from gazelle.simulator.node_interfaces import NodePort
from gazelle.simulator.plugins.bumper import publish_contact_sensor
from gazelle.simulator.plugins.context import PluginContext, Resources, SensorPlace
from gazelle.simulator.plugins.gz_builtin_systems import is_gz_world
from gazelle.simulator.plugins.gz_sensors import publish_sensor
from gazelle.simulator.plugins.registry import load_plugin
from gazelle.simulator.render_thread import FrameWorker
from gazelle.simulator.scheduler import Scheduler, Task
from gazelle.simulator.sensor_set import SensorSet, check_sensor, sensor_places
from gazelle.simulator.wall_clock import Disturbances, Mode, Pace
from gazelle.simulator.world_controller_managers import ControlRegistry

if TYPE_CHECKING:
    from gazelle.workspace import Workspace

__all__ = ["ServerSettings", "WorldServer"]

# Without a real-time target, commands are looked for after so many steps at the latest.
_FAST_SLICE = 50
_NOWHERE = SourceSpan("<sensor>")


class ServerSettings(NamedTuple):
    """How a world is run.

    Attributes:
        seed: of all noise.
        mode: of `WorldServer.run`; `WorldServer.step` is always as fast as possible, and waits for
            frames in lock-step.
        paused: `WorldServer.run` waits for `WorldServer.unpause` before the first step.
        warm_cameras: load the cameras' kernels before the first picture that somebody wants, and
            say so where they have to be compiled.
        ros_version: of what started the simulator; it decides what plug-ins call their topics. 0
            leaves it to each plug-in's keys.
    """

    seed: int = 0
    mode: Mode = Mode.LOCKSTEP
    paused: bool = False
    warm_cameras: bool = False
    ros_version: int = 0


_USUAL_SETTINGS = ServerSettings()


class WorldServer:
    """Owns an engine and runs tasks, plug-ins and services around its steps.

    One thread owns the world: the one inside `run`, or whoever calls `step`. Commands from
    topics and services are applied between steps only.

    Attributes:
        engine: the physics.
        node: where topics and services live; a `LocalNode` without a graph.
        scheduler: what is due when.
        commands: the way in for other threads.
        inputs: what came last from outside.
        on_divergence: asked what becomes of a running world when a model diverges.
        controls: controller managers and actions, by name.
        sensors: computes readings.
        frames: renders beside the loop, unless in lock-step.
        workspace: finds packages and models for what is spawned.
        diagnostics: everything found about the user's files.
        ros_version: of what started the simulator, 0 when nothing tells.
        mode: how time runs.
        paused: nothing moves; commands are still taken.
    """

    def __init__(
        self,
        world: World,
        *,
        node: NodePort | None = None,
        workspace: Workspace | None = None,
        diagnostics: Diagnostics | None = None,
        settings: ServerSettings = _USUAL_SETTINGS,
        progress: Callable[[str], None] | None = None,
        controls: ControlRegistry | None = None,
    ) -> None:
        """Build the engine and start the plug-ins of every model.

        Args:
            world: what there is at the start.
            node: None for topics and services inside this process only.
            workspace: for models spawned later.
            diagnostics: collects findings; a new list when None.
            settings: how it is run.
            progress: told before work that takes seconds; the node's log when None.
            controls: with parameters of controllers; an empty one when None.
        """
        from gazelle.engine import Engine

        self.diagnostics = Diagnostics() if diagnostics is None else diagnostics
        self.node: NodePort = LocalNode() if node is None else node
        self._progress = progress or (lambda text: self.node.log("INFO", text))
        with announcing(self._progress):
            self.engine = Engine(world, diagnostics=self.diagnostics, seed=settings.seed)
        self.workspace = workspace
        self.seed = settings.seed
        self.ros_version = settings.ros_version
        self.mode = settings.mode
        self.paused = settings.paused
        self.on_divergence: Callable[[], OnDivergence] = lambda: OnDivergence.PAUSE
        self._recovery = Recovery(self)
        self.scheduler = Scheduler(self.engine.step_ns)
        self.commands = CommandQueue(telling(self.node.log))
        self.inputs = Inputs()
        self.controls = ControlRegistry() if controls is None else controls
        self.sensors = SensorSet(self.engine, self.seed)
        self.frames = FrameWorker(self._warm_up) if settings.warm_cameras else FrameWorker()
        self.pace = Pace(self._wanted_factor())
        self._disturbances = Disturbances()
        self._stop = threading.Event()
        self._resources: dict[str, Resources] = {}
        self._world_resources = Resources(self)
        self._load_world_plugins()
        for model in self.engine.world.models:
            self._load_plugins(model, namespace="")

    @property
    def lockstep(self) -> bool:
        """True when every camera frame is finished before time goes on."""
        return self.mode is Mode.LOCKSTEP

    @property
    def time_ns(self) -> int:
        """Simulated time."""
        return self.engine.time_ns

    def step(self, count: int = 1) -> None:
        """Take steps now, in this thread, paused or not; tasks run when they are due.

        Raises:
            SimulationDivergedError: the state became non-finite.
        """
        self.commands.own()
        # Whoever subscribed since the last call gets the very next frame.
        self.scheduler.look()
        try:
            self._advance(count)
        finally:
            self.commands.disown()

    def step_in_command(self, count: int) -> None:
        """Take steps from inside a command, which has the world already; paused or not.

        Raises:
            SimulationDivergedError: the state became non-finite; the world goes on as in `run`.
        """
        try:
            self._advance(count)
        except SimulationDivergedError as error:
            self._recovery.recover(error)
            raise
        self.pace.restart(self.engine.time_ns)

    def run(self, iterations: int = 0) -> None:
        """Run until `stop`: at the wanted real-time factor, or as fast as possible.

        In real time a state that becomes non-finite does not end it; see `Recovery`; nor does
        what a task raises, which is told the first time.

        Args:
            iterations: stop by itself after so many steps; 0 for never.

        Raises:
            SimulationDivergedError: the state became non-finite, and time runs as fast as
                possible: nobody is there to look.
        """
        self.commands.own()
        self.pace.restart(self.engine.time_ns)
        self._tell_disturbances(math.inf)
        try:
            last = self.engine.iteration + iterations if iterations else None
            while not self._stop.is_set() and self.engine.iteration != last:
                self._turn(last)
        finally:
            self.commands.disown()

    def stop(self) -> None:
        """End `run`; may be called from any thread and from signal handlers."""
        self._stop.set()
        self.commands.wake()

    def pause(self) -> None:
        """Stop time."""
        self.paused = True

    def unpause(self) -> None:
        """Let time go on."""
        self.paused = False
        self.commands.wake()

    def reset(self, *, time: bool = True) -> None:
        """Put all models back to where they started; with `time`, start at 0 again."""
        self.frames.wait()
        self.engine.reset(time=time, poses=True)
        if time:
            self.scheduler.restart()
        self.sensors.restart()
        for resources in (self._world_resources, *self._resources.values()):
            resources.reset()
        self.pace.restart(self.engine.time_ns)

    def spawn(
        self,
        model: Model,
        *,
        name: str | None = None,
        T_world_model: Pose | None = None,
        namespace: str = "",
    ) -> Model:
        """Bring a model into the running world and start its plug-ins.

        Args:
            model: what to add.
            name: its name in the world; its own when None.
            T_world_model: where; where the file puts it when None.
            namespace: of plug-ins that name none.

        Returns:
            the model as it is in the world.
        """
        with announcing(self._progress):
            self.engine.spawn(model, name=name, T_world_model=T_world_model)
        placed = self.engine.world.model(name or model.name)
        assert placed is not None
        self._load_plugins(placed, namespace=namespace)
        return placed

    def delete(self, name: str) -> None:
        """Remove a model, its topics and services.

        Raises:
            NotFoundError: there is no such model.
        """
        resources = self._resources.pop(name, None)
        if resources is not None:
            resources.close()
        self.engine.delete(name)

    def calm(self, model: str) -> None:
        """End what is commanded on and on of a model that was brought to rest."""
        for resources in (self._world_resources, *self._resources.values()):
            resources.calm(model)

    def set_step(self, step_s: float) -> None:
        """Change the step; every task keeps its rate."""
        self.engine.set_step_size(round(step_s * 1e9))
        self.scheduler.set_step(self.engine.step_ns)
        self.pace.restart(self.engine.time_ns)

    def set_update_rate(self, steps_per_s: float) -> None:
        """Change the wanted steps per real second; 0 is as fast as possible."""
        if self.mode is Mode.REAL_TIME:
            self.pace.factor = max(0.0, steps_per_s) * self.engine.step_ns * 1e-9
            self.pace.restart(self.engine.time_ns)

    def close(self) -> None:
        """Release topics, services and threads; closing twice does nothing."""
        self.stop()
        self.frames.close()
        for resources in self._resources.values():
            resources.close()
        self._resources.clear()
        self._world_resources.close()

    def sensor_places(self) -> dict[str, SensorPlace]:
        """Return all sensors of the world by their full names."""
        return {
            place.name: place
            for model in self.engine.world.models
            for place in sensor_places(model)
        }

    @property
    def world_resources(self) -> Resources:
        """What the world itself offers, closed with the server."""
        return self._world_resources

    def _turn(self, last: int | None) -> None:
        self.commands.apply()
        if self._stop.is_set():
            # Taking commands forgets a wake-up that came just before.
            return
        if self.paused:
            self.commands.wait(None)
            self.commands.clear_wake()
            self.pace.restart(self.engine.time_ns)
            self._tell_disturbances(math.inf)
            return
        lead = self.pace.lead_s(self.engine.time_ns)
        if lead > 0:
            self.commands.wait(lead)
            self.commands.clear_wake()
            self._tell_disturbances(lead)
            return
        factor = self.pace.factor
        count = self.pace.slice_steps(self.engine.step_ns) if factor > 0 else _FAST_SLICE
        if last is not None:
            count = min(count, last - self.engine.iteration)
        try:
            self._advance(count, pausing=True)
        except SimulationDivergedError as error:
            if self.mode is not Mode.REAL_TIME:
                raise
            self._recovery.recover(error)
            self.pace.restart(self.engine.time_ns)
        self._tell_disturbances(0.0)

    def _tell_failure(self, task: Task, error: Exception) -> None:
        """Say what a task raised, once: it may do so at every step."""
        if not task.has_failed:
            task.has_failed = True
            text = f"'{task.name}' failed at {self.time_ns * 1e-9:.3f} s; the world goes on"
            self.node.log("ERROR", f"{text}\n{error_text(error)}")

    def _tell_disturbances(self, idle_s: float) -> None:
        for text in self._disturbances.look(self.time_ns * 1e-9, idle_s):
            self.node.log("WARN", text)

    def senders(self, arrival: Arrival) -> tuple[str, ...]:
        """Return the nodes that called a service or publish a topic, as far as they are known."""
        if arrival.caller:
            return (arrival.caller,)
        return self.node.publisher_names(arrival.name)

    def _warm_up(self) -> None:
        from gazelle.sensors import warm_up

        warm_up(lambda text: self.node.log("INFO", text))

    def _advance(self, count: int, *, pausing: bool = False) -> None:
        engine, scheduler = self.engine, self.scheduler
        is_lasting = pausing and self.mode is Mode.REAL_TIME
        failed = self._tell_failure if is_lasting else None
        remaining = count
        while remaining > 0:
            self.commands.apply()
            if pausing and self.paused:
                return
            steps = max(1, min(remaining, scheduler.next_due() - engine.iteration))
            engine.step(steps)
            remaining -= steps
            scheduler.run_due(engine.iteration, failed)

    def _wanted_factor(self) -> float:
        if self.mode is not Mode.REAL_TIME:
            return 0.0
        # Gazebo's target is rate × step; real_time_factor is what it should come to.
        rate_hz = self.engine.world.physics.real_time_update_rate_hz
        return max(0.0, rate_hz) * self.engine.step_ns * 1e-9

    def _load_world_plugins(self) -> None:
        world = self.engine.world
        stand_in = Model(name=world.name, static=True)
        for plugin in world.plugins:
            load_plugin(PluginContext(self, stand_in, plugin, self._world_resources))

    def _load_plugins(self, model: Model, *, namespace: str) -> None:
        resources = self._resources.setdefault(model.name, Resources(self))

        def load(plugin: PluginTag, place: SensorPlace | None) -> None:
            load_plugin(PluginContext(self, model, plugin, resources, place, namespace))

        for place in sensor_places(model):
            readable = check_sensor(place, model, self.engine.world, self.diagnostics)
            for plugin in place.sensor.plugins:
                load(plugin, place)
            is_gz = is_gz_world(self.engine.world)
            stand_in = PluginTag(place.sensor.name, "", Tag("plugin", _NOWHERE))
            own = PluginContext(self, model, stand_in, resources, place)
            if readable and not place.sensor.plugins and is_gz:
                publish_sensor(own)
            elif readable and isinstance(place.sensor.spec, ContactSpec) and not is_gz:
                publish_contact_sensor(own)
        for plugin in model.plugins:
            load(plugin, None)
