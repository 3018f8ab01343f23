"""Message classes in the form of ROS 1, with the surface that rospy programs use."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeVar

from gazelle.interfaces.definition import (
    FORMATS,
    Array,
    Definition,
    Field,
    RosVersion,
    attribute_name,
)
from gazelle.interfaces.message import values_equal
from gazelle.interfaces.message_base import MessageBase, Types
from gazelle.interfaces.ros1_time import Duration, Time
from gazelle.interfaces.type_names import ros1_name

__all__ = ["AnyMsg", "Ros1Message", "make_ros1_class"]

_M = TypeVar("_M", bound="Ros1Message")
_TIMES: dict[str, type[Time] | type[Duration]] = {"time": Time, "duration": Duration}


class _Writable(Protocol):
    def write(self, data: bytes, /) -> object: ...


class _Lazy:
    """A class attribute that is computed on first use."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __get__(self, instance: object, owner: type[Ros1Message]) -> str:
        from gazelle.interfaces import full_definition_text, ros1_md5sum

        compute = {
            "_md5sum": ros1_md5sum.md5sum,
            "_full_text": full_definition_text.ros1_definition,
        }
        text = compute[self._name](owner._types, owner.TYPE_NAME)
        setattr(owner, self._name, text)
        return text


class Ros1Message(MessageBase):
    """Base of all message classes in the form of ROS 1."""

    __slots__ = ("_connection_header",)
    GENERATION: ClassVar[RosVersion] = RosVersion.ROS1
    _slot_types: ClassVar[list[str]] = []
    _type: ClassVar[str] = ""
    _md5sum: ClassVar[str] = _Lazy("_md5sum")  # type: ignore[assignment]
    _full_text: ClassVar[str] = _Lazy("_full_text")  # type: ignore[assignment]
    _has_header: ClassVar[bool] = False

    __hash__ = None  # type: ignore[assignment]

    if TYPE_CHECKING:  # fields are made from definitions

        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...

    def __init__(self, *args: Any, **kwds: Any) -> None:
        """Take all fields in order, or some by name; None means the default."""

    def _get_types(self) -> list[str]:
        return self._slot_types

    def _check_types(self, exc: Exception | None = None) -> None:
        """Raise `InterfaceError` naming the first field whose value does not fit its type."""
        from gazelle.interfaces.field_check import check_fields

        check_fields(self, cause=exc)

    def serialize(self, buff: _Writable) -> None:
        """Write the message's ROS 1 bytes into a buffer.

        Raises:
            InterfaceError: a value does not fit its field.
        """
        from gazelle.interfaces.codec import to_ros1

        buff.write(to_ros1(self))

    def deserialize(self: _M, str: bytes) -> _M:
        """Fill this message from its ROS 1 bytes; return it.

        Raises:
            InterfaceError: the bytes are not of this type.
        """
        from gazelle.interfaces.codec import from_ros1

        found = from_ros1(type(self), str)
        for name in self._names:
            setattr(self, name, getattr(found, name))
        return self

    def serialize_numpy(self, buff: _Writable, numpy: object) -> None:
        """Write the message's ROS 1 bytes; arrays may be numpy arrays in `serialize` too."""
        self.serialize(buff)

    def deserialize_numpy(self: _M, str: bytes, numpy: Any) -> _M:
        """Fill this message from its ROS 1 bytes with numpy arrays in place of tuples."""
        from gazelle.interfaces.definition import NUMPY_NAMES

        self.deserialize(str)
        for name, item in zip(self._names, self.FIELDS, strict=True):
            letter = FORMATS.get(item.type.base)
            if letter is not None and item.type.array is not Array.ONE:
                value = getattr(self, name)
                convert = numpy.frombuffer if isinstance(value, bytes) else numpy.array
                setattr(self, name, convert(value, dtype=NUMPY_NAMES[letter]))
        return self

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return False
        return all(values_equal(getattr(self, name), getattr(other, name)) for name in self._names)

    def __str__(self) -> str:
        from gazelle.interfaces.echo_text import strify

        return strify(self)

    __repr__ = __str__

    def __getstate__(self) -> list[Any]:
        return [getattr(self, name) for name in self._names]

    def __setstate__(self, state: list[Any]) -> None:
        for name, value in zip(self._names, state, strict=True):
            setattr(self, name, value)


