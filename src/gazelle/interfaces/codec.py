"""Objects ↔ bytes. Codecs are compiled when a class is first written or read."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any, TypeVar

from gazelle.errors import GazelleError, InterfaceError
from gazelle.interfaces.definition import Generation
from gazelle.interfaces.message import Message
from gazelle.interfaces.ros1_message import AnyMsg, Ros1Message

__all__ = ["convert", "from_cdr", "from_ros1", "to_cdr", "to_ros1"]

_T = TypeVar("_T", bound=Message | Ros1Message)
_Writer = Callable[[Any], bytes]
_Reader = Callable[[Any], Any]

_cdr_writers: dict[type, _Writer] = {}
_cdr_readers: dict[type, _Reader] = {}
_big_readers: dict[type, _Reader] = {}
_ros1_writers: dict[type, _Writer] = {}
_ros1_readers: dict[type, _Reader] = {}


def to_cdr(msg: Message | Ros1Message) -> bytes:
    """Return a message's CDR bytes: encapsulation header, little endian, XCDR1.

    A ROS 1 object is written in the layout of the canonical ROS 2 type where there is one
    (`gazelle.interfaces.naming.wire_type` names it).

    Raises:
        InterfaceError: a value does not fit its field; names it.
    """
    cls = msg.__class__
    try:
        write = _cdr_writers[cls]
    except KeyError:
        write = _cdr_writers[cls] = _compiled_writer(cls)
    try:
        return write(msg)
    except GazelleError:
        raise
    except Exception as error:
        raise _write_error(msg, error) from error


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
        read = _cdr_readers[cls]
    except KeyError:
        read = _cdr_readers[cls] = _compiled_reader(cls)
    try:
        if buffer[1] != 1 or buffer[0] != 0:
            read = _other_reader(cls, buffer)
        found: _T = read(buffer)
    except (struct.error, ValueError, IndexError, MemoryError, OverflowError) as error:
        raise _read_error(cls, buffer, error) from error
    return found


def to_ros1(msg: Message | Ros1Message) -> bytes:
    """Return a message's bytes in ROS 1's own serialisation.

    Raises:
        InterfaceError: a value does not fit its field; names it.
    """
    cls = msg.__class__
    if isinstance(msg, AnyMsg):
        return msg._buff or b""
    write = _ros1_writers.get(cls)
    if write is None:
        write = _ros1_writers[cls] = _compiled_writer(cls, is_cdr=False)
    try:
        return write(msg)
    except GazelleError:
        raise
    except Exception as error:
        raise _write_error(msg, error) from error


def from_ros1(cls: type[_T], buffer: bytes | bytearray | memoryview) -> _T:
    """Return the message that ROS 1's bytes hold, in the class asked for.

    Raises:
        InterfaceError: the bytes are not of this type.
    """
    read = _ros1_readers.get(cls)
    if read is None:
        read = _ros1_readers[cls] = _compiled_reader(cls, is_cdr=False)
    try:
        found: _T = read(buffer)
    except (struct.error, ValueError, IndexError, MemoryError, OverflowError) as error:
        raise _read_error(cls, buffer, error) from error
    return found


def convert(msg: Message | Ros1Message, cls: type[_T]) -> _T:
    """Return a message in another form of its type: ROS 1 ↔ ROS 2.

    Raises:
        InterfaceError: the two are not forms of one type, or a value does not fit.
    """
    if isinstance(msg, cls):
        return msg
    return from_cdr(cls, to_cdr(msg))


def _checked(cls: type[Any]) -> None:
    if getattr(cls, "TYPE_NAME", "*") == "*":
        what = "keeps the bytes of any type" if cls is AnyMsg else "is not a message class"
        raise InterfaceError(f"{cls.__name__} {what}; it has no layout of its own")


def _compiled_writer(cls: type[Any], *, is_cdr: bool = True) -> _Writer:
    _checked(cls)
    from gazelle.interfaces.binding import Wire, bind
    from gazelle.interfaces.conversion import CONVERTED
    from gazelle.interfaces.writer import compile_writer

    if is_cdr and cls.GENERATION is Generation.ROS1 and cls.TYPE_NAME in CONVERTED:
        to_wire = CONVERTED[cls.TYPE_NAME].to_wire
        return lambda msg: to_cdr(to_wire(msg))
    wire = Wire.CDR if is_cdr else Wire.ROS1
    return compile_writer(bind(cls.TYPE_NAME, cls.GENERATION, wire), wire)


def _compiled_reader(cls: type[Any], *, is_cdr: bool = True, endian: str = "<") -> _Reader:
    _checked(cls)
    from gazelle.interfaces.binding import Wire, bind
    from gazelle.interfaces.conversion import CONVERTED
    from gazelle.interfaces.reader import compile_reader

    if is_cdr and cls.GENERATION is Generation.ROS1 and cls.TYPE_NAME in CONVERTED:
        conversion = CONVERTED[cls.TYPE_NAME]
        return lambda data: conversion.from_wire(from_cdr(conversion.wire_class(), data))
    wire = Wire.CDR if is_cdr else Wire.ROS1
    return compile_reader(bind(cls.TYPE_NAME, cls.GENERATION, wire), wire, endian)


def _other_reader(cls: type[Any], buffer: bytes | bytearray | memoryview) -> _Reader:
    if buffer[0] != 0 or buffer[1] != 0:
        raise ValueError(
            f"encapsulation {buffer[0]:02x} {buffer[1]:02x} is not plain CDR (00 00 or 00 01)"
        )
    if cls not in _big_readers:
        _big_readers[cls] = _compiled_reader(cls, endian=">")
    return _big_readers[cls]


def _read_error(cls: type[Any], buffer: Any, error: Exception) -> InterfaceError:
    return InterfaceError(
        f"{len(buffer)} bytes are not a {cls.TYPE_NAME}: {error}; "
        "the sender's definition may be another one (ROS: md5sum mismatch, buffer overrun)"
    )


def _write_error(msg: Any, error: Exception) -> InterfaceError:
    from gazelle.interfaces.check import find_problem

    found = find_problem(msg)
    return InterfaceError(found or f"{msg.TYPE_NAME} cannot be written: {error}")
