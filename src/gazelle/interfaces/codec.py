"""Objects ↔ bytes. Codecs are compiled when a class is first written or read."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any, TypeVar

from gazelle.errors import GazelleError, InterfaceError
from gazelle.interfaces.definition import RosVersion
from gazelle.interfaces.message_base import MessageBase

__all__ = ["convert", "from_cdr", "from_ros1", "to_cdr", "to_ros1"]

_T = TypeVar("_T", bound=MessageBase)
_Writer = Callable[[Any], bytes]
_Reader = Callable[[Any], Any]


def to_cdr(msg: MessageBase) -> bytes:
    """Return a message's CDR bytes: encapsulation header, little endian, XCDR1.

    A ROS 1 object is written in the layout of the canonical ROS 2 type where there is one
    (`gazelle.interfaces.type_names.wire_type` names it).

    Raises:
        InterfaceError: a value does not fit its field; names it.
    """
    cls = msg.__class__
    try:
        write = cls._cdr_writer
    except AttributeError:
        raise _no_message_class(cls) from None
    if write is None:
        write = cls._cdr_writer = _compiled_writer(cls)
    try:
        found: bytes = write(msg)
    except GazelleError:
        raise
    except Exception as error:
        raise _write_error(msg, error) from error
    return found


def from_cdr(cls: type[_T], buffer: bytes | bytearray | memoryview) -> _T:
    """Return the message that CDR bytes hold, in the class asked for.

    Numeric arrays of ROS 2 classes are read-only views of `buffer`; keep it unchanged.

    Args:
        cls: a class of `message_type` or `ros1_message_type`.
        buffer: bytes with their encapsulation header, either byte order.

    Raises:
        InterfaceError: the bytes are not CDR or not of this type.
    """
    try:
        read = cls._cdr_reader
    except AttributeError:
        raise _no_message_class(cls) from None
    if read is None:
        read = cls._cdr_reader = _compiled_reader(cls)
    try:
        if buffer[1] != 1 or buffer[0] != 0:
            read = _other_reader(cls, buffer)
        found: _T = read(buffer)
    except (struct.error, ValueError, IndexError, MemoryError, OverflowError) as error:
        raise _read_error(cls, buffer, error) from error
    return found


def to_ros1(msg: MessageBase) -> bytes:
    """Return a message's bytes in ROS 1's own serialisation.

    Raises:
        InterfaceError: a value does not fit its field; names it.
    """
    cls = msg.__class__
    try:
        write = cls._ros1_writer
    except AttributeError:
        raise _no_message_class(cls) from None
    if write is None:
        write = cls._ros1_writer = _compiled_writer(cls, is_cdr=False)
    try:
        found: bytes = write(msg)
    except GazelleError:
        raise
    except Exception as error:
        raise _write_error(msg, error) from error
    return found


def from_ros1(cls: type[_T], buffer: bytes | bytearray | memoryview) -> _T:
    """Return the message that ROS 1's bytes hold, in the class asked for.

    Raises:
        InterfaceError: the bytes are not of this type.
    """
    try:
        read = cls._ros1_reader
    except AttributeError:
        raise _no_message_class(cls) from None
    if read is None:
        read = cls._ros1_reader = _compiled_reader(cls, is_cdr=False)
    try:
        found: _T = read(buffer)
    except (struct.error, ValueError, IndexError, MemoryError, OverflowError) as error:
        raise _read_error(cls, buffer, error) from error
    return found


def convert(msg: MessageBase, cls: type[_T]) -> _T:
    """Return a message in another form of its type: ROS 1 ↔ ROS 2.

    Raises:
        InterfaceError: the two are not forms of one type, or a value does not fit.
    """
    if isinstance(msg, cls):
        return msg
    return from_cdr(cls, to_cdr(msg))


def _no_message_class(cls: type[Any]) -> InterfaceError:
    return InterfaceError(f"{cls.__name__} is not a message class; it has no layout of its own")


def _checked(cls: type[Any]) -> None:
    if cls.TYPE_NAME == "*":
        raise InterfaceError(
            f"{cls.__name__} keeps the bytes of any type; it has no layout of its own"
        )


def _compiled_writer(cls: type[Any], *, is_cdr: bool = True) -> _Writer:
    _checked(cls)
    from gazelle.interfaces.codec_writer import compile_writer
    from gazelle.interfaces.ros1_conversion import CONVERTED
    from gazelle.interfaces.wire_layout import Wire, bind

    if is_cdr and cls.GENERATION is RosVersion.ROS1 and cls.TYPE_NAME in CONVERTED:
        conversion = CONVERTED[cls.TYPE_NAME]
        travels = cls._types.class_of(conversion.wire_name, RosVersion.ROS2)
        return lambda msg: to_cdr(conversion.to_wire(msg, travels))
    wire = Wire.CDR if is_cdr else Wire.ROS1
    return compile_writer(bind(cls._types, cls.TYPE_NAME, cls.GENERATION, wire), wire)


def _compiled_reader(cls: type[Any], *, is_cdr: bool = True, endian: str = "<") -> _Reader:
    _checked(cls)
    from gazelle.interfaces.codec_reader import compile_reader
    from gazelle.interfaces.ros1_conversion import CONVERTED
    from gazelle.interfaces.wire_layout import Wire, bind

    if is_cdr and cls.GENERATION is RosVersion.ROS1 and cls.TYPE_NAME in CONVERTED:
        conversion = CONVERTED[cls.TYPE_NAME]
        travels = cls._types.class_of(conversion.wire_name, RosVersion.ROS2)
        own = cls._types.class_of(cls.TYPE_NAME, RosVersion.ROS1)
        return lambda data: conversion.from_wire(from_cdr(travels, data), own)
    wire = Wire.CDR if is_cdr else Wire.ROS1
    return compile_reader(bind(cls._types, cls.TYPE_NAME, cls.GENERATION, wire), wire, endian)


def _other_reader(cls: type[Any], buffer: bytes | bytearray | memoryview) -> _Reader:
    if buffer[0] != 0 or buffer[1] != 0:
        raise ValueError(
            f"encapsulation {buffer[0]:02x} {buffer[1]:02x} is not plain CDR (00 00 or 00 01)"
        )
    if cls._big_reader is None:
        cls._big_reader = _compiled_reader(cls, endian=">")
    found: _Reader = cls._big_reader
    return found


def _read_error(cls: type[Any], buffer: Any, error: Exception) -> InterfaceError:
    return InterfaceError(
        f"{len(buffer)} bytes are not a {cls.TYPE_NAME}: {error}; "
        "the sender's definition may be another one (ROS: md5sum mismatch, buffer overrun)"
    )


def _write_error(msg: Any, error: Exception) -> InterfaceError:
    from gazelle.interfaces.field_check import find_problem

    found = find_problem(msg)
    return InterfaceError(found or f"{msg.TYPE_NAME} cannot be written: {error}")
