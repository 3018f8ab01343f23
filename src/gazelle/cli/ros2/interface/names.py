"""Which types ROS 2's commands know."""

from __future__ import annotations

from gazelle.cli.ros_types import learn_workspace_types
from gazelle.cli.tool import ToolError, hint
from gazelle.interfaces import definition, find_source, known_types
from gazelle.interfaces.definition import RosVersion

__all__ = ["PARTS", "checked_name", "interface_text", "interfaces"]

PARTS = ("msg", "srv", "action")
_PIECES = {
    "msg": ("",),
    "srv": ("_Request", "_Response"),
    "action": ("_Goal", "_Result", "_Feedback"),
}


def interfaces(part: str, package: str = "") -> list[str]:
    """Return the types of a part as ``pkg/part/Name``; what only ROS 1 has is left out."""
    learn_workspace_types()
    found = []
    for full in known_types(part, package):
        owner, its_part, name = full.split("/")
        only_ros1 = find_source(owner, its_part, name, RosVersion.ROS2) is None
        if not only_ros1 or _is_users(owner, its_part, name):
            found.append(full)
    return found


def checked_name(name: str) -> tuple[str, str, str]:
    """Return package, part and name of an interface.

    Raises:
        ToolError: it is not written so, or nothing defines it.
    """
    words = name.split("/")
    if len(words) != 3:
        raise ToolError(
            f"Invalid name '{name}'. Expected three parts separated by '/'{_spelled(name)}"
        )
    package, part, bare = words
    learn_workspace_types()
    if part in PARTS and name in known_types(part, package):
        return package, part, bare
    everything = [one for its_part in PARTS for one in interfaces(its_part)]
    near = hint(name, everything)
    if not any(one.startswith(f"{package}/") for one in everything):
        raise ToolError(f"Unknown package '{package}'{near}")
    raise ToolError(f"Could not find the interface '{name}'{near}")


def interface_text(package: str, part: str, bare: str) -> str:
    """Return the text that defines an interface, of ROS 1's ones what ROS 2 would write."""
    source = find_source(package, part, bare, RosVersion.ROS2)
    if source is not None:
        return source.text
    pieces = [
        definition(f"{package}/{part}/{bare}{suffix}", RosVersion.ROS2) for suffix in _PIECES[part]
    ]
    return "\n---\n".join(piece.text.strip("\n") for piece in pieces)


def _is_users(package: str, part: str, name: str) -> bool:
    source = find_source(package, part, name, RosVersion.ROS1)
    return source is not None and not source.file.startswith("<")


def _spelled(name: str) -> str:
    """``std_msgs/String`` is ROS 1's spelling; tell ROS 2's."""
    words = name.split("/")
    if len(words) != 2:
        return ""
    learn_workspace_types()
    full = [f"{words[0]}/{part}/{words[1]}" for part in PARTS]
    there = [one for one, part in zip(full, PARTS, strict=True) if one in known_types(part)]
    return f"\n  did you mean '{there[0]}'?" if there else ""
