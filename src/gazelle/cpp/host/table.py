"""The table of C functions that a runtime in C++ gets from this process, and those it has itself.

See ``include/common/gazelle_abi.h``. Python's threads are Python's: whatever calls in from C++
takes the interpreter's lock for as long as it is here, whatever is called there runs without it.
"""

from __future__ import annotations

import ctypes
import itertools
import json
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

from gazelle.errors import GazelleError

__all__ = ["CLOSED", "FAILED", "OK", "Core", "LeftError", "Served"]

OK, FAILED, CLOSED = 0, 1, 2
_VERSION = 1
# A message of so few bytes is copied at once: to lend it and to be told of its end takes longer.
_SMALL_BYTES = 4096

_u8p, _u64, _i64, _size = ctypes.c_void_p, ctypes.c_uint64, ctypes.c_int64, ctypes.c_size_t
_text = ctypes.c_char_p
_Sink = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p, _size)
_Call = ctypes.CFUNCTYPE(ctypes.c_int, _text, _u8p, _size, _Sink, ctypes.c_void_p)
_Publish = ctypes.CFUNCTYPE(ctypes.c_int, _u64, _u8p, _size, _i64, _i64)
_Request = ctypes.CFUNCTYPE(ctypes.c_int, _u64, _u64, _u8p, _size, ctypes.c_double, ctypes.c_int)
_Respond = ctypes.CFUNCTYPE(ctypes.c_int, _u64, ctypes.c_int, _u8p, _size)
_Log = ctypes.CFUNCTYPE(
    ctypes.c_int, _u64, ctypes.c_int, _u8p, _size, _text, _text, ctypes.c_int, _text
)
_Release = ctypes.CFUNCTYPE(None, ctypes.c_void_p)


class _Table(ctypes.Structure):
    _fields_ = (
        ("version", ctypes.c_uint32),
        ("size", ctypes.c_uint32),
        ("call", _Call),
        ("publish", _Publish),
        ("request", _Request),
        ("respond", _Respond),
        ("log", _Log),
        ("release", _Release),
    )


class Served(Protocol):
    """Who does what the table offers; numbers name ends that verbs have made."""

    def call(self, verb: str, request: dict[str, Any]) -> Any:
        """Do what a verb says."""

    def publish(self, publisher: int, data: bytes) -> None:
        """Send a message."""

    def request(
        self, client: int, call: int, data: bytes, timeout_s: float | None, *, is_waiting: bool
    ) -> None:
        """Ask a service."""

    def respond(self, request: int, data: bytes, *, is_error: bool) -> None:
        """Answer a request."""

    def log(
        self, node: int, level: int, text: str, logger: str, place: tuple[str, int, str]
    ) -> None:
        """Say something."""


class Core:
    """``libgazelle_core.so`` in this process: the table is given to it, and its functions called.

    Attributes:
        library: the library.
    """

    def __init__(self, path: Path | str) -> None:
        """Load it for good.

        Raises:
            OSError: it cannot be loaded.
        """
        self.library = ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
        self._lent: dict[int, bytes] = {}
        self._numbers = itertools.count(1)
        self._table: _Table | None = None
        library = self.library
        self._on_message = _function(
            library.gazelle_on_message,
            (_u64, _text, _size, ctypes.c_void_p, _text, _i64, _i64, _text, _text),
        )
        self._on_request = _function(
            library.gazelle_on_request,
            (_u64, _u64, _text, _size, ctypes.c_void_p, _text, _i64, _i64, _text),
        )
        self._on_response = _function(
            library.gazelle_on_response,
            (_u64, ctypes.c_int, _text, _size, ctypes.c_void_p, _i64, _i64),
        )
        self._on_clock = _function(
            library.gazelle_on_clock, (ctypes.c_int, ctypes.c_void_p, _i64, _i64)
        )
        self._on_event = _function(library.gazelle_on_event, (_u64, _text, _size))
        self.on_matched = _function(library.gazelle_on_matched, (_u64, _u64, ctypes.c_int))
        self._on_subscriber = _function(library.gazelle_on_subscriber, (_u64, _text, ctypes.c_int))
        self._on_node_shutdown = _function(library.gazelle_on_node_shutdown, (_u64, _text))
        self.on_graph_change = _function(library.gazelle_on_graph_change, ())
        self.detach = _function(library.gazelle_detach, ())

    def attach(self, served: Served) -> None:
        """Give the library the table.

        Raises:
            GazelleError: it was compiled for a table of another version.
        """
        table = _table(served, self._lent)
        self.library.gazelle_attach.argtypes = (ctypes.c_void_p,)
        if self.library.gazelle_attach(ctypes.addressof(table)) != 0:
            raise GazelleError("the runtime of C++ belongs to another version of Gazelle")
        # For good: a thread may be in one of its functions when the program ends.
        self._table = table
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(table))

    def on_message(
        self, subscription: int, data: bytes, type_name: bytes, info: tuple[int, int, bytes, bytes]
    ) -> None:
        """Hand a message over.

        Args:
            subscription: the runtime's number of it.
            data: CDR bytes.
            type_name: ``pkg/msg/Name``.
            info: number and stamp of the message, gid and node of its publisher.
        """
        sequence, stamp_ns, gid, publisher = info
        owner = self._lend(data)
        self._on_message(
            subscription, data, len(data), owner, type_name, sequence, stamp_ns, gid, publisher
        )

    def on_request(
        self, server: int, request: int, data: bytes, info: tuple[bytes, int, int, bytes]
    ) -> None:
        """Hand a request over; `info` is gid, number, stamp and node of who asks."""
        client, sequence, stamp_ns, caller = info
        owner = self._lend(data)
        self._on_request(
            server, request, data, len(data), owner, client, sequence, stamp_ns, caller
        )

    def on_response(self, call: int, status: int, data: bytes, stamp_ns: int = 0) -> None:
        """Hand a response, or the text of an error, over; see the header for the status."""
        self._on_response(call, status, data, len(data), self._lend(data), 0, stamp_ns)

    def on_clock(self, *, sim_time: bool, page: int, now_ns: int, jump_ns: int) -> None:
        """Tell of the clock; `page` is an address or 0, `jump_ns` negative for a jump."""
        self._on_clock(sim_time, page or None, now_ns, jump_ns)

    def on_subscriber(self, publisher: int, node: str, *, is_there: bool) -> None:
        """Tell a publisher of a subscriber."""
        self._on_subscriber(publisher, node.encode(), is_there)

    def on_node_shutdown(self, node: int, reason: str) -> None:
        """Tell a node that somebody has shut it down."""
        self._on_node_shutdown(node, reason.encode())

    def emit(self, listener: int, value: Any) -> None:
        """Give a value to a listener of C++, by the number that it has given."""
        data = json.dumps(value).encode()
        self._on_event(listener, data, len(data))

    def _lend(self, data: bytes) -> int | None:
        """Keep bytes until C++ gives them back; None for those that it is to copy."""
        if len(data) <= _SMALL_BYTES:
            return None
        number = next(self._numbers)
        self._lent[number] = data
        return number


