"""Offers the topics and the service of viewers."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from gazelle.errors import GazelleError
from gazelle.simulator.viewing.broadcast import Broadcast
from gazelle.simulator.viewing.fields import Fields
from gazelle.simulator.viewing.gz_topics import GzTopics
from gazelle.simulator.viewing.requests import Requests

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["offer_views"]


def offer_views(server: WorldServer, *, is_gz: bool = False) -> None:
    """Publish ``/_gazelle/*`` while somebody looks, and answer ``/_gazelle/do``.

    A world of the new Gazebo (`is_gz`) has its statistics, clock and poses under ``/world/NAME``.

    Nothing is computed for a topic that nobody listens to.
    """
    resources = server.world_resources
    broadcast = Broadcast(server, resources)
    if is_gz:
        broadcast.tell_gz(GzTopics(server, resources))
    requests = Requests(server, broadcast.touch)

    def answer(request: Any, response: Any) -> None:
        response.response = json.dumps(_answer(requests, request.request))

    resources.service("/_gazelle/do", "gazelle_msgs/Do", answer)
    resources.on_close(broadcast.close)
    broadcast.start()


def _answer(requests: Requests, text: str) -> dict[str, Any]:
    try:
        return {"value": requests.handle(Fields.read(text))}
    except GazelleError as error:
        return {"error": {"message": str(error)}}
