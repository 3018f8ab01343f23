"""rosidl_runtime_py: messages as text, and types by their names."""

from __future__ import annotations

from collections import OrderedDict
from typing import Any

import numpy as np

from gazelle.documents.yaml import MESSAGE_STYLE, Layout, Writer, dump_yaml
from gazelle.interfaces import (
    Message,
    action_type,
    fill,
    known_types,
    message_type,
    service_type,
    time_keys,
    to_plain,
)
from gazelle.interfaces.definition import RosVersion

__all__ = [
    "get_action",
    "get_action_interfaces",
    "get_interface",
    "get_interface_packages",
    "get_interfaces",
    "get_message",
    "get_message_interfaces",
    "get_service",
    "get_service_interfaces",
    "is_action",
    "is_message",
    "is_service",
    "message_to_csv",
    "message_to_ordereddict",
    "message_to_yaml",
    "set_message_fields",
]

_PARTS = {"msg": message_type, "srv": service_type, "action": action_type}
_ELLIPSIS = "..."


def get_message(identifier: str) -> Any:
    """Return the class of ``pkg/msg/Name``.

    Raises:
        ValueError: the name has another form.
        NotFoundError: nothing defines it.
    """
    return _of_part(identifier, "msg", "message")


def get_service(identifier: str) -> Any:
    """Return the class of ``pkg/srv/Name``.

    Raises:
        ValueError: the name has another form.
        NotFoundError: nothing defines it.
    """
    return _of_part(identifier, "srv", "service")


def get_action(identifier: str) -> Any:
    """Return the class of ``pkg/action/Name``.

    Raises:
        ValueError: the name has another form.
        NotFoundError: nothing defines it.
    """
    return _of_part(identifier, "action", "action")


def get_interface(identifier: str) -> Any:
    """Return the class of ``pkg/msg/Name``, ``pkg/srv/Name`` or ``pkg/action/Name``.

    Raises:
        ValueError: the name has another form.
        NotFoundError: nothing defines it.
    """
    part = identifier.split("/")[1] if identifier.count("/") == 2 else ""
    return _of_part(identifier, part if part in _PARTS else "msg", "interface")


def is_message(interface: Any) -> bool:
    """Tell whether something is a message or its class."""
    return hasattr(interface, "get_fields_and_field_types")


def is_service(interface: Any) -> bool:
    """Tell whether something is a service's class."""
    return hasattr(interface, "Request") and hasattr(interface, "Response")


def is_action(interface: Any) -> bool:
    """Tell whether something is an action's class."""
    return all(hasattr(interface, name) for name in ("Goal", "Result", "Feedback"))


def get_interfaces(package_names: Any = ()) -> dict[str, list[str]]:
    """Return names such as ``msg/String`` by package, of all packages by default."""
    found: dict[str, list[str]] = {}
    for part in _PARTS:
        for name in known_types(part):
            package, _, rest = name.partition("/")
            if not package_names or package in package_names:
                found.setdefault(package, []).append(rest)
    return {package: sorted(names) for package, names in sorted(found.items())}


def get_interface_packages() -> dict[str, str]:
    """Return the packages that define types; nothing is installed, so prefixes are empty."""
    return dict.fromkeys(get_interfaces(), "")


def get_message_interfaces(package_names: Any = ()) -> dict[str, list[str]]:
    """Return the messages by package."""
    return _only("msg/", package_names)


def get_service_interfaces(package_names: Any = ()) -> dict[str, list[str]]:
    """Return the services by package."""
    return _only("srv/", package_names)


def get_action_interfaces(package_names: Any = ()) -> dict[str, list[str]]:
    """Return the actions by package."""
    return _only("action/", package_names)


def message_to_ordereddict(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
) -> OrderedDict[str, Any]:
    """Return a message as nested dictionaries.

    Args:
        msg: the message.
        truncate_length: cut texts and arrays after so many items, with ``...``.
        no_arr: show arrays by type and length only.
        no_str: show texts by length only.
    """
    found: OrderedDict[str, Any] = OrderedDict()
    for name, kind in msg.get_fields_and_field_types().items():
        value = getattr(msg, name)
        found[name] = _shown(value, kind, truncate_length, no_arr=no_arr, no_str=no_str)
    return found


def message_to_yaml(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
    flow_style: bool = False,
) -> str:
    """Return a message as YAML; see `message_to_ordereddict`."""
    plain = message_to_ordereddict(
        msg, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str
    )
    layout = Layout.FLOW if flow_style else Layout.BLOCK
    return dump_yaml(_as_dict(plain), MESSAGE_STYLE._replace(writer=Writer.PYTHON, layout=layout))


def message_to_csv(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
) -> str:
    """Return a message's values with commas between; see `message_to_ordereddict`."""
    plain = message_to_ordereddict(
        msg, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str
    )
    return ",".join(_flat(plain))


def set_message_fields(
    msg: Any, values: Any, expand_header_auto: bool = False, expand_time_now: bool = False
) -> list[Any]:
    """Set a message's fields from a dictionary or a list in their order.

    Raises:
        InterfaceError: a field does not exist, or a value does not fit.
    """
    keys: dict[str, Any] = {}
    if expand_header_auto or expand_time_now:
        import time

        keys = time_keys(time.time_ns(), RosVersion.ROS2)
    fill(msg, values, keys=keys)
    return []


def _of_part(identifier: str, part: str, what: str) -> Any:
    parts = identifier.split("/")
    if len(parts) != 3 or not all(parts):
        text = f"Expected the full name of {what}, got '{identifier}'"
        raise ValueError(f"{text}; write it as package/{part}/Name")
    if parts[1] != part:
        raise ValueError(f"Expected the full name of {what}, got '{identifier}': no {part}")
    return _PARTS[part](identifier)


def _only(start: str, package_names: Any) -> dict[str, list[str]]:
    rows = {
        package: [name for name in names if name.startswith(start)]
        for package, names in get_interfaces(package_names).items()
    }
    return {package: names for package, names in rows.items() if names}


def _shown(value: Any, kind: str, length: int | None, *, no_arr: bool, no_str: bool) -> Any:
    if isinstance(value, str):
        if no_str:
            return f"<string length: <{len(value)}>>"
        return value[:length] + _ELLIPSIS if length is not None and len(value) > length else value
    if isinstance(value, Message):
        return message_to_ordereddict(value, truncate_length=length, no_arr=no_arr, no_str=no_str)
    if not isinstance(value, bytes | bytearray | list | tuple | np.ndarray):
        return to_plain(value)
    if no_arr:
        return f"<{kind}, length: {len(value)}>"
    cut = len(value) if length is None else length
    items = value.tolist() if isinstance(value, np.ndarray) else list(value)
    shown = [_shown(one, "", length, no_arr=no_arr, no_str=no_str) for one in items[:cut]]
    return [*shown, _ELLIPSIS] if len(items) > cut else shown


def _as_dict(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _as_dict(item) for name, item in value.items()}
    return [_as_dict(item) for item in value] if isinstance(value, list) else value


def _flat(value: Any) -> list[str]:
    if isinstance(value, dict):
        return [text for item in value.values() for text in _flat(item)]
    if isinstance(value, list):
        return [text for item in value for text in _flat(item)]
    return [str(value)]
