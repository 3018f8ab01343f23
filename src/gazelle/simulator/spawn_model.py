"""``spawn_model`` (ROS 1) and ``spawn_entity.py`` (ROS 2): put a model into a running world."""

from __future__ import annotations

import threading
from argparse import ArgumentError, ArgumentParser, Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn
from xml.etree import ElementTree

from gazelle.documents.files import exists, is_file
from gazelle.errors import GazelleError
from gazelle.geometry import Pose
from gazelle.graph.gazebo_names import SHOWN_SPACE, first_there, is_loading, world_names
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import pose_message
from gazelle.simulator.plugins.context import join_names

__all__ = ["SpawnUsageError", "is_ros2", "read_spawn_arguments", "spawn_model"]


_TIMEOUT_S = 30.0


_DATABASE = """\
<sdf version="1.4"><world name="default"><include><uri>model://{name}</uri></include></world></sdf>
"""


_POLL_S = 0.1


def spawn_model(
    argv: list[str], node: Any, stop: threading.Event, *, ros2: bool | None = None
) -> int:
    """Do what ``rosrun gazebo_ros spawn_model`` does, with its arguments and messages.

    Args:
        argv: the arguments.
        node: a started node of the graph.
        stop: ends waiting early.
        ros2: it is ``spawn_entity.py`` of ROS 2; when None, ``-entity`` tells.

    Returns:
        the exit code: 0, 1 when spawning failed, 2 for wrong arguments.
    """
    ros2 = is_ros2(argv) if ros2 is None else ros2
    try:
        arguments = read_spawn_arguments(argv, default_namespace=node.namespace, ros2=ros2)
    except (SpawnUsageError, ArgumentError) as error:
        node.log("fatal", str(error), padded=False)
        return 2
    try:
        _Spawner(arguments, node, stop, ros2=ros2).run()
    except _SpawnError as error:
        node.log("error", str(error), padded=False)
        return 1
    except GazelleError as error:
        node.log("error", f"Service call failed: {error}", padded=False)
        return 1
    return 0


def is_ros2(argv: Sequence[str]) -> bool:
    """Tell whether these are the arguments of ``spawn_entity.py``."""
    return "-entity" in argv


def read_spawn_arguments(
    argv: Sequence[str], *, default_namespace: str = "/", ros2: bool | None = None
) -> Namespace:
    """Read the arguments of either program.

    Args:
        argv: the arguments.
        default_namespace: of ROS 1's robots.
        ros2: whether it is ROS 2's program; found out of the arguments when None.

    Raises:
        SpawnUsageError: they are wrong or incomplete.
    """
    ros2 = is_ros2(argv) if ros2 is None else ros2
    parser = _Parser(prog="spawn_entity.py" if ros2 else "spawn_model", add_help=False)
    if ros2:
        parser.add_argument("-entity", dest="model", required=True, metavar="ENTITY_NAME")
        # The older name of -timeout.
        parser.add_argument(
            "-spawn_service_timeout", dest="timeout", type=float, default=_TIMEOUT_S
        )
    else:
        parser.add_argument("-model", dest="model", required=True, metavar="MODEL_NAME")
        kind = parser.add_mutually_exclusive_group(required=True)
        kind.add_argument("-urdf", action="store_true")
        kind.add_argument("-sdf", action="store_true")
        # Gazebo 1's word for SDF.
        kind.add_argument("-gazebo", dest="sdf", action="store_true")
    _add_source(parser)
    _add_pose(parser)
    parser.add_argument("-reference_frame", default="")
    parser.add_argument("-gazebo_namespace", default="" if ros2 else "/gazebo")
    parser.add_argument("-robot_namespace", default="" if ros2 else default_namespace)
    parser.add_argument("-timeout", type=float, default=_TIMEOUT_S)
    parser.add_argument("-unpause", action="store_true")
    parser.add_argument("-wait", default="", metavar="MODEL_NAME")
    parser.add_argument(
        "-J", dest="joints", action="append", nargs=2, default=[], metavar=("JOINT", "POSITION")
    )
    parser.add_argument("-package_to_model", action="store_true")
    parser.add_argument("-b", dest="bond", action="store_true")
    found = parser.parse_args(list(argv))
    for name, position in found.joints:
        _check_number(parser, f"-J {name}", position)
    return found


