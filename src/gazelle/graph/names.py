"""Names of the ROS graph: legal characters, resolution, remapping, command-line arguments.

The rules are those of ROS 1 (http://wiki.ros.org/Names): a name is global (``/a``), private
(``~a``), relative (``a/b``) or, relative with one part only, base (``a``).
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from gazelle.graph.errors import IllegalNameError

__all__ = [
    "CommandLine",
    "anonymous_name",
    "check_name",
    "check_node_name",
    "is_hidden",
    "is_legal",
    "is_legal_base",
    "join",
    "namespace_of",
    "parse_command_line",
    "remap",
    "resolve",
    "split",
]

_LEGAL = re.compile(r"[~/A-Za-z][\w/]*", re.ASCII)
_LEGAL_BASE = re.compile(r"[A-Za-z]\w*", re.ASCII)
_UNSAFE = re.compile(r"\W", re.ASCII)


class CommandLine(NamedTuple):
    """What ROS 1 takes from a program's arguments.

    Attributes:
        remappings: names as written, left to right.
        params: private parameters (``_rate:=5``) with YAML-typed values, names without ``_``.
        name: ``__name``, or None.
        namespace: ``__ns``, or None.
        special: all other ``__key:=value``, names with their underscores.
        rest: the arguments that are none of these.
    """

    remappings: dict[str, str]
    params: dict[str, Any]
    name: str | None
    namespace: str | None
    special: dict[str, str]
    rest: list[str]


def is_legal(name: str) -> bool:
    """Return whether ROS 1 allows the name; the empty name is the namespace itself and legal."""
    return not name or (bool(_LEGAL.fullmatch(name)) and "//" not in name)


def is_legal_base(name: str) -> bool:
    """Return whether the name has one part, as a node's own name must."""
    return bool(_LEGAL_BASE.fullmatch(name))


def is_hidden(name: str) -> bool:
    """Return whether a part starts with an underscore, which hides a name from listings."""
    return any(part.startswith("_") for part in name.split("/"))


def check_name(name: str, kind: str = "name") -> str:
    """Return the name if it is legal.

    Raises:
        IllegalNameError: it is not; the text names the character, as roscpp's does.
    """
    if is_legal(name):
        return name
    raise IllegalNameError(f"illegal {kind} '{name}': {_complaint(name)}")


def check_node_name(name: str, *, is_ros2: bool = False) -> str:
    """Return a node's own name if it is legal; ROS 2 takes one that starts with ``_`` as well.

    Raises:
        IllegalNameError: it is empty, has a namespace, or has an illegal character.
    """
    if not name:
        raise IllegalNameError("illegal node name '': name must not be empty")
    if "/" in name:
        raise IllegalNameError(
            f"illegal node name '{name}': namespaces are not allowed in node names\n"
            "  fix: pass the namespace on its own (__ns:=…, ROS_NAMESPACE, ns=… in launch files)"
        )
    if "~" in name:
        raise IllegalNameError(f"illegal node name '{name}': node names may not contain '~'")
    if is_legal_base(name.lstrip("_") if is_ros2 else name):
        return name
    raise IllegalNameError(f"illegal node name '{name}': {_complaint(name)}")


def resolve(
    name: str,
    namespace: str = "/",
    *,
    node: str = "",
    remappings: Mapping[str, str] | None = None,
) -> str:
    """Return the global name.

    Args:
        name: global, private (``~a`` or ``~/a``), relative or base name; empty is the namespace.
        namespace: where relative names start, such as ``/robot1``.
        node: the node's global name, where private names start; the namespace when empty.
        remappings: resolved name → resolved name, applied to the result.
    """
    if name.startswith("/"):
        found = name
    elif name.startswith("~"):
        found = join(node or namespace, name[1:].lstrip("/"))
    else:
        found = join(namespace, name)
    found = "/" + "/".join(part for part in found.split("/") if part)
    return remappings.get(found, found) if remappings else found


def remap(remappings: Mapping[str, str], namespace: str = "/", *, node: str = "") -> dict[str, str]:
    """Return remappings with both sides resolved, ready for `resolve`."""
    return {
        resolve(old, namespace, node=node): resolve(new, namespace, node=node)
        for old, new in remappings.items()
    }


def join(namespace: str, name: str) -> str:
    """Return the name below the namespace; a global or private name is returned as it is."""
    if name.startswith(("/", "~")):
        return name
    return f"{namespace.rstrip('/')}/{name}" if name else (namespace or "/")


def split(name: str) -> tuple[str, str]:
    """Return namespace and last part: ``/a/b`` → ``("/a", "b")``, ``/b`` → ``("/", "b")``."""
    head, _, tail = name.rstrip("/").rpartition("/")
    return head or "/", tail


def namespace_of(name: str) -> str:
    """Return the namespace of a global name."""
    return split(name)[0]


def anonymous_name(name: str) -> str:
    """Return the name made unique with host, process and time, as ``rospy`` and roslaunch do."""
    import socket

    host = _UNSAFE.sub("_", socket.gethostname())
    return f"{name}_{host}_{os.getpid()}_{time.time_ns() // 1000}"


def parse_command_line(arguments: Sequence[str]) -> CommandLine:
    """Split a program's arguments into what belongs to ROS and the rest.

    Args:
        arguments: without the program's own name.
    """
    found = CommandLine({}, {}, None, None, {}, [])
    name = namespace = None
    for argument in arguments:
        left, separator, right = argument.partition(":=")
        if not separator or not left or left.startswith("-"):
            found.rest.append(argument)
        elif left == "__name":
            name = right
        elif left == "__ns":
            namespace = right
        elif left.startswith("__"):
            found.special[left] = right
        elif left.startswith("_"):
            found.params[left[1:]] = _yaml_value(right)
        else:
            found.remappings[left] = right
    return found._replace(name=name, namespace=namespace)


def _yaml_value(text: str) -> Any:
    from gazelle.documents.yaml import YamlError, load_yaml

    try:
        return load_yaml(text) if text else ""
    except YamlError:
        return text


def _complaint(name: str) -> str:
    """Say what is wrong in the words of roscpp's ``names::validate``."""
    if not re.match(r"[~/A-Za-z]", name):
        return (
            f"Character [{name[0]}] is not valid as the first character in Graph Resource Name "
            f"[{name}].  Valid characters are a-z, A-Z, / and in some cases ~."
        )
    for index, character in enumerate(name[1:], 1):
        if not re.match(r"[\w/]", character, re.ASCII):
            return (
                f"Character [{character}] at element [{index}] is not valid in Graph Resource "
                f"Name [{name}].  Valid characters are a-z, A-Z, 0-9, / and _."
            )
    return "a name must not have two slashes in a row"