def _function(function: Any, arguments: tuple[Any, ...]) -> Callable[..., None]:
    function.argtypes = arguments
    function.restype = None
    found: Callable[..., None] = function
    return found


def _table(served: Served, lent: dict[int, bytes]) -> _Table:
    string_at = ctypes.string_at

    def call(verb: bytes, data: int | None, size: int, sink: Any, context: Any) -> int:
        try:
            request = json.loads(string_at(data, size)) if data else {}
            answer = json.dumps(served.call(verb.decode(), request)).encode()
            sink(context, answer, len(answer))
        except LeftError:
            return CLOSED
        except Exception as error:  # noqa: BLE001 - nothing may be raised into C++
            text = _text_of(error)
            sink(context, text, len(text))
            return FAILED
        return OK

    def publish(publisher: int, data: int, size: int, _sequence: int, _stamp_ns: int) -> int:
        return _guarded(lambda: served.publish(publisher, string_at(data, size)))

    def request(
        client: int, call_: int, data: int, size: int, timeout_s: float, is_waiting: int
    ) -> int:
        payload = string_at(data, size)
        limit = None if timeout_s < 0 else timeout_s
        return _guarded(
            lambda: served.request(client, call_, payload, limit, is_waiting=bool(is_waiting))
        )

    def respond(request_: int, is_error: int, data: int | None, size: int) -> int:
        payload = string_at(data, size) if data else b""
        return _guarded(lambda: served.respond(request_, payload, is_error=bool(is_error)))

    def log(
        node: int,
        level: int,
        text: int,
        size: int,
        logger: bytes,
        file: bytes,
        line: int,
        function: bytes,
    ) -> int:
        said = string_at(text, size).decode("utf-8", "replace")
        place = (_decoded(file), line, _decoded(function))
        return _guarded(lambda: served.log(node, level, said, _decoded(logger), place))

    def release(owner: int) -> None:
        lent.pop(owner, None)

    return _Table(
        _VERSION,
        ctypes.sizeof(_Table),
        _Call(call),
        _Publish(publish),
        _Request(request),
        _Respond(respond),
        _Log(log),
        _Release(release),
    )


class LeftError(Exception):
    """The graph has been left."""


def _decoded(text: bytes | None) -> str:
    return text.decode("utf-8", "replace") if text else ""


def _guarded(act: Callable[[], None]) -> int:
    try:
        act()
    except LeftError:
        return CLOSED
    except Exception:  # noqa: BLE001 - nothing may be raised into C++
        traceback.print_exc()
        return FAILED
    return OK


def _text_of(error: Exception) -> bytes:
    known = isinstance(error, (GazelleError, KeyError, ValueError, OSError))
    text = str(error) if known else traceback.format_exc()
    return f"{type(error).__name__}\n{text}".encode("utf-8", "surrogateescape")
