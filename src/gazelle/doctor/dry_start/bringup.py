"""A simulation brought up in this process, through its first quarter of a second."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.doctor.dry_start.plan import DryNode, DryStart, StartPlan
from gazelle.doctor.dry_start.spawners import Spawning, managers_of, start_controllers
from gazelle.doctor.robots_and_worlds import texts_known
from gazelle.documents.files import is_folder
from gazelle.errors import GazelleError, NotFoundError, SimulationDivergedError, UserFileError
from gazelle.geometry import without_splitting
from gazelle.graph.names import resolve
from gazelle.simulator.description_sources import world_from
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.simulator.gzserver_command_line import ServerOptions, read_server_options
from gazelle.simulator.gzserver_process import check_server_plugins, ros2_plugins_of, ros_version_of
from gazelle.simulator.world_server import ServerSettings, WorldServer
from gazelle.workspace import Workspace

__all__ = ["FirstMoments", "dry_start"]

_SECONDS = 0.25
# What lies beside the missing file is nearer than worlds of that name anywhere.
_ASKED = re.compile(r"; did you mean '[^?\n]*\?")
_MAX_STEPS = 500


class FirstMoments:
    """Listens to tf and joint states.

    Plug-ins and controllers publish with a rate of their own, most at 10 Hz or more, and what
    they will publish stands nowhere but in what they do.

    Attributes:
        transforms: parent and child frame → whether it is static.
        joint_states: names of joints by topic.
        diverged: why the time ended early, empty when it did not.
    """

    def __init__(self) -> None:
        self.transforms: dict[tuple[str, str], bool] = {}
        self.joint_states: dict[str, set[str]] = {}
        self.diverged = ""

    def listen(self, server: WorldServer, node: DryNode) -> None:
        """Let a little time pass; the world is of no use for anything else afterwards."""
        own = dict(node.heard)
        for topic in ("/tf", "/tf_static"):
            node.create_subscription(topic, None, self._take_transforms(topic == "/tf_static"))
        for topic, kind in tuple(node.offered.items()):
            if kind.endswith("/JointState"):
                self.joint_states[topic] = set()
                node.create_subscription(topic, None, self._take_joints(topic))
        node.heard = own
        step_s = server.engine.step_ns * 1e-9
        try:
            server.step(min(_MAX_STEPS, math.ceil(_SECONDS / step_s)))
        except SimulationDivergedError as error:
            self.diverged = str(error)

    def _take_transforms(self, is_static: bool) -> Any:
        def take(message: Any) -> None:
            for item in message.transforms:
                edge = (item.header.frame_id.lstrip("/"), item.child_frame_id.lstrip("/"))
                self.transforms.setdefault(edge, is_static)

        return take

    def _take_joints(self, topic: str) -> Any:
        return lambda message: self.joint_states[topic].update(message.name)


def dry_start(
    plan: StartPlan, *, workspace: Workspace, diagnostics: Diagnostics
) -> DryStart | None:
    """Bring up a simulator with its robots, plug-ins and controllers, without any process.

    Everything that a run finds before its first step is found here, by the same code. Then a
    quarter of a second passes, so that transforms and joint states can be heard.

    Args:
        plan: what a launch starts.
        workspace: finds packages, models and worlds.
        diagnostics: receives the findings.

    Returns:
        what came up; None when there is no world, with the reason reported.
    """
    node = DryNode(_node_name(plan.server.name), plan.server.namespace, plan.server.remappings)
    for name, value in plan.parameters.items():
        node.parameters.set(name, value)
    options = read_server_options(plan.server.argv, diagnostics)
    # What shows while time passes is the business of the probes: it is not passed on.
    found = Diagnostics()
    with texts_known(plan.text_files), without_splitting():
        server = _server(plan, options, node, workspace, found)
        if server is None:
            diagnostics.extend(found)
            return None
        try:
            return _brought_up(plan, options, node, server, diagnostics)
        finally:
            server.close()


def _brought_up(
    plan: StartPlan,
    options: ServerOptions,
    node: DryNode,
    server: WorldServer,
    diagnostics: Diagnostics,
) -> DryStart:
    _bring_in(plan, server)
    spawned, unpaused_by = _spawn_all(plan, node, server)
    models = server.engine.world.models
    robots = [model for model in models if model.name in spawned.values()]
    for start in plan.controllers:
        start_controllers(start, server.controls.managers, robots, server.diagnostics)
    diagnostics.extend(server.diagnostics)
    managers = managers_of(server.controls.managers)
    world = server.engine.world
    moments = FirstMoments()
    before = len(server.diagnostics)
    moments.listen(server, node)
    # A plug-in of the user's that raises as soon as time passes does so in every run.
    for item in tuple(server.diagnostics)[before:]:
        if item.code == "plugin.user-error":
            diagnostics.add(item)
    return DryStart(
        world=world,
        node=node,
        paused=options.paused,
        unpaused_by=unpaused_by,
        managers=managers,
        spawned=spawned,
        transforms=moments.transforms,
        joint_states={topic: frozenset(names) for topic, names in moments.joint_states.items()},
        diverged=moments.diverged,
    )


def _server(
    plan: StartPlan,
    options: ServerOptions,
    node: DryNode,
    workspace: Workspace,
    diagnostics: Diagnostics,
) -> WorldServer | None:
    try:
        world = world_from(options.world or "empty", workspace, diagnostics)
        server = WorldServer(
            world,
            node=node,
            workspace=workspace,
            diagnostics=diagnostics,
            settings=ServerSettings(ros_version=ros_version_of(options, plan.started_by)),
        )
    except NotFoundError as error:
        near = _nearest_file(Path(options.world))
        said = _ASKED.sub("", str(error)) if near else str(error)
        text = f"the simulator '{node.full_name}' cannot start: {said}"
        diagnostics.report("doctor.world-missing", text, plan.server.span, fix=near)
        return None
    except UserFileError:
        # Everything it holds is among the findings.
        return None
    except GazelleError as error:
        text = f"the simulator '{node.full_name}' cannot start: {error}"
        diagnostics.report("doctor.start-fails", text, plan.server.span)
        return None
    check_server_plugins(options, diagnostics)

    def report(found: Diagnostics) -> None:
        diagnostics.extend(found)

    ros2 = ros2_plugins_of(options)
    offer_gazebo_ros(server, ros2=ros2, is_gz=options.is_gz, report=report)
    return server


def _bring_in(plan: StartPlan, server: WorldServer) -> None:
    for model in plan.models:
        try:
            server.spawn(model)
        except GazelleError as error:
            text = f"model '{model.name}' cannot be brought into the world: {error}"
            server.diagnostics.report("doctor.spawn-fails", text, model.span)


def _spawn_all(
    plan: StartPlan, node: DryNode, server: WorldServer
) -> tuple[Mapping[str, str], str]:
    spawned, unpaused_by = {}, ""
    for program in plan.spawners:
        name = resolve(program.name, program.namespace)
        spawning = Spawning(program, node, lambda: [one.name for one in server.engine.world.models])
        model = spawning.run(server.diagnostics)
        if model:
            spawned[name] = model
        if spawning.unpauses:
            unpaused_by = name
    return spawned, unpaused_by


def _nearest_file(path: Path) -> str:
    """Return what of the same folder may have been meant, empty when nothing is near."""
    if not is_folder(path.parent):
        return ""
    return did_you_mean(path.name, (item.name for item in path.parent.iterdir()))


def _node_name(name: str) -> str:
    """Gazebo's own node is called gazebo whatever the executable was."""
    return "gazebo" if name in {"gzserver", "debug", "perf"} else name
