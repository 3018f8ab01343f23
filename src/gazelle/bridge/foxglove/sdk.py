"""Foxglove's own WebSocket server, from the package ``foxglove-sdk``.

The server has a queue for each viewer and drops the oldest messages when it is full, so a slow
viewer holds up nobody. Its listener gets objects of the package; here they become plain values.
"""

from __future__ import annotations

import threading
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from gazelle.bridge.foxglove.parameters import plain_value
from gazelle.bridge.foxglove.server_interface import (
    Allow,
    Connections,
    Requests,
    ServiceOffer,
    ServiceSide,
)
from gazelle.errors import GraphError
from gazelle.graph.errors import coded

__all__ = ["SdkViewers"]

_NAME = "Gazelle"
_CDR, _SCHEMA = "cdr", "ros2msg"
# The server's own 1024 would be 6 GB of full HD pictures for a viewer that has stopped reading.
_WAITING = 256
_ENDING_S = 1.0
_CAPABILITIES = {
    Allow.PUBLISH: "ClientPublish",
    Allow.SERVICES: "Services",
    Allow.PARAMETERS: "Parameters",
}


class SdkViewers:
    """The viewers of one WebSocket server."""

    def __init__(
        self, requests: Requests, *, host: str, port: int, allow: Collection[Allow]
    ) -> None:
        """Start to serve.

        Args:
            requests: told what viewers ask for.
            host: address to listen on.
            port: port to listen on, 0 for any free one.
            allow: what viewers may do.

        Raises:
            GraphError: the package is missing, or the port cannot be had.
        """
        self._sdk = _package()
        self._context = self._sdk.Context()
        capability = self._sdk.websocket.Capability
        wanted = [capability.ConnectionGraph, capability.Time]
        wanted += [getattr(capability, _CAPABILITIES[one]) for one in allow]
        try:
            self._server = self._sdk.start_server(
                name=_NAME,
                host=host,
                port=port,
                context=self._context,
                capabilities=wanted,
                server_listener=_Listener(self._sdk, requests),
                asset_handler=requests.read_asset,
                supported_encodings=[_CDR, "json"],
                message_backlog_size=_WAITING,
            )
        except RuntimeError as error:
            text = f"port {port} of {host} cannot be had: {error}"
            raise GraphError(coded("bridge.foxglove-port-taken", text)) from error

    @property
    def port(self) -> int:
        """Where viewers connect."""
        return int(self._server.port)

    def add_channel(self, topic: str, type_name: str, schema: str) -> _SdkChannel:
        """Offer a topic whose type has this schema."""
        return _SdkChannel(
            self._sdk.Channel(
                topic,
                schema=self._schema(type_name, schema),
                message_encoding=_CDR,
                context=self._context,
            )
        )

    def add_services(self, offers: Iterable[ServiceOffer]) -> None:
        """Offer services."""
        self._server.add_services([self._service(one) for one in offers])

    def remove_services(self, names: Iterable[str]) -> None:
        """Offer services no more."""
        self._server.remove_services(list(names))

    def show_time(self, now_ns: int) -> None:
        """Tell the time."""
        self._server.broadcast_time(now_ns)

    def show_parameters(self, values: Mapping[str, Any]) -> None:
        """Tell values to those who follow them."""
        self._server.publish_parameter_values(_parameters(self._sdk, values))

    def show_connections(self, connections: Connections) -> None:
        """Tell who is connected to whom."""
        graph = self._sdk.ConnectionGraph()
        for topic, nodes in connections.publishers.items():
            graph.set_published_topic(topic, list(nodes))
        for topic, nodes in connections.subscribers.items():
            graph.set_subscribed_topic(topic, list(nodes))
        for service, nodes in connections.servers.items():
            graph.set_advertised_service(service, list(nodes))
        self._server.publish_connection_graph(graph)

    def close(self) -> None:
        """End all connections; a viewer that has stopped reading is not waited for."""
        ending = threading.Thread(target=self._server.stop, name="foxglove end", daemon=True)
        ending.start()
        ending.join(_ENDING_S)

    def _schema(self, type_name: str, text: str) -> Any:
        return self._sdk.Schema(name=type_name, encoding=_SCHEMA, data=text.encode())

    def _service(self, offer: ServiceOffer) -> Any:
        sdk = self._sdk.websocket

        def side(one: ServiceSide) -> Any:
            return sdk.MessageSchema(encoding=_CDR, schema=self._schema(one.type_name, one.schema))

        schema = sdk.ServiceSchema(
            offer.type_name, request=side(offer.request), response=side(offer.response)
        )
        answer = offer.answer
        return sdk.Service(offer.name, schema=schema, handler=lambda call: answer(call.payload))


class _SdkChannel:
    """A channel of the package."""

    def __init__(self, channel: Any) -> None:
        self._channel = channel
        self.number: int = channel.id()

    def send(self, data: bytes, stamp_ns: int) -> None:
        """Send CDR bytes to all who subscribe."""
        self._channel.log(data, log_time=stamp_ns)

    def close(self) -> None:
        """Take the channel off the list."""
        self._channel.close()


class _Listener:
    """What the package calls back; it looks each method up by its name."""

    def __init__(self, sdk: Any, requests: Requests) -> None:
        self._sdk = sdk
        self._requests = requests

    def on_subscribe(self, client: Any, channel: Any) -> None:
        self._requests.subscribe(client.id, channel.id)

    def on_unsubscribe(self, client: Any, channel: Any) -> None:
        self._requests.unsubscribe(client.id, channel.id)

    def on_client_advertise(self, client: Any, channel: Any) -> None:
        self._requests.advertise(
            client.id, channel.id, channel.topic, channel.schema_name, channel.encoding
        )

    def on_client_unadvertise(self, client: Any, client_channel_id: int) -> None:
        self._requests.unadvertise(client.id, client_channel_id)

    def on_message_data(self, client: Any, client_channel_id: int, data: bytes) -> None:
        self._requests.publish(client.id, client_channel_id, data)

    def on_get_parameters(
        self, client: Any, param_names: list[str], request_id: str | None = None
    ) -> list[Any]:
        return _parameters(self._sdk, self._requests.get_parameters(param_names))

    def on_set_parameters(
        self, client: Any, parameters: list[Any], request_id: str | None = None
    ) -> list[Any]:
        values = {one.name: one.get_value() for one in parameters}
        return _parameters(self._sdk, self._requests.set_parameters(values))

    def on_parameters_subscribe(self, param_names: list[str]) -> None:
        """All changes are told; the server knows who follows which."""

    def on_parameters_unsubscribe(self, param_names: list[str]) -> None:
        """See `on_parameters_subscribe`."""

    def on_connection_graph_subscribe(self) -> None:
        """The server sends what it was told last by itself."""

    def on_connection_graph_unsubscribe(self) -> None:
        """See `on_connection_graph_subscribe`."""


def _parameters(sdk: Any, values: Mapping[str, Any]) -> list[Any]:
    return [sdk.websocket.Parameter(name, value=plain_value(it)) for name, it in values.items()]


def _package() -> Any:
    try:
        import foxglove
        import foxglove.websocket
    except ImportError as error:
        text = "foxglove-sdk, which talks to the viewers, is not installed"
        raise GraphError(coded("bridge.no-foxglove-sdk", text)) from error
    return foxglove
