"""Services of the graph that viewers may call."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from gazelle.bridge.foxglove.channels import SchemaBook
from gazelle.bridge.foxglove.server_interface import ServiceOffer, ServiceSide, Viewers
from gazelle.errors import GazelleError
from gazelle.graph import Entity, Kind
from gazelle.graph.names import is_hidden
from gazelle.interfaces import from_cdr, service_type, to_cdr

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Services"]

# Every node of ROS 2 has these; viewers have parameters of their own.
_OWN_OF_NODES = ("rcl_interfaces/", "type_description_interfaces/")


class Services:
    """Offers each service of the graph."""

    def __init__(self, node: Node, viewers: Viewers, book: SchemaBook) -> None:
        """Offer nothing yet.

        Args:
            node: calls.
            viewers: get the services.
            book: knows types.
        """
        self._node = node
        self._viewers = viewers
        self._book = book
        self._offered: dict[str, str] = {}

    def settle(self, entities: Iterable[Entity]) -> None:
        """Offer the services of these entities and no others."""
        wanted = {
            one.name: one.type_name
            for one in entities
            if one.kind is Kind.SERVICE
            and not is_hidden(one.name)
            and not one.type_name.startswith(_OWN_OF_NODES)
        }
        gone = [name for name, kind in self._offered.items() if wanted.get(name) != kind]
        if gone:
            self._viewers.remove_services(gone)
            self._offered = {k: v for k, v in self._offered.items() if k not in gone}
        offers = [self._offer(*one) for one in wanted.items() if one[0] not in self._offered]
        new = [one for one in offers if one is not None]
        if new:
            self._viewers.add_services(new)
            self._offered |= {one.name: one.type_name for one in new}

    def _offer(self, name: str, type_name: str) -> ServiceOffer | None:
        sides = []
        for part in ("Request", "Response"):
            side = f"{type_name}_{part}"
            schema = self._book.message(side, f"service {name}")
            if schema is None:
                return None
            sides.append(ServiceSide(side, schema))
        return ServiceOffer(name, type_name, sides[0], sides[1], self._answer(name, type_name))

    def _answer(self, name: str, type_name: str) -> Callable[[bytes], bytes]:
        kind: Any = service_type(type_name)

        def answer(data: bytes) -> bytes:
            client = self._node.create_client(name, kind)
            try:
                return to_cdr(client.call(from_cdr(kind.Request, data)))
            except GazelleError as error:
                # Viewers show the error's class too; they should see one they know.
                raise RuntimeError(str(error)) from error
            finally:
                client.unregister()

        return answer
