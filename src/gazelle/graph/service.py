"""Services: answering requests and calling others."""

from __future__ import annotations

import itertools
import threading
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import nearest_names
from gazelle.errors import GazelleError, GraphError
from gazelle.graph import type_support
from gazelle.graph.errors import (
    ServiceCallError,
    ServiceRefusedError,
    ServiceTimeoutError,
    ServiceUnavailableError,
    coded,
)
from gazelle.graph.gazebo_names import other_version_hint
from gazelle.graph.hub import hub_knows
from gazelle.graph.key_expressions import (
    Attachment,
    Entity,
    Kind,
    entity_gid,
    service_key,
    service_selector,
    token,
)
from gazelle.graph.names import is_hidden
from gazelle.graph.service_requests import Answer, AnsweredRequests, InTurn, Turn, Turns
from gazelle.process_lifetime import called_by_library

if TYPE_CHECKING:
    from gazelle.graph.graph import Graph

__all__ = ["ServiceClient", "ServiceServer"]

_ERROR_ENCODING = "text/plain;service-error"
_FOR_EVER_S = 1e6
_RETRY_S = 0.02
_SETTLING_S = 5.0
_LOOK_S = 0.3
_GONE_S = 2.0
_BACK_S = 30.0


class ServiceServer:
    """Answers one service; each request is handled in a thread of its own, as in ROS 1.

    A handler that is `InTurn` begins with one client's requests in the order in which they came.
    """

    def __init__(
        self,
        graph: Graph,
        entity: Entity,
        service_class: Any,
        handler: Callable[..., Any],
        *,
        with_caller: bool,
        on_error: Callable[[str], None],
        is_mute: bool,
    ) -> None:
        """Offer the service; use `Node.create_service`."""
        import zenoh

        self.name = entity.name
        self.service_class = service_class
        self.entity = entity
        self._graph = graph
        self._handler = handler
        self._begin = handler.begin if isinstance(handler, InTurn) else None
        self._with_caller = with_caller
        self._on_error = on_error
        self._closed = is_mute
        self._answered = AnsweredRequests()
        self._turns = Turns()
        text = token(graph.domain, entity)
        self._gid = entity_gid(text)
        self._key = service_key(graph.domain, self.name, entity.type_name, entity.type_hash)
        if is_mute:
            return
        callback = zenoh.handlers.Callback(self._on_query, None, indirect=False)
        self._queryable: Any = graph.session.declare_queryable(self._key, callback, complete=True)
        self._token = graph.announcements.announce(text)

    def unregister(self) -> None:
        """Stop answering; calling it twice does nothing."""
        if not self._closed:
            self._closed = True
            self._token.undeclare()
            self._queryable.undeclare()
            self._graph.forget(self)

    @called_by_library
    def _on_query(self, query: Any) -> None:
        asked = _attachment_of(query)
        turn = self._turns.take(asked.gid) if self._begin is not None else None
        name = f"service {self.name}"
        arguments = (query, asked, turn)
        threading.Thread(target=self._answer, args=arguments, name=name, daemon=True).start()

    def _answer(self, query: Any, asked: Attachment, turn: Turn | None) -> None:
        end_turn = turn.end if turn is not None else None
        try:
            answer, error = self._answered.answer(
                asked.gid, asked.sequence, lambda: self._handled(query, turn), on_repeat=end_turn
            )
        finally:
            if end_turn is not None:
                end_turn()
        if self._closed:
            return
        if answer:
            attachment = Attachment(asked.sequence, time.time_ns(), self._gid)
            query.reply(self._key, answer, attachment=attachment.to_bytes())
        else:
            error = error or "service cannot process request: service handler returned None"
            query.reply_err(error, encoding=_ERROR_ENCODING)
        query.drop()

    def _handled(self, query: Any, turn: Turn | None) -> Answer:
        try:
            return self._response_to(query, turn), ""
        except ServiceRefusedError as refused:
            return b"", str(refused)
        except Exception as raised:  # noqa: BLE001 - a user's handler may raise anything
            if not isinstance(raised, GazelleError):
                self._on_error(
                    f"Error processing request: {raised}\n{traceback.format_exc().rstrip()}"
                )
            return b"", f"error processing request: {raised}"

    def _response_to(self, query: Any, turn: Turn | None) -> bytes:
        """Return the response's bytes, none when the handler gave no response."""
        data = query.payload.to_bytes() if query.payload is not None else b""
        request = type_support.decode(type_support.request_type(self.service_class), data)
        arguments = (request, self._caller_of(query)) if self._with_caller else (request,)
        if self._begin is None or turn is None:
            response = self._handler(*arguments)
        else:
            with turn:
                finish = self._begin(*arguments)
            response = finish()
        if response is None:
            return b""
        wanted = type_support.response_type(self.service_class)
        if not isinstance(response, wanted):
            raise GraphError(
                f"service handler returned a {type(response).__qualname__}, "
                f"not a {wanted.__qualname__}"
            )
        return type_support.encode(response)

    def _caller_of(self, query: Any) -> str:
        entity = self._graph.entity_with_gid(_attachment_of(query).gid)
        return "" if entity is None else entity.node


