"""Message classes in the form of ROS 2, made on first use.

A numeric array is a numpy array; any sequence of numbers may be assigned and is converted when
the message is written. Byte sequences (``uint8[]``) take `bytes` too.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar

from gazelle.interfaces import library
from gazelle.interfaces.arrays import is_array
from gazelle.interfaces.definition import (
    FORMATS,
    NUMPY_NAMES,
    Array,
    Definition,
    Field,
    Generation,
    attribute_name,
)
from gazelle.interfaces.lookup import definition, is_current, split_name

__all__ = ["Message", "canonical_name", "message_type", "values_equal"]

_ZEROS: dict[str, Any] = {"": "", "?": False, "f": 0.0, "d": 0.0}
_lock = threading.RLock()
_classes: dict[str, type[Message]] = {}
_revision = 0


class Message:
    """Base of all message classes in the form of ROS 2.

    Attributes:
        TYPE_NAME: full name, such as ``sensor_msgs/msg/LaserScan``.
        FIELDS: fields in the order of the definition.
    """

    __slots__ = ("__weakref__",)
    TYPE_NAME: ClassVar[str] = ""
    FIELDS: ClassVar[tuple[Field, ...]] = ()
    DEFINITION: ClassVar[Definition]
    GENERATION: ClassVar[Generation] = Generation.ROS2
    _names: ClassVar[tuple[str, ...]] = ()

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

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuild, (self.TYPE_NAME, [getattr(self, name) for name in self._names])

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return the types as text by field name, as rclpy's messages do."""
        return {item.name: item.type.idl for item in cls.FIELDS}


def canonical_name(name: str, part: str = "msg") -> str:
    """Return ``pkg/msg/Name`` for that or for ``pkg/Name``."""
    return "/".join(split_name(name, part))


def message_type(name: str) -> type[Message]:
    """Return the class of a message in the form of ROS 2; made on the first call.

    Args:
        name: ``sensor_msgs/msg/LaserScan`` or ``sensor_msgs/LaserScan``.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    found = _classes.get(name)
    if found is not None and _revision == library.revision():
        return found
    full = canonical_name(name)
    with _lock:
        _forget()
        if full not in _classes:
            _classes[full] = _make_class(definition(full, Generation.ROS2), ())
        _classes[name] = _classes[full]
        return _classes[full]


def _forget() -> None:
    """Drop classes of definitions that a newly added package changes."""
    global _revision
    if _revision == library.revision():
        return
    _revision = library.revision()
    for name, cls in list(_classes.items()):
        if not is_current(cls.DEFINITION):
            del _classes[name]


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


def _rebuild(name: str, values: list[Any]) -> Message:
    return message_type(name)(*values)


def _short(value: Any) -> str:
    if is_array(value):
        return f"<{value.size} × {value.dtype}>" if value.size > 12 else repr(value.tolist())
    return repr(value)


def _make_class(source: Definition, above: tuple[str, ...]) -> type[Message]:
    if source.name in above:
        raise _recursion(source, above)
    names = tuple(attribute_name(item.name) for item in source.fields)
    space: dict[str, Any] = {}
    arguments, body = [], []
    for index, (name, item) in enumerate(zip(names, source.fields, strict=True)):
        default = _default(item, index, space, (*above, source.name))
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
    }
    return type(source.name.rsplit("/", 1)[1], (Message,), attributes)


def _default(item: Field, index: int, space: dict[str, Any], above: tuple[str, ...]) -> str | None:
    """Return the source of a fresh default; None when ``_d<index>`` holds an immutable one."""
    kind, name = item.type, f"_d{index}"
    letter = FORMATS.get(kind.base)
    if kind.array is Array.ONE:
        if kind.is_message:
            space[name] = _nested(kind.base, above)
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
    space[name] = _nested(kind.base, above)
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


def _nested(name: str, above: tuple[str, ...]) -> type[Message]:
    if name not in _classes:
        _classes[name] = _make_class(definition(name, Generation.ROS2), above)
    return _classes[name]


def _recursion(source: Definition, above: tuple[str, ...]) -> Exception:
    from gazelle.diagnostics import Diagnostic, Severity, SourceSpan
    from gazelle.diagnostics.catalogue import entry_for
    from gazelle.errors import UserFileError

    circle = " → ".join((*above[above.index(source.name) :], source.name))
    entry = entry_for("interfaces.recursive-type")
    return UserFileError(
        [
            Diagnostic(
                entry.code,
                Severity.ERROR,
                f"'{source.name}' contains itself: {circle}",
                SourceSpan(f"<{source.name}>"),
                entry.fix,
                entry.phrase,
            )
        ]
    )
