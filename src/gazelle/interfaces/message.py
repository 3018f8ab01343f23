"""Message classes in the form of ROS 2, made on first use.

A numeric array is a numpy array; any sequence of numbers may be assigned and is converted when
the message is written. Byte sequences (``uint8[]``) take `bytes` too.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar

from gazelle.interfaces.codec_runtime import is_array
from gazelle.interfaces.definition import (
    FORMATS,
    NUMPY_NAMES,
    Array,
    Definition,
    Field,
    RosVersion,
    attribute_name,
)
from gazelle.interfaces.message_base import MessageBase, Types

__all__ = ["Message", "make_message_class", "recursion", "values_equal"]

_ZEROS: dict[str, Any] = {"": "", "?": False, "f": 0.0, "d": 0.0}
_Nested = Callable[[str], type["Message"]]


class Message(MessageBase):
    """Base of all message classes in the form of ROS 2."""

    __slots__ = ()
    GENERATION: ClassVar[RosVersion] = RosVersion.ROS2

    __hash__ = None  # type: ignore[assignment]

    if TYPE_CHECKING:  # fields are made from definitions

        def __init__(self, *args: Any, **kwargs: Any) -> None: ...
        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Message) or other.TYPE_NAME != self.TYPE_NAME:
            return NotImplemented
        return all(values_equal(getattr(self, name), getattr(other, name)) for name in self._names)

    def __repr__(self) -> str:
        inner = ", ".join(f"{name}={_short(getattr(self, name))}" for name in self._names)
        return f"{self.TYPE_NAME.replace('/', '.')}({inner})"

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return the types as text by field name, as rclpy's messages do."""
        return {item.name: item.type.idl for item in cls.FIELDS}


def values_equal(a: Any, b: Any) -> bool:
    """Return whether two field values are equal; arrays, lists and tuples by their items."""
    if is_array(a) or is_array(b):
        import numpy as np

        if isinstance(a, bytes | bytearray | memoryview):
            a = np.frombuffer(a, np.uint8)
        if isinstance(b, bytes | bytearray | memoryview):
            b = np.frombuffer(b, np.uint8)
        return bool(np.array_equal(a, b))
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return len(a) == len(b) and all(map(values_equal, a, b))
    return bool(a == b)


def _short(value: Any) -> str:
    if is_array(value):
        return f"<{value.size} × {value.dtype}>" if value.size > 12 else repr(value.tolist())
    return repr(value)


def make_message_class(source: Definition, types: Types, nested: _Nested) -> type[Message]:
    """Return a new class.

    Args:
        source: the definition.
        types: where the class asks for others.
        nested: gives the classes of the messages that it contains.
    """
    names = tuple(attribute_name(item.name) for item in source.fields)
    space: dict[str, Any] = {}
    arguments, body = [], []
    for index, (name, item) in enumerate(zip(names, source.fields, strict=True)):
        default = _default(item, index, space, nested)
        if default is None:
            arguments.append(f"{name}={space[f'_d{index}']!r}")
            body.append(f"  _s.{name} = {name}")
        else:
            arguments.append(f"{name}=None")
            body.append(f"  _s.{name} = {default} if {name} is None else {name}")
    lines = [f"def __init__(_s{''.join(', ' + text for text in arguments)}):", *body, "  return"]
    exec("\n".join(lines), space)  # noqa: S102 - names are checked identifiers of a definition
    attributes: dict[str, Any] = {item.name: item.value for item in source.constants}
    attributes |= {
        "__slots__": names,
        "__init__": space["__init__"],
        "__module__": f"{source.package}.msg",
        "__doc__": f"{source.name}\n\n{source.text}",
        "TYPE_NAME": source.name,
        "FIELDS": source.fields,
        "DEFINITION": source,
        "_names": names,
        "_types": types,
    }
    return type(source.name.rsplit("/", 1)[1], (Message,), attributes)


def _default(item: Field, index: int, space: dict[str, Any], nested: _Nested) -> str | None:
    """Return the source of a fresh default; None when ``_d<index>`` holds an immutable one."""
    kind, name = item.type, f"_d{index}"
    letter = FORMATS.get(kind.base)
    if kind.array is Array.ONE:
        if kind.is_message:
            space[name] = nested(kind.base)
            return f"{name}()"
        zero = _ZEROS.get(letter or "", 0)
        value = item.default if item.default is not None else zero
        space[name] = value
        return None
    if letter is not None:
        values = item.default if isinstance(item.default, tuple) else ()
        size = kind.size if kind.array is Array.FIXED else 0
        space[name] = _array_maker(values or (0,) * size, NUMPY_NAMES[letter])
        return f"{name}()"
    if isinstance(item.default, tuple):
        space[name] = item.default
        return f"list({name})"
    count = kind.size if kind.array is Array.FIXED else 0
    if not kind.is_message:
        return f"[''] * {count}" if count else "[]"
    space[name] = nested(kind.base)
    return f"[{name}() for _ in range({count})]" if count else "[]"


def _array_maker(values: tuple[Any, ...], kind: str) -> Callable[[], Any]:
    """Return what makes the default of an array; numpy is imported with the first message."""
    made: Any = None

    def make() -> Any:
        nonlocal made
        if made is None:
            import numpy as np

            made = np.array(values, kind)
        return made.copy() if values else made

    return make


def recursion(name: str, above: tuple[str, ...]) -> Exception:
    """Return what to raise of a message that contains itself, by way of those above it."""
    from gazelle.diagnostics import Diagnostic, Severity, SourceSpan
    from gazelle.diagnostics.catalogue import entry_for
    from gazelle.errors import UserFileError

    circle = " → ".join((*above[above.index(name) :], name))
    entry = entry_for("interfaces.recursive-type")
    return UserFileError(
        [
            Diagnostic(
                entry.code,
                Severity.ERROR,
                f"'{name}' contains itself: {circle}",
                SourceSpan(f"<{name}>"),
                entry.fix,
                entry.phrase,
            )
        ]
    )
