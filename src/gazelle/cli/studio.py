"""``gazelle studio``: the browser page on a running graph."""

from __future__ import annotations

import argparse
import contextlib
import sys
import threading
import webbrowser
from pathlib import Path

from gazelle.graph import Graph
from gazelle.process_lifetime import at_stop_signal
from gazelle.studio import Server, Studio
from gazelle.studio.windows.page_owner import (
    address_of_page,
    offer,
    page_port,
    wait_while_served,
)

__all__ = ["main"]

_LOCAL = "127.0.0.1"
_LOOK_S = 0.5


def main(argv: list[str]) -> int:
    """Run until Ctrl-C, SIGTERM or ``rosnode kill``."""
    options = _parser().parse_args(argv)
    stop = threading.Event()
    at_stop_signal(stop.set)
    with Graph.open() as graph:
        studio = Studio(graph, options.folder)
        studio.node.on_shutdown(lambda _reason: stop.set())
        if not _is_page_of_its_own(options) and _stood_by(studio, options.browser, stop):
            # Its page finds the new server by itself.
            options.browser = False
        if stop.is_set():
            studio.close()
            return 0
        _show_panels(studio, options.panel)
        first = page_port(graph)
        with Server(studio, host=options.host, port=options.port, first_port=first) as server:
            offer(server)
            print(f"Studio: {server.url}", flush=True)
            if not server.is_local:
                _warn_of_network(options.host)
            if options.browser:
                _open_browser(server.url)
            _wait(stop)
    return 0


def _is_page_of_its_own(options: argparse.Namespace) -> bool:
    """Tell whether something was asked for that a page served by another command has not."""
    return bool(
        options.panel or options.folder or options.port is not None or options.host != _LOCAL
    )


def _stood_by(studio: Studio, browser: bool, stop: threading.Event) -> bool:
    """Point to the page that another command serves, as long as it does; return if there is one."""
    url = address_of_page(studio.node)
    if url is None:
        return False
    print(f"Studio: {url}", flush=True)
    if browser:
        _open_browser(url)
    with contextlib.suppress(KeyboardInterrupt):
        wait_while_served(studio.node.graph, stop)
        return True
    stop.set()
    return True


def _warn_of_network(host: str) -> None:
    print(
        f"studio: everybody who reaches {host} and has this address steers the graph, and it goes "
        "through the network unencrypted; 'ssh -L' to a page on 127.0.0.1 keeps it to yourself",
        file=sys.stderr,
    )


def _show_panels(studio: Studio, files: list[str]) -> None:
    """Have the first page open the panels of files; they are in its menu too."""
    for file in files:
        for source in studio.shown_panels.name_file(file):
            studio.pages.show(f"plugin:{source.name}")


def _folder(text: str) -> Path:
    folder = Path(text).expanduser()
    if not folder.is_dir():
        raise argparse.ArgumentTypeError(f"there is no folder {text}")
    return folder


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle studio",
        description="Serves the page that shows worlds, robots, topics and plots of a graph.",
    )
    parser.add_argument(
        "--port",
        type=int,
        help="TCP port, 0 for any; otherwise that of the graph's page, 8090 for the usual graph",
    )
    parser.add_argument(
        "--host",
        default=_LOCAL,
        help="address to listen on; whoever has the printed URL gets in, it carries a token",
    )
    parser.add_argument(
        "--folder",
        type=_folder,
        metavar="DIR",
        help="pages write files below it and nowhere else; default: the current folder",
    )
    parser.add_argument(
        "--no-browser", dest="browser", action="store_false", help="only print the URL"
    )
    parser.add_argument(
        "--panel",
        action="append",
        default=[],
        metavar="FILE.py[:CLASS]",
        help="show a panel of your own (docs: Write a panel); may be given more than once",
    )
    return parser


def _open_browser(url: str) -> None:
    """A machine without a browser is none of our business: the URL was printed."""
    try:
        webbrowser.open(url)
    except (webbrowser.Error, OSError) as error:
        print(f"no browser could be started ({error}); open the URL yourself", file=sys.stderr)


def _wait(stop: threading.Event) -> None:
    try:
        while not stop.wait(_LOOK_S):
            pass
    except KeyboardInterrupt:
        return
