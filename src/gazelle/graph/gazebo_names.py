"""Under which names a world offers what ``gazebo_ros`` of ROS 1 does.

ROS 1 has it below ``/gazebo``. Neither ROS 2 nor the new Gazebo has these names, and programs of
Gazelle's ask the world by them: there they are below ``/_gazebo``, which lists hide.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.graph.key_expressions import Entity, Kind

if TYPE_CHECKING:
    from gazelle.graph.graph import Graph

__all__ = [
    "HIDDEN_SPACE",
    "SHOWN_SPACE",
    "first_there",
    "hidden_transport_name",
    "is_loading",
    "offered_name",
    "other_version_hint",
    "shown_transport_name",
    "world_names",
    "world_space",
]

SHOWN_SPACE = "/gazebo"
HIDDEN_SPACE = "/_gazebo"
_TRANSPORT = "/_transport"
_SIMULATOR = "gazebo"
_CLOCK = "/clock"
_ROS2 = 2
_OFFERS = frozenset({Kind.SERVICE, Kind.PUBLISHER})
_SPAWN = ("/spawn_entity", "create")
_DELETE = ("/delete_entity", "remove")
_PROPERTIES = (
    "get_model_properties",
    "get_joint_properties",
    "set_joint_properties",
    "get_link_properties",
    "set_link_properties",
    "get_light_properties",
    "set_light_properties",
)
# What a plug-in in the world's file offers, in the namespace that it names.
_PLUGIN_OF = {
    "get_entity_state": "gazebo_ros_state",
    "set_entity_state": "gazebo_ros_state",
    **dict.fromkeys(_PROPERTIES, "gazebo_ros_properties"),
}
# What ROS 2's gazebo_ros and a world of gz have in place of ROS 1's services.
_INSTEAD = {
    "spawn_urdf_model": _SPAWN,
    "spawn_sdf_model": _SPAWN,
    "delete_model": _DELETE,
    "get_world_properties": ("/get_model_list", ""),
    "get_model_state": ("get_entity_state", ""),
    "get_link_state": ("get_entity_state", ""),
    "set_model_state": ("set_entity_state", "set_pose"),
    "set_link_state": ("set_entity_state", ""),
    **{name: (name, "") for name in _PROPERTIES},
    "pause_physics": ("/pause_physics", "control"),
    "unpause_physics": ("/unpause_physics", "control"),
    "reset_simulation": ("/reset_simulation", "control"),
    "reset_world": ("/reset_world", "control"),
    "apply_body_wrench": ("/apply_link_wrench", ""),
    "clear_body_wrenches": ("/clear_link_wrenches", ""),
    "apply_joint_effort": ("/apply_joint_effort", ""),
    "clear_joint_forces": ("/clear_joint_efforts", ""),
}


def world_space(ros_version: int, *, is_gz: bool = False) -> str:
    """Return where a world offers ROS 1's names.

    Args:
        ros_version: of what started it, 0 when nothing tells.
        is_gz: it was started by a command of the new Gazebo.
    """
    return HIDDEN_SPACE if is_gz or ros_version == _ROS2 else SHOWN_SPACE


def world_names(name: str) -> tuple[str, ...]:
    """Return a name of ROS 1's ``gazebo_ros`` and the one it is hidden as; others alone."""
    start = f"{SHOWN_SPACE}/"
    if not name.startswith(start):
        return (name,)
    return (name, f"{HIDDEN_SPACE}/{name.removeprefix(start)}")


def hidden_transport_name(name: str, world: str) -> str:
    """Return as what the graph has a topic of Gazebo Classic's own transport.

    Args:
        name: the topic; ``~`` is ``/gazebo/WORLD``.
        world: the world's name.
    """
    # Gazebo makes one slash of two as well: a model may be called "/drone".
    full = re.sub("/{2,}", "/", "/" + name.replace("~", f"{SHOWN_SPACE}/{world}", 1).strip("/"))
    legal = re.sub(r"[^A-Za-z0-9_/]", lambda found: f"_x{ord(found[0]):x}_", full)
    return _TRANSPORT + legal


def shown_transport_name(name: str) -> str:
    """Return what Gazebo calls a `hidden_transport_name`; empty for any other name."""
    if not name.startswith(f"{_TRANSPORT}/"):
        return ""
    full = name.removeprefix(_TRANSPORT)
    return re.sub(r"_x([0-9a-f]+)_", lambda found: chr(int(found[1], 16)), full)


def offered_name(graph: Graph, name: str, wait_s: float | None = None) -> str:
    """Return the one of `world_names` that is there, the name itself when none is.

    Args:
        graph: where to look.
        name: of a service or a topic, as ROS 1 has it.
        wait_s: how long it may take to come; when None, until nothing new comes to the graph.
    """
    names = world_names(name)

    def is_there(known: Iterable[Entity]) -> bool:
        return any(one.kind in _OFFERS and one.name in names for one in known)

    if wait_s is None:
        graph.discovery.settles(is_there)
    else:
        graph.discovery.wait_for(is_there, wait_s)
    offered = {one.name for one in graph.discovery.known() if one.kind in _OFFERS}
    return next((one for one in names if one in offered), name)


def is_loading(graph: Graph) -> bool:
    """Tell whether a simulator is there whose world is not: it prepares meshes before its clock.

    Gazebo is not as slow, so the time-outs of programs that wait for its world do not count that.
    """
    known = graph.discovery.known()
    if any(one.kind is Kind.PUBLISHER and one.name == _CLOCK for one in known):
        return False
    nodes = (one.node.rpartition("/")[2] for one in known if one.kind is Kind.NODE)
    return any(name == _SIMULATOR for name in nodes)


def first_there(clients: Sequence[Any], wait_s: float) -> Any:
    """Return the first client whose service comes in time, None when none does."""
    each_s = wait_s / len(clients)
    return next((client for client in clients if client.wait_for_service(each_s)), None)


def other_version_hint(name: str, offered: Iterable[str]) -> str:
    """Return what to call for a service of ROS 1 in a world that hides it; empty elsewhere."""
    names, offered = world_names(name), set(offered)
    if name in offered or offered.isdisjoint(names):
        return ""
    in_ros2, in_gz = _INSTEAD.get(name.rpartition("/")[2], ("", ""))
    text = "it is ROS 1's, and this world was started by ROS 2 or gz"
    in_ros2, there = _in_world(in_ros2, offered)
    commands = [in_ros2] if in_ros2 else []
    commands += [f"gz service -s /world/NAME/{in_gz}"] if in_gz and not there else []
    return f"{text}, which have {' or '.join(commands)}" if commands else text


def _in_world(service: str, offered: Iterable[str]) -> tuple[str, bool]:
    """Return what to say for a service of ROS 2's, and whether this world offers it."""
    plugin = _PLUGIN_OF.get(service)
    if plugin is None:
        return service, service in offered
    shown = (one for one in sorted(offered) if not one.startswith(f"{HIDDEN_SPACE}/"))
    found = next((one for one in shown if one.endswith(f"/{service}")), "")
    line = f'<plugin name="{plugin}" filename="lib{plugin}.so"/>'
    return found or f"/{service} once the world's file has {line}", bool(found)