class ServiceClient:
    """Calls one service."""

    def __init__(self, graph: Graph, entity: Entity, service_class: Any, *, is_mute: bool) -> None:
        """Prepare calls; use `Node.create_client`."""
        self.name = entity.name
        self.service_class = service_class
        self.entity = entity
        self._graph = graph
        self._closed = is_mute
        text = token(graph.domain, entity)
        self._gid = entity_gid(text)
        self._key = service_key(graph.domain, self.name, entity.type_name, "*")
        self._selector = service_selector(graph.domain, self.name, entity.type_name)
        self._numbers = itertools.count(1)
        self._seen_s = -_FOR_EVER_S
        self._asking: set[Any] = set()
        if is_mute:
            return
        self._token = graph.announcements.announce(text)

    @property
    def known_to_be_available(self) -> bool:
        """True when somebody is known to offer the service; the graph is not asked."""
        return self._noted(self._is_offered(self._graph.discovery.known()))

    @property
    def available(self) -> bool:
        """True when somebody offers the service."""
        return self._noted(self._graph.has_service(self.name))

    def wait_for_service(self, timeout_s: float | None = None) -> bool:
        """Wait until somebody offers the service; False when time is up first."""
        return self._noted(self._graph.wait_for_service(self.name, timeout_s))

    def call(self, request: Any, timeout_s: float | None = None) -> Any:
        """Send a request and wait for the response.

        Args:
            request: a message of the service's request class.
            timeout_s: how long to wait, None for as long as the server lives.

        Raises:
            ServiceUnavailableError: nobody offers it, or with another type.
            ServiceTimeoutError: no response in time.
            ServiceCallError: the handler failed.
        """
        return self.send(request, timeout_s)()

    def send(self, request: Any, timeout_s: float | None = None) -> Callable[[], Any]:
        """Send a request, and return a function that waits for the response; see `call`.

        Requests arrive in the order in which they were sent.
        """
        wanted = type_support.request_type(self.service_class)
        if not isinstance(request, wanted):
            raise GraphError(
                f"service [{self.name}]: the request is a {type(request).__qualname__}, "
                f"not a {wanted.__qualname__}"
            )
        payload = type_support.encode(request)
        attachment = Attachment(next(self._numbers), time.time_ns(), self._gid).to_bytes()
        deadline_s = time.monotonic() + (_FOR_EVER_S if timeout_s is None else timeout_s)
        self._noted(self._is_offered(self._graph.discovery.known()))

        def ask() -> Callable[[], Any]:
            left_s = max(deadline_s - time.monotonic(), _RETRY_S)
            return self._ask(payload, attachment, left_s)

        with self._told_errors():
            first = ask()

        def response() -> Any:
            with self._told_errors():
                return self._response(first, ask, timeout_s, deadline_s)

        return response

    def _response(
        self,
        asked: Callable[[], Any],
        ask: Callable[[], Callable[[], Any]],
        timeout_s: float | None,
        deadline_s: float,
    ) -> Any:
        """Ask until there is an answer: links are lost, and servers know what they did already."""
        lost_s = 0.0
        while True:
            asked_s = time.monotonic()
            reply = asked()
            if reply is not None:
                return self._read(reply, timeout_s)
            now_s = time.monotonic()
            was_asked = self._noted(now_s - asked_s > _SETTLING_S)
            lost_s = now_s if was_asked or not lost_s else lost_s
            if now_s > deadline_s:
                raise self._late(timeout_s)
            self._await_server(now_s - lost_s, deadline_s)
            asked = ask()

    @contextmanager
    def _told_errors(self) -> Iterator[None]:
        import zenoh

        try:
            yield
        except zenoh.ZError as error:
            # This process may leave the graph while another thread of it waits here.
            raise ServiceUnavailableError(f"service [{self.name}]: {error}") from error

    def _await_server(self, since_s: float, deadline_s: float) -> None:
        """Wait before the next question.

        Raises:
            ServiceUnavailableError: it would be of no use.
        """
        servers = self._servers()
        if self._noted(self._is_offered(servers)):
            # The announcement of a new service can overtake the service itself.
            if since_s > _SETTLING_S:
                raise self._unavailable()
            time.sleep(_RETRY_S)
            return
        was_there = not servers and time.monotonic() - self._seen_s < since_s + _BACK_S
        if not (was_there or servers or self._closed) and self._comes(deadline_s):
            return
        if not was_there or self._closed or since_s > _BACK_S:
            raise self._unavailable()
        if self._graph.discovery.wait_for(self._is_offered, _LOOK_S) or since_s < _GONE_S:
            return
        with self._graph.calls.waiting():
            is_there = hub_knows(self._graph.port, self._selector)
        if not is_there:
            raise self._unavailable()

    def _comes(self, deadline_s: float) -> bool:
        """Tell whether the service comes with what else comes to the graph just now."""
        settles = self._graph.discovery.settles
        return settles(lambda known: self._is_offered(known) or time.monotonic() > deadline_s)

    def unregister(self) -> None:
        """Give the client up, and the calls under way; calling it twice does nothing."""
        if not self._closed:
            self._closed = True
            for asking in tuple(self._asking):
                asking.cancel()
            self._token.undeclare()
            self._graph.forget(self)

    def _ask(self, payload: bytes, attachment: bytes, timeout_s: float) -> Callable[[], Any]:
        """Ask once, and return a function that waits for the reply, None when there is none."""
        import zenoh

        asking = zenoh.CancellationToken()
        self._asking.add(asking)
        try:
            # Looked at behind the line before: what is given up between them ends here.
            if self._closed:
                raise ServiceUnavailableError(f"service [{self.name}]: this client was closed")
            replies: Iterable[Any] = self._graph.session.get(
                self._key,
                payload=payload,
                attachment=attachment,
                timeout=timeout_s,
                cancellation_token=asking,
            )
        except BaseException:
            self._asking.discard(asking)
            raise

        def reply() -> Any:
            try:
                with self._graph.calls.waiting():
                    return next(iter(replies), None)
            finally:
                self._asking.discard(asking)

        return reply

    def _read(self, reply: Any, timeout_s: float | None) -> Any:
        if reply.ok is not None:
            data = reply.ok.payload.to_bytes()
            return type_support.decode(type_support.response_type(self.service_class), data)
        text = reply.err.payload.to_bytes().decode("utf-8", "replace")
        if str(reply.err.encoding) == _ERROR_ENCODING:
            raise ServiceCallError(f"service [{self.name}] responded with an error: {text}")
        if timeout_s is not None and text == "Timeout":
            raise self._late(timeout_s)
        raise ServiceCallError(f"transport error completing service call: {text}")

    def _servers(self) -> list[Entity]:
        entities = self._graph.entities()
        return [one for one in entities if one.kind is Kind.SERVICE and one.name == self.name]

    def _noted(self, is_there: bool) -> bool:
        if is_there:
            self._seen_s = time.monotonic()
        return is_there

    def _is_offered(self, entities: Iterable[Entity]) -> bool:
        wanted = (Kind.SERVICE, self.name, self.entity.type_name)
        return any((one.kind, one.name, one.type_name) == wanted for one in entities)

    def _late(self, timeout_s: float | None) -> GraphError:
        return ServiceTimeoutError(f"service [{self.name}] did not answer in {timeout_s:g} s")

    def _unavailable(self) -> GraphError:
        own, types = self.entity.type_name, {one.type_name for one in self._servers()}
        text = f"service [{self.name}] unavailable"
        if types - {own}:
            text += f": it has type {min(types - {own})}, the client wants {own}"
            text = coded("graph.type-mismatch", text)
        elif not types:
            names = {one.name for one in self._graph.services(include_hidden=True)}
            hint = other_version_hint(self.name, names)
            if not is_hidden(self.name):
                names = {name for name in names if not is_hidden(name)}
            nearest = () if hint else nearest_names(self.name, names)
            text += f"; {hint}" if hint else ""
            text += f"; did you mean {' or '.join(nearest)}?" if nearest else ""
        return ServiceUnavailableError(text)


def _attachment_of(query: Any) -> Attachment:
    attached = query.attachment
    return Attachment.from_bytes(attached.to_bytes() if attached else b"")