class AnyMsg(Ros1Message):
    """A message of any type, kept as its ROS 1 bytes in `_buff` (rospy.AnyMsg)."""

    __slots__ = ("_buff",)
    TYPE_NAME = "*"
    _type = "*"
    _md5sum = "*"
    _full_text = ""
    _buff: bytes | None

    def __init__(self, *args: Any) -> None:
        if args:
            raise TypeError("AnyMsg does not accept arguments")
        self._buff = None

    def __reduce__(self) -> tuple[Any, ...]:
        return _any_msg, (self._buff,)

    def serialize(self, buff: _Writable) -> None:
        """Write the bytes kept.

        Raises:
            ValueError: nothing was received yet.
        """
        if self._buff is None:
            raise ValueError("AnyMsg has no bytes yet")
        buff.write(self._buff)

    def deserialize(self, str: bytes) -> AnyMsg:
        """Keep the bytes."""
        self._buff = bytes(str)
        return self


def _kept_bytes(msg: AnyMsg) -> bytes:
    return msg._buff or b""


def _any_msg(data: bytes | None) -> AnyMsg:
    made = AnyMsg()
    made._buff = data
    return made


AnyMsg._ros1_writer = staticmethod(_kept_bytes)


def make_ros1_class(
    source: Definition, types: Types, nested: Callable[[str], type[Ros1Message]]
) -> type[Ros1Message]:
    """Return a new class.

    Args:
        source: the definition, which does not contain itself.
        types: where the class asks for others.
        nested: gives the classes of the messages that it contains.
    """
    names = tuple(attribute_name(item.name) for item in source.fields)
    space: dict[str, Any] = {"_assign": _assign}
    defaults = [_default(item, index, space, nested) for index, item in enumerate(source.fields)]
    pairs = list(zip(names, defaults, strict=True))
    lines = ["def __init__(_s, *args, **kwds):", " if args or kwds:", "  _assign(_s, args, kwds)"]
    lines += [f"  if _s.{name} is None: _s.{name} = {default}" for name, default in pairs]
    lines += [" else:", *(f"  _s.{name} = {default}" for name, default in pairs), "  return"]
    exec("\n".join(lines), space)  # noqa: S102 - names are checked identifiers of a definition
    first = source.fields[0] if source.fields else None
    short = ros1_name(source.name)
    attributes: dict[str, Any] = {item.name: item.value for item in source.constants}
    attributes |= {
        "__slots__": list(names),
        "__init__": space["__init__"],
        "__module__": f"{source.package}.{source.name.split('/')[1]}._{short.split('/')[1]}",
        "TYPE_NAME": source.name,
        "FIELDS": source.fields,
        "DEFINITION": source,
        "_names": names,
        "_types": types,
        "_slot_types": [item.type.text(RosVersion.ROS1) for item in source.fields],
        "_type": short,
        "_has_header": first is not None
        and first.type.base == "std_msgs/msg/Header"
        and first.type.array is Array.ONE,
    }
    return type(short.split("/")[1], (Ros1Message,), attributes)


def _default(
    item: Field, index: int, space: dict[str, Any], nested: Callable[[str], type[Ros1Message]]
) -> str:
    """Return the source of a fresh default value, by the rules of genpy's classes."""
    kind, name = item.type, f"_d{index}"
    letter = FORMATS.get(kind.base)
    if kind.array is Array.SEQUENCE:
        return "b''" if kind.base in ("uint8", "char") else "[]"
    if letter is not None or kind.is_string:
        zero = "''" if letter is None else {"?": "False", "f": "0.", "d": "0."}.get(letter, "0")
        if kind.array is Array.ONE:
            return zero
        if kind.base in ("uint8", "char"):
            return f"bytes({kind.size})"
        return f"[{zero}] * {kind.size}"
    space[name] = _TIMES.get(kind.base) or nested(kind.base)
    one = f"{name}()"
    return one if kind.array is Array.ONE else f"[{one} for _ in range({kind.size})]"


def _assign(message: Ros1Message, args: tuple[Any, ...], kwds: dict[str, Any]) -> None:
    names = message._names
    if args and kwds:
        raise TypeError("Message constructor may only use args OR keywords, not both")
    if args:
        if len(args) != len(names):
            raise TypeError(
                f"Invalid number of arguments, args should be {list(names)} args are{args}"
            )
        kwds = dict(zip(names, args, strict=True))
    for name in kwds:
        if name not in names:
            raise AttributeError(f"{name} is not an attribute of {type(message).__name__}")
    for name in names:
        setattr(message, name, kwds.get(name))
