"""MD5 sums of ROS 1 types, and the listing that ``rosmsg show`` prints.

The algorithm is documented at http://wiki.ros.org/ROS/Technical%20Overview (message
serialization and msg MD5 sums): constants first, no comments, nested messages by their sum.
"""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.interfaces.definition import Definition, RosVersion
from gazelle.interfaces.message_base import Types
from gazelle.interfaces.type_names import canonical_name

__all__ = ["md5sum", "service_md5sum", "show_message", "show_service"]


def md5sum(types: Types, name: str) -> str:
    """Return the MD5 sum of a message in ROS 1.

    Args:
        types: where definitions come from.
        name: ``sensor_msgs/LaserScan`` or the full name.

    Raises:
        NotFoundError: nothing defines it.
    """
    return _md5(_md5_text(types, _definition(types, name)))


def service_md5sum(types: Types, name: str) -> str:
    """Return the MD5 sum of a service in ROS 1: of request and response, one after the other.

    Raises:
        NotFoundError: nothing defines it.
    """
    full = canonical_name(name, "srv")
    parts = (_definition(types, f"{full}{suffix}") for suffix in ("_Request", "_Response"))
    return _md5("".join(_md5_text(types, part) for part in parts))


def show_message(types: Types, name: str, indent: str = "") -> str:
    """Return the fields of a message, nested ones indented, as ``rosmsg show`` prints them.

    Raises:
        NotFoundError: nothing defines it.
    """
    return "".join(f"{line}\n" for line in _shown(types, _definition(types, name), indent))


def show_service(types: Types, name: str) -> str:
    """Return request and response of a service, as ``rossrv show`` prints them.

    Raises:
        NotFoundError: nothing defines it.
    """
    full = canonical_name(name, "srv")
    request, response = (show_message(types, full + part) for part in ("_Request", "_Response"))
    return f"{request}---\n{response}"


def _definition(types: Types, name: str) -> Definition:
    return types.definition(canonical_name(name), RosVersion.ROS1)


def _md5(text: str) -> str:
    import hashlib

    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()


def _md5_text(types: Types, source: Definition) -> str:
    lines = [f"{item.type} {item.name}={item.text}" for item in source.constants]
    for item in source.fields:
        kind = item.type
        word = md5sum(types, kind.base) if kind.is_message else kind.text(RosVersion.ROS1)
        lines.append(f"{word} {item.name}")
    return "\n".join(lines)


def _shown(types: Types, source: Definition, indent: str) -> Iterator[str]:
    for constant in source.constants:
        yield f"{indent}{constant.type} {constant.name}={_constant(constant.value, constant.text)}"
    for item in source.fields:
        yield f"{indent}{item.type.text(RosVersion.ROS1)} {item.name}"
        if item.type.is_message:
            yield from _shown(types, _definition(types, item.type.base), indent + "  ")


def _constant(value: object, text: str) -> str:
    return text if isinstance(value, str) else str(value)