class SpawnUsageError(GazelleError):
    """The arguments are wrong; the message is the usage and what is wrong."""


class _Parser(ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise SpawnUsageError(f"{self.format_usage()}{self.prog}: error: {message}")


def _add_source(parser: ArgumentParser) -> None:
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("-file", default="", metavar="FILE_NAME")
    source.add_argument("-param", default="", metavar="PARAM_NAME")
    source.add_argument("-topic", default="", metavar="TOPIC_NAME")
    source.add_argument("-database", default="", metavar="MODEL_NAME")
    source.add_argument("-stdin", action="store_true")


def _add_pose(parser: ArgumentParser) -> None:
    for name in ("-x", "-y", "-z", "-R", "-P", "-Y"):
        parser.add_argument(name, type=float, default=0.0)


def _check_number(parser: ArgumentParser, name: str, text: str) -> None:
    try:
        float(text)
    except ValueError:
        parser.error(f"{name} needs a number, not '{text}'")


class _SpawnError(GazelleError):
    """Spawning cannot go on; the text is what the user is told."""


class _Spawner:
    """One run."""

    def __init__(
        self, arguments: Namespace, node: Any, stop: threading.Event, *, ros2: bool
    ) -> None:
        self._arguments = arguments
        self._node = node
        self._stop = stop
        self._ros2 = ros2
        self._namespace = join_names("/", arguments.gazebo_namespace)

    def run(self) -> None:
        arguments = self._arguments
        if self._ros2:
            self._say("Spawn Entity started")
        if arguments.wait:
            self._wait_for_model(arguments.wait)
        text = self._as_models(self._load())
        if self._stop.is_set():
            return
        self._spawn(text)
        if arguments.joints:
            self._set_joints()
        if arguments.unpause:
            self._say("Unpausing physics")
            request = service_type("std_srvs/Empty").Request()
            self._call("unpause_physics", "std_srvs/Empty", request)
        if arguments.bond:
            self._say(f"Waiting for shutdown to delete model {arguments.model}")
            self._stop.wait()
            self._delete()

    def _wait_for_model(self, name: str) -> None:
        self._say(f"Waiting for model {name} before proceeding.")
        there = threading.Event()

        def look(states: Any) -> None:
            if name in states.name:
                there.set()

        # ROS 2's own topic needs a plug-in in the world; this waits without it, too.
        space = SHOWN_SPACE if self._ros2 else self._namespace
        states = message_type("gazebo_msgs/ModelStates")
        listening = [
            self._node.create_subscription(topic, states, look)
            for topic in world_names(join_names(space, "model_states"))
        ]
        while not self._stop.is_set() and not there.wait(_POLL_S):
            continue
        for subscription in listening:
            subscription.unregister()

    def _load(self) -> str:
        arguments = self._arguments
        if arguments.file:
            return self._from_file(arguments.file)
        if arguments.param:
            return self._from_parameter(arguments.param)
        if arguments.topic:
            return self._from_topic(arguments.topic)
        if arguments.database:
            self._say("Loading model XML from Gazebo Model Database")
            return _DATABASE.format(name=arguments.database)
        import sys

        self._say("Loading model XML from stdin")
        text = sys.stdin.read()
        if not text:
            raise _SpawnError("Error: stdin buffer was empty")
        return text

    def _from_file(self, name: str) -> str:
        self._say(f"Loading model XML from file {name}")
        path = Path(name)
        if not exists(path):
            raise _SpawnError(f"Error: specified file {name} does not exist")
        if not is_file(path):
            raise _SpawnError(f"Error: specified file {name} is not a file")
        try:
            text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise _SpawnError(f"Error reading file {name}: {error}") from error
        if not text.strip():
            raise _SpawnError(f"Error: file {name} is empty")
        return text

    def _from_parameter(self, name: str) -> str:
        self._say(f"Loading model XML from ros parameter {name}")
        text = str(self._node.parameters.get(name, "") or "")
        if not text:
            hint = f"; the parameter is '{self._node.resolve_name(name)}'"
            raise _SpawnError("Error: param does not exist or is empty" + hint)
        return text

    def _from_topic(self, topic: str) -> str:
        self._say(f"Loading entity published on topic {topic}")
        found: list[str] = []
        came = threading.Event()

        def take(message: Any) -> None:
            found.append(str(message.data))
            came.set()

        subscription = self._node.create_subscription(topic, message_type("std_msgs/String"), take)
        self._say(f"Waiting for entity xml on {topic}")
        while not self._stop.is_set() and not came.wait(_POLL_S):
            continue
        subscription.unregister()
        return found[0] if found else ""

    def _as_models(self, text: str) -> str:
        """Check the XML before it is sent, and do what ``-package_to_model`` asks for."""
        if self._stop.is_set():
            return text
        try:
            ElementTree.fromstring(_without_declaration(text))  # noqa: S314 - no entities: expat
        except ElementTree.ParseError as error:
            raise _SpawnError(f"Invalid XML: {error}") from error
        if self._arguments.package_to_model:
            return text.replace('filename="package://', 'filename="model://')
        return text

    def _spawn(self, text: str) -> None:
        arguments = self._arguments
        pose = Pose.from_xyz_rpy(
            (arguments.x, arguments.y, arguments.z), (arguments.R, arguments.P, arguments.Y)
        )
        if self._ros2:
            service, kind = "spawn_entity", "gazebo_msgs/SpawnEntity"
            request = service_type(kind).Request(name=arguments.model, xml=text)
        else:
            # SDF may come through -urdf and the other way round; the server looks itself.
            service = "spawn_urdf_model" if arguments.urdf else "spawn_sdf_model"
            kind = "gazebo_msgs/SpawnModel"
            request = service_type(kind).Request(model_name=arguments.model, model_xml=text)
        request.robot_namespace = arguments.robot_namespace
        request.initial_pose = pose_message(pose)
        request.reference_frame = arguments.reference_frame
        name = join_names(self._namespace, service)
        limit = f", timeout = {arguments.timeout:.0f}" if self._ros2 else ""
        self._say(f"Waiting for service {name}{limit}")
        response = self._call(service, kind, request, told=True)
        if response is None:
            return
        self._say(f"Spawn status: {response.status_message}")
        if not response.success:
            raise _SpawnError("Spawn service failed. Exiting.")

    def _set_joints(self) -> None:
        arguments = self._arguments
        kind = "gazebo_msgs/SetModelConfiguration"
        request = service_type(kind).Request(
            model_name=arguments.model,
            joint_names=[name for name, _ in arguments.joints],
            joint_positions=[float(position) for _, position in arguments.joints],
        )
        response = self._call("set_model_configuration", kind, request)
        if response is not None and not response.success:
            raise _SpawnError(
                f"SetModelConfiguration service failed. Exiting. ({response.status_message})"
            )

    def _delete(self) -> None:
        model = self._arguments.model
        self._say(f"Deleting model {model}")
        if self._ros2:
            request = service_type("gazebo_msgs/DeleteEntity").Request(name=model)
            self._call("delete_entity", "gazebo_msgs/DeleteEntity", request, stopping=True)
        else:
            request = service_type("gazebo_msgs/DeleteModel").Request(model_name=model)
            self._call("delete_model", "gazebo_msgs/DeleteModel", request, stopping=True)

    def _call(
        self, service: str, kind: str, request: Any, *, told: bool = False, stopping: bool = False
    ) -> Any:
        """Call a service of the simulator; None when told to stop before it was there."""
        name = join_names(self._namespace, service)
        names = world_names(name)
        clients = [self._node.create_client(one, service_type(kind)) for one in names]
        waited = 0.0
        while not (client := first_there(clients, _POLL_S)):
            waited += _POLL_S
            if self._stop.is_set() and not stopping:
                return None
            if (
                self._ros2
                and waited >= self._arguments.timeout
                and not is_loading(self._node.graph)
            ):
                raise _SpawnError(
                    f"Service {name} unavailable. Was Gazebo started with GazeboRosFactory?"
                )
        if told:
            self._say(f"Calling service {name}")
        return client.call(request)

    def _say(self, text: str) -> None:
        self._node.log("info", text, padded=False)


def _without_declaration(text: str) -> str:
    """An encoding in the declaration of a text that is decoded already confuses the parser."""
    start = text.lstrip()
    return start.partition("?>")[2] if start.startswith("<?xml") else start
