"""Service, ServiceProxy and wait_for_service (rospy.impl.tcpros_service)."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from typing import Any

from gazelle.compat.rospy.exceptions import ROSException, ROSInterruptException, ServiceException
from gazelle.compat.rospy.log import logdebug, logerr
from gazelle.compat.rospy.state import STATE
from gazelle.compat.rospy.topics import message_of, warn_of_headers
from gazelle.errors import GazelleError
from gazelle.graph import ServiceRefusedError, ServiceUnavailableError
from gazelle.interfaces import Ros1Message, Ros1Service

__all__ = ["Service", "ServiceProxy", "wait_for_service"]


class Service:
    """Answers a service.

    Args:
        name: any legal name.
        service_class: service class.
        handler: takes a request; returns a response, or what a response is made of.
        buff_size: without effect: no bytes are read from a socket here.
        error_handler: told about exceptions of the handler: (exception, type, value, traceback).
    """

    def __init__(
        self,
        name: str,
        service_class: type[Ros1Service],
        handler: Callable[[Any], Any],
        buff_size: int = 65536,
        error_handler: Callable[..., Any] | None = None,
    ) -> None:
        node = STATE.require(f"Service('{name}')")
        self.resolved_name = STATE.resolved(name)
        self.service_class = service_class
        self.request_class = service_class._request_class
        self.response_class = service_class._response_class
        self.handler = handler
        self.error_handler = error_handler
        try:
            self._impl = node.create_service(name, service_class, self._answer, with_caller=True)
        except GazelleError as error:
            raise ServiceException(str(error)) from error

    def shutdown(self, reason: str = "") -> None:
        """Stop answering."""
        logdebug(f"[{self.resolved_name}].shutdown: reason [{reason}]")
        self._impl.unregister()

    def spin(self) -> None:
        """Wait until the node is shut down."""
        while not STATE.stopping.wait(0.5):
            continue
        STATE.is_over()

    def _answer(self, request: Any, caller: str) -> Any:
        request._connection_header = {
            "callerid": caller,
            "md5sum": self.service_class._md5sum,
            "service": self.resolved_name,
            "type": self.service_class._type,
        }
        try:
            return self._response(self.handler(request))
        except ServiceException as error:
            raise ServiceRefusedError(f"service cannot process request: {error}") from error
        except Exception as error:
            if self.error_handler is not None:
                self.error_handler(error, type(error), error, error.__traceback__)
            else:
                logerr(f"Error processing request: {error}\n{traceback.format_exc()}")
            raise ServiceRefusedError(f"error processing request: {error}") from error

    def _response(self, answer: Any) -> Any:
        """Make a response the way rospy does: of a dict, a list, or the value of the one field."""
        response: Any = self.response_class
        if answer is None:
            raise ServiceException("service handler returned None")
        if isinstance(answer, response):
            return answer
        if isinstance(answer, dict):
            return response(**answer)
        if isinstance(answer, list | tuple) and len(response.__slots__) != 1:
            return response(*answer)
        if len(response.__slots__) == 0:
            return response()
        if len(response.__slots__) == 1:
            single = answer
            if isinstance(answer, list | tuple) and not response._slot_types[0].endswith("]"):
                single = answer[0]
            return response(single)
        raise ServiceException(
            f"handler returned {type(answer).__name__}, which is no {response._type}"
        )


class ServiceProxy:
    """Calls a service.

    Args:
        name: any legal name.
        service_class: service class.
        persistent: accepted; every call is as quick as a persistent one of ROS.
    """

    def __init__(
        self,
        name: str,
        service_class: type[Ros1Service],
        persistent: bool = False,
        headers: dict[str, str] | None = None,
    ) -> None:
        warn_of_headers(headers)
        self.resolved_name = STATE.resolved(name)
        self.service_class = service_class
        self.request_class = service_class._request_class
        self.response_class = service_class._response_class
        self._client: Any = None
        self._name = name

    def __call__(self, *args: Any, **kwds: Any) -> Any:
        """Call the service with a request or the values of one."""
        return self.call(*args, **kwds)

    def call(self, *args: Any, **kwds: Any) -> Any:
        """Call the service and return its response.

        Raises:
            TypeError: the arguments make no request.
            ServiceException: there is no such service, it failed, or the node is shut down.
            ROSInterruptException: the node was shut down meanwhile.
        """
        request = self._request(args, kwds)
        if STATE.stopping.is_set():
            raise ServiceException(f"service [{self.resolved_name}] returned no response")
        try:
            return self._connected().call(request)
        except GazelleError as error:
            if STATE.is_over():
                raise ROSInterruptException("node shutdown interrupted service call") from error
            if isinstance(error, ServiceUnavailableError):
                raise ServiceException(f"service [{self.resolved_name}] unavailable") from error
            raise ServiceException(str(error)) from error

    def wait_for_service(self, timeout: float | None = None) -> None:
        """Wait until the service is there; see `wait_for_service`."""
        wait_for_service(self._name, timeout)

    def close(self) -> None:
        """Give the connection back."""
        if self._client is not None:
            self._client.unregister()
            self._client = None

    def _request(self, args: tuple[Any, ...], kwds: dict[str, Any]) -> Ros1Message:
        return message_of(self.request_class, args, kwds)

    def _connected(self) -> Any:
        if self._client is None:
            if STATE.node is None:
                # rospy lets a program call services without being a node.
                STATE.init(
                    "rospy_service_proxy",
                    None,
                    anonymous=True,
                    log_level=None,
                    disable_rostime=False,
                    disable_rosout=True,
                    disable_signals=True,
                )
            node = STATE.require(f"ServiceProxy('{self._name}')")
            self._client = node.create_client(self._name, self.service_class)
        return self._client


def wait_for_service(service: str, timeout: Any = None) -> None:
    """Wait until somebody offers a service.

    Args:
        service: any legal name.
        timeout: seconds, or a Duration; None waits for ever.

    Raises:
        ValueError: the timeout is zero.
        ROSException: time is up.
        ROSInterruptException: the node was shut down meanwhile.
    """
    seconds = timeout.to_sec() if hasattr(timeout, "to_sec") else timeout
    if seconds == 0.0:
        raise ValueError("timeout must be non-zero")
    name = STATE.resolved(service)
    graph = STATE.open_graph()
    waited_s = 0.0
    while seconds is None or waited_s < seconds:
        STATE.check_running()
        slice_s = 0.5 if seconds is None else min(0.5, seconds - waited_s)
        if graph.wait_for_service(name, slice_s):
            return
        waited_s += slice_s
    STATE.check_running()
    if not graph.has_service(name):
        raise ROSException(f"timeout exceeded while waiting for service {name}")
