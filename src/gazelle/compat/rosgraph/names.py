"""Names of ROS 1 (rosgraph.names)."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping, Sequence

from gazelle.graph import names
from gazelle.graph.names import is_legal, is_legal_base

__all__ = [
    "ANYTYPE",
    "BASE_NAME_LEGAL_CHARS_P",
    "GLOBALNS",
    "MSG_EXT",
    "NAME_LEGAL_CHARS_P",
    "PRIV_NAME",
    "REMAP",
    "REMAP_PATTERN",
    "SEP",
    "SRV_EXT",
    "anonymous_name",
    "canonicalize_name",
    "get_ros_namespace",
    "is_global",
    "is_legal_base_name",
    "is_legal_name",
    "is_legal_remap",
    "is_private",
    "isstring",
    "load_mappings",
    "make_caller_id",
    "make_global_ns",
    "namespace",
    "ns_join",
    "resolve_name",
    "script_resolve_name",
]

ANYTYPE = "*"
GLOBALNS = SEP = "/"
PRIV_NAME = "~"
REMAP = ":="
MSG_EXT = ".msg"
SRV_EXT = ".srv"
NAME_LEGAL_CHARS_P = re.compile(r"^[~/A-Za-z][\w/]*$")
BASE_NAME_LEGAL_CHARS_P = re.compile(r"^[A-Za-z]\w*$")
REMAP_PATTERN = re.compile(r"^([~/A-Za-z]|_|__)[\w/]*:=.*")
is_legal_name = is_legal
is_legal_base_name = is_legal_base


def anonymous_name(id: str) -> str:
    """Return the name made unique with host, process and time."""
    return names.anonymous_name(id)


def isstring(s: object) -> bool:
    """Tell whether something is text."""
    return isinstance(s, str)


def is_legal_remap(arg: str | None) -> bool:
    """Tell whether a word of a command line is ``a:=b``, ``_a:=b`` or ``__a:=b``."""
    return arg is not None and REMAP_PATTERN.fullmatch(arg) is not None


def is_global(name: str) -> bool:
    """Tell whether a name starts at the root."""
    return name.startswith(SEP)


def is_private(name: str) -> bool:
    """Tell whether a name starts at a node."""
    return name.startswith(PRIV_NAME)


def ns_join(ns: str, name: str) -> str:
    """Return a name below a namespace; global and private names stay as they are."""
    if is_global(name) or is_private(name):
        return name
    return f"{ns}{name}" if ns.endswith((SEP, PRIV_NAME)) else f"{ns}{SEP}{name}" if ns else name


def namespace(name: str) -> str:
    """Return the namespace of a global name, with a slash at its end.

    Raises:
        ValueError: there is no name.
    """
    if name is None:
        raise ValueError("name")
    head = name.rstrip(SEP).rpartition(SEP)[0]
    return f"{head}{SEP}"


def make_global_ns(name: str) -> str:
    """Return a namespace that starts and ends with a slash.

    Raises:
        ValueError: it is private.
    """
    if is_private(name):
        raise ValueError(f"cannot turn [{name}] into a global name")
    found = name if is_global(name) else f"{SEP}{name}"
    return found if found.endswith(SEP) else f"{found}{SEP}"


def get_ros_namespace(
    env: Mapping[str, str] | None = None, argv: Sequence[str] | None = None
) -> str:
    """Return ``__ns:=`` of a command line, or ``ROS_NAMESPACE``, as a global namespace."""
    given = names.parse_command_line(list(sys.argv if argv is None else argv)).namespace
    environ = os.environ if env is None else env
    return make_global_ns(given or environ.get("ROS_NAMESPACE", GLOBALNS))


def make_caller_id(name: str) -> str:
    """Return the global name of a node of this program's namespace."""
    return make_global_ns(ns_join(get_ros_namespace(), name))


def canonicalize_name(name: str) -> str:
    """Return a name without double slashes and the one at its end."""
    if not name or name == SEP:
        return name
    start = SEP if is_global(name) else ""
    return start + SEP.join(part for part in name.split(SEP) if part)


def resolve_name(name: str, namespace_: str, remappings: Mapping[str, str] | None = None) -> str:
    """Return a name as seen from a node, remapped."""
    if not name:
        return namespace(namespace_)
    plain = canonicalize_name(name)
    if is_private(plain):
        found = canonicalize_name(f"{namespace_}{SEP}{plain[1:]}")
    else:
        found = plain if is_global(plain) else namespace(namespace_) + plain
    return (remappings or {}).get(found, found)


def script_resolve_name(script_name: str, name: str) -> str:
    """Return a name as seen from a command-line tool."""
    if not name:
        return get_ros_namespace()
    if is_global(name):
        return name
    if is_private(name):
        return ns_join(make_caller_id(script_name), name[1:])
    return get_ros_namespace() + name


def load_mappings(argv: Sequence[str]) -> dict[str, str]:
    """Return ``a:=b`` of a command line, ``__name:=b`` too; ``_parameter:=b`` is none."""
    found: dict[str, str] = {}
    for argument in argv:
        old, _, new = (part.strip() for part in argument.partition(REMAP))
        is_parameter = old.startswith("_") and not old.startswith("__")
        if old and new and not is_parameter and REMAP not in new:
            found[old] = new
    return found
