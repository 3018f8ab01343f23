"""``ros_gz_sim/create``: puts a model into the running world."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gazelle.documents.files import is_file
from gazelle.errors import GazelleError, LaunchError
from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.graph.gazebo_names import first_there, offered_name, world_names
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import set_pose
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.gflags import Kind, read_flags
from gazelle.nodes.parameters import parameter_tree, private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader, number_of

__all__ = ["PARAMETERS", "model_text", "run"]


_INCLUDE = (
    '<sdf version="1.6"><world name="default"><include><uri>{uri}</uri></include></world></sdf>'
)
_MODEL_FILES = ("model.sdf", "model.urdf")

PARAMETERS = ParameterTable(
    "create",
    "Puts a model into the running world, and ends. Flags of the same names count where these are"
    " empty, 0 or false. What should be a number and is none ends it with an error.",
    ("ros_gz_sim/create",),
    (
        Parameter("world", "text", "", "the world's name, of which there is one"),
        Parameter("file", "text", "", "the model: a file, a folder or an address"),
        Parameter("param", "text", "", "the parameter of this node that holds the model"),
        Parameter("string", "text", "", "the model itself"),
        Parameter("topic", "text", "", "the topic that tells the model"),
        Parameter("name", "text", "", "what the model is called here"),
        Parameter("allow_renaming", "flag", False, "a number is added where the name is taken"),
        Parameter("x", "number", 0.0, "where it stands in the world", "m"),
        Parameter("y", "number", 0.0, "the same to the left", "m"),
        Parameter("z", "number", 0.0, "the same upwards", "m"),
        Parameter("R", "number", 0.0, "how it is turned about x", "rad"),
        Parameter("P", "number", 0.0, "how it is turned about y", "rad"),
        Parameter("Y", "number", 0.0, "how it is turned about z", "rad"),
    ),
)
_KINDS: dict[str, Kind] = {"text": "string", "number": "double", "flag": "bool"}
_FLAGS = {row.key: _KINDS[row.kind] for row in PARAMETERS.rows}

_USAGE = (
    "usage: create -world [arg] [-file FILE] [-param PARAM] [-topic TOPIC] [-string STRING] "
    "[-name NAME] [-allow_renaming RENAMING] [-x X] [-y Y] [-z Z] [-R ROLL] [-P PITCH] [-Y YAW]"
)
_SPAWN = ("/gazebo/spawn_sdf_model", "gazebo_msgs/SpawnModel")
_PROPERTIES = ("/gazebo/get_world_properties", "gazebo_msgs/GetWorldProperties")
_POLL_S = 0.1
_TELL_S = 5.0


def model_text(name: str) -> str:
    """Return the XML of a model.

    Args:
        name: a file, a folder with a model in it, or an address (``model://``, ``package://``,
            ``https://fuel…``).

    Raises:
        GazelleError: there is none.
    """
    from gazelle.workspace import Workspace

    found = Workspace.discover().resolve(name)
    if found.path is None:
        raise GazelleError(found.explain(name))
    if is_file(found.path):
        return found.path.read_text(encoding="utf-8", errors="replace")
    file = next((found.path / one for one in _MODEL_FILES if is_file(found.path / one)), None)
    if file is None:
        # Its model.config says which file it is.
        return _INCLUDE.format(uri=name if "://" in name else Path(found.path).as_uri())
    return file.read_text(encoding="utf-8", errors="replace")


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Create a model, say how it went, and end."""
    node = start_node(arguments, graph)
    try:
        flags = read_flags(
            arguments.rest,
            _FLAGS,
            _USAGE,
            on_unknown=lambda message: node.log("warn", f"{message}; it has no effect"),
        )
        options = _options(node, arguments, flags)
        return _create(node, options, stop)
    except GazelleError as error:
        node.log("error", str(error))
        return 1
    finally:
        node.shutdown()


def _options(node: Node, arguments: NodeArguments, flags: Mapping[str, Any]) -> dict[str, Any]:
    """Return what parameters say, and flags where they say nothing; ``model`` is what one holds."""
    place = str(parameter_tree(node, arguments).get("param") or flags.get("param") or "")
    key = place.replace("/", ".")
    rows = (Parameter(key, "text", "", "the model"),) if key else ()
    with private_parameters(node, arguments, PARAMETERS.plus(rows)) as own:
        found = {row.key: _given(own, row) or flags.get(row.key, row.default)
                 for row in PARAMETERS.rows}  # fmt: skip
        return {**found, "param": place, "model": own.text(key) if key else ""}


def _given(own: ParameterReader, row: Parameter) -> Any:
    value = own.raw(row.key)
    if value in (None, ""):
        # What a launch file's argument without a value comes to.
        return row.default
    if row.kind == "number" and number_of(value) is None:
        raise LaunchError(f"the parameter '{row.key}' is no number: '{value}'")
    return own.value(row)


def _create(node: Node, options: Mapping[str, Any], stop: threading.Event) -> int:
    text = _text(node, options, stop)
    # A world's services come one after the other; both are called.
    for service, its_kind in (_SPAWN, _PROPERTIES):
        if not _wait(node, service, its_kind, stop):
            node.log("info", "Entity creation was interrupted.")
            return 0
    kind: Any = service_type(_SPAWN[1])
    request = kind.Request(model_name=_name(node, options), model_xml=text)
    pose = Pose.from_xyz_rpy(
        (options["x"], options["y"], options["z"]), (options["R"], options["P"], options["Y"])
    )
    set_pose(request.initial_pose, pose)
    spawn = offered_name(node.graph, _SPAWN[0])
    answer = node.create_client(spawn, kind).call(request)
    if not answer.success:
        node.log("error", f"Entity creation failed.\n {answer.status_message}")
        return 1
    node.log("info", "Entity creation successful.")
    return 0


def _text(node: Node, options: Mapping[str, Any], stop: threading.Event) -> str:
    if options["file"]:
        return model_text(options["file"])
    if options["param"]:
        if not options["model"]:
            raise LaunchError(f"Failed to get XML from param [{options['param']}].")
        return str(options["model"])
    if options["string"]:
        return str(options["string"])
    if options["topic"]:
        return _from_topic(node, options["topic"], stop)
    raise LaunchError("Must specify either -file, -param, -string or -topic")


def _from_topic(node: Node, topic: str, stop: threading.Event) -> str:
    found: list[str] = []
    came = threading.Event()

    def take(message: Any) -> None:
        found.append(str(message.data))
        came.set()

    subscription = node.create_subscription(topic, message_type("std_msgs/msg/String"), take)
    node.log("info", f"Waiting messages on topic [{topic}].")
    while not stop.is_set() and not came.wait(_POLL_S):
        continue
    subscription.unregister()
    if not found:
        raise LaunchError(f"Failed to get XML from topic [{topic}].")
    return found[0]


def _name(node: Node, options: Mapping[str, Any]) -> str:
    """Return the model's name, with a number behind it where it is taken and may be changed."""
    wanted = str(options["name"])
    if not wanted or not options["allow_renaming"]:
        return wanted
    kind: Any = service_type(_PROPERTIES[1])
    client = node.create_client(offered_name(node.graph, _PROPERTIES[0]), kind)
    taken = set(client.call(kind.Request()).model_names)
    name, count = wanted, 0
    while name in taken:
        count += 1
        name = f"{wanted}_{count}"
    return name


def _wait(node: Node, service: str, kind: str, stop: threading.Event) -> bool:
    clients = [node.create_client(name, service_type(kind)) for name in world_names(service)]
    waited_s = 0.0
    while not stop.is_set():
        if first_there(clients, _POLL_S) is not None:
            return True
        waited_s += _POLL_S
        if waited_s >= _TELL_S:
            waited_s = 0.0
            node.log("warn", f"Waiting for service [{service}] to become available ...")
    return False
