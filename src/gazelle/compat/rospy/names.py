"""Names of the node's program: remappings, scopes and validators (rospy.names)."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence

from gazelle.compat.rosgraph import names as _names
from gazelle.compat.rosgraph.names import canonicalize_name, load_mappings
from gazelle.compat.rospy.exceptions import ParameterInvalid, ROSException
from gazelle.compat.rospy.state import STATE

__all__ = [
    "SERVICE_ANYTYPE",
    "TOPIC_ANYTYPE",
    "canonicalize_name",
    "get_caller_id",
    "get_mappings",
    "get_name",
    "get_namespace",
    "get_resolved_mappings",
    "global_name",
    "is_topic",
    "isstring",
    "remap_name",
    "resolve_name",
    "resolve_name_without_node_name",
    "scoped_name",
    "valid_name",
    "valid_name_validator_resolved",
    "valid_name_validator_unresolved",
]

TOPIC_ANYTYPE = SERVICE_ANYTYPE = _names.ANYTYPE
Validator = Callable[[object, str], str]


def get_name() -> str:
    """Return the node's global name; ``unnamed`` in the program's namespace before `init_node`."""
    return STATE.node.name if STATE.node is not None else f"{get_namespace()}unnamed"


def get_caller_id() -> str:
    """Return the node's global name."""
    return get_name()


def get_namespace() -> str:
    """Return the node's namespace, ending with ``/``."""
    if STATE.node is None:
        return _names.get_ros_namespace(argv=_arguments())
    return STATE.node.namespace.rstrip("/") + "/"


def get_mappings() -> dict[str, str]:
    """Return the program's ``a:=b`` as written, ``__name:=c`` too."""
    return load_mappings(_arguments())


def get_resolved_mappings() -> dict[str, str]:
    """Return the program's ``a:=b`` with global names; empty before `init_node`."""
    if STATE.node is None:
        return {}
    own = STATE.node.name
    return {
        old if old.startswith("__") else _names.resolve_name(old, own): (
            new if old.startswith("__") else _names.resolve_name(new, own)
        )
        for old, new in get_mappings().items()
    }


def resolve_name(name: str, caller_id: str | None = None) -> str:
    """Return the global name after remaps; relative to another node if one is given."""
    if caller_id:
        found = _names.resolve_name(name, caller_id)
        return get_resolved_mappings().get(found, found)
    return STATE.resolved(name)


def resolve_name_without_node_name(name: str) -> str:
    """Return the global name after remaps, of a topic that is made before `init_node`.

    Raises:
        ValueError: it is private: there is no node yet that it could belong to.
    """
    if _names.is_private(name):
        raise ValueError("~name topics cannot be created before init_node() has been called")
    own = f"{get_namespace()}node"
    found = _names.resolve_name(name, own)
    for old, new in get_mappings().items():
        if _names.resolve_name(old, own) == found:
            return _names.resolve_name(new, own)
    return found


def remap_name(name: str, caller_id: str | None = None, resolved: bool = True) -> str:
    """Return the global name of what a name is remapped to; without a remap, the name itself.

    Args:
        name: as it stands left of ``:=``.
        caller_id: the node whose namespace counts, or None for this one.
        resolved: taken and without effect, as in rospy.
    """
    found = get_mappings().get(name)
    return name if found is None else _names.resolve_name(found, caller_id or get_caller_id())


def scoped_name(caller_id: str, name: str) -> str:
    """Return a global name as seen from the namespace of a node.

    Raises:
        ROSException: the node's name is not global.
    """
    if not _names.is_global(caller_id):
        raise ROSException("caller_id must be global")
    return canonicalize_name(name)[len(_names.namespace(caller_id)) :]


def isstring(s: object) -> bool:
    """Tell whether something is text."""
    return isinstance(s, str)


def valid_name_validator_resolved(param_name: str, param_value: object, caller_id: str) -> str:
    """Return a name as a global one, not remapped.

    Raises:
        ParameterInvalid: it is no text, empty, or has a colon or a blank.
    """
    text = valid_name_validator_unresolved(param_name, param_value, caller_id)
    return _names.resolve_name(text, caller_id)


def valid_name_validator_unresolved(param_name: str, param_value: object, caller_id: str) -> str:
    """Return a name as it is; `caller_id` is there for all validators to be called alike.

    Raises:
        ParameterInvalid: it is no text, empty, or has a colon or a blank.
    """
    if not isinstance(param_value, str) or not param_value:
        raise ParameterInvalid(f"ERROR: parameter [{param_name}] must be a non-empty string")
    if ":" in param_value or " " in param_value:
        raise ParameterInvalid(f"ERROR: parameter [{param_name}] contains illegal chars")
    return param_value


def valid_name(param_name: str, resolve: bool = True) -> Validator:
    """Return a check of names; it makes them global unless told not to."""
    check = valid_name_validator_resolved if resolve else valid_name_validator_unresolved
    return lambda param_value, caller_id: check(param_name, param_value, caller_id)


def global_name(param_name: str) -> Validator:
    """Return a check of names that takes global ones only."""

    def check(param_value: object, caller_id: str) -> str:
        if not isinstance(param_value, str) or not param_value:
            raise ParameterInvalid(f"ERROR: parameter [{param_name}] must be a non-empty string")
        if not _names.is_global(param_value):
            raise ParameterInvalid(
                f"ERROR: parameter [{param_name}] must be a globally referenced name"
            )
        return param_value

    return check


def is_topic(param_name: str) -> Validator:
    """Return a check of topics' names; it makes them global."""

    def check(param_value: object, caller_id: str) -> str:
        found = valid_name_validator_resolved(param_name, param_value, caller_id)
        if param_value == "/":
            raise ParameterInvalid(
                f"ERROR: parameter [{param_name}] cannot be the global namespace"
            )
        return found

    return check


def _arguments() -> Sequence[str]:
    return sys.argv if STATE.argv is None else STATE.argv
