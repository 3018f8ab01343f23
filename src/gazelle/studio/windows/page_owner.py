"""One page for a graph: whoever asks for a panel first serves it, the others are its guests."""

from __future__ import annotations

import json
import os
import sys
import threading
import webbrowser
from collections.abc import Callable, Mapping
from typing import Any

from gazelle.errors import GazelleError, GraphError
from gazelle.graph import Graph, Node
from gazelle.interfaces import service_type

__all__ = [
    "SERVICE",
    "Request",
    "address_of_page",
    "is_switched_off",
    "offer",
    "open_browser",
    "page_port",
    "present",
    "say",
    "wait_while_served",
]

SERVICE = "/_gazelle/studio"
_DO = "gazelle_msgs/Do"
_ANSWER_S = 5.0
_LOOK_S = 0.5
_USUAL_GRAPH, _USUAL_PAGE = 7447, 8090
_MAX_PORT = 65_535
_SAY = Callable[[str], None]


class Request:
    """A panel that somebody wants to see.

    Attributes:
        panel: kind of panel, by its command's name: ``rqt_plot``.
        params: what it is opened with.
    """

    def __init__(self, panel: str, params: Mapping[str, Any] | None = None) -> None:
        self.panel = panel
        self.params = dict(params or {})


def is_switched_off(environ: Mapping[str, str] = os.environ) -> bool:
    """Tell whether the user wants no page (``GAZELLE_STUDIO=0``)."""
    return environ.get("GAZELLE_STUDIO", "") in ("0", "off", "false", "no")


def say(text: str) -> None:
    """Tell a person at the terminal, also where a launch file sends output to log files."""
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()


def page_port(graph: Graph) -> int:
    """Return the port of a graph's page, whoever serves it; 0 for any.

    It is as far from 8090 as the graph's port from the usual one, so graphs side by side do not
    meet.
    """
    port = _USUAL_PAGE + graph.port - _USUAL_GRAPH
    return port if 1024 < port <= _MAX_PORT else 0


def present(node: Node, request: Request, stop: threading.Event, say: _SAY) -> None:
    """Show a panel until told to stop.

    Whoever serves the page may end before the others: one of them serves it on then, at the same
    address, and the browser finds it again by itself.

    Args:
        node: of the command that shows it.
        request: what to show.
        stop: ends it.
        say: told the page's address, and what keeps it from being served.
    """
    asked = False
    while not stop.is_set():
        if node.graph.has_service(SERVICE):
            asked = asked or _ask(node, request, say)
            if asked:
                wait_while_served(node.graph, stop)
            else:
                # Who served it has just gone; somebody else may serve it by now.
                stop.wait(_LOOK_S)
            continue
        try:
            _serve(node.graph, None if asked else request, stop, say)
        except GazelleError as error:
            # Another one was faster, and can be asked in a moment.
            if not node.graph.wait_for_service(SERVICE, _ANSWER_S) and not stop.is_set():
                say(str(error))
                stop.wait()
        else:
            asked = True


def address_of_page(node: Node) -> str | None:
    """Return where the page of a node's graph is; None where nobody serves it."""
    return _call(node, {"op": "address"}) if node.graph.has_service(SERVICE) else None


def _ask(node: Node, request: Request, say: _SAY) -> bool:
    url = _call(node, {"op": "show", "panel": request.panel, "params": request.params})
    if url is not None:
        say(f"{request.panel}: {url}")
    return url is not None


def _call(node: Node, message: dict[str, Any]) -> str | None:
    """Return the address of the page that was asked; None where it does not answer."""
    kind = service_type(_DO)
    client = node.create_client(SERVICE, kind)
    try:
        answer = client.call(kind.Request(request=json.dumps(message)), _ANSWER_S)
    except GraphError:
        return None
    finally:
        client.unregister()
    return str(json.loads(answer.response)["url"])


def _serve(graph: Graph, request: Request | None, stop: threading.Event, say: _SAY) -> None:
    from gazelle.studio.server import Server
    from gazelle.studio.studio import Studio

    with Server(Studio(graph), port=page_port(graph)) as server:
        offer(server)
        if request is not None:
            server.studio.pages.show(request.panel, request.params)
            say(f"{request.panel}: {server.url}")
            open_browser(server.url)
        stop.wait()


def offer(server: Any) -> None:
    """Let commands find a server and ask it for panels."""
    studio = server.studio

    def answer(request: Any) -> Any:
        message = json.loads(request.request)
        if message["op"] == "show":
            studio.pages.show(str(message["panel"]), dict(message.get("params") or {}))
        return service_type(_DO).Response(response=json.dumps({"url": server.url}))

    studio.node.create_service(SERVICE, service_type(_DO), answer)


def open_browser(url: str) -> None:
    """Open the user's browser where a person sits before one; never fail."""
    if not sys.stdout.isatty() or os.environ.get("CI") or not _has_display():
        return
    threading.Thread(target=_open, args=(url,), daemon=True).start()


def _open(url: str) -> None:
    try:
        webbrowser.open(url)
    except (webbrowser.Error, OSError):
        # The address was printed.
        return


def _has_display() -> bool:
    if sys.platform in ("darwin", "win32"):
        return True
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "WSL_DISTRO_NAME"))


def wait_while_served(graph: Graph, stop: threading.Event) -> None:
    """Return when nobody serves the graph's page any more, or when told to stop."""
    while graph.has_service(SERVICE) and not stop.wait(_LOOK_S):
        continue
