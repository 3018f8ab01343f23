"""What a Studio does only while somebody looks, and who knows it whole."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from tests.patience import eventually
from tests.studio.page import Page

from gazelle.graph import Graph
from gazelle.studio import Server, Studio, studio


def test_time_is_followed_only_while_a_page_is_open(graph: Graph) -> None:
    graph.parameters.set("/use_sim_time", True)
    try:
        with Server(Studio(graph), port=0) as server:
            assert graph.subscription_count("/clock") == 0
            one, other = Page(server.port), Page(server.port)
            eventually(lambda: graph.subscription_count("/clock") == 1)
            one.close()
            eventually(lambda: len(server.studio.pages) == 1)
            assert graph.subscription_count("/clock") == 1
            other.close()
            eventually(lambda: graph.subscription_count("/clock") == 0)
    finally:
        graph.parameters.delete("/use_sim_time")


def test_a_page_that_comes_again_follows_time_again(
    graph: Graph, connected: Callable[..., Page], server: Server
) -> None:
    graph.parameters.set("/use_sim_time", True)
    try:
        connected().close()
        eventually(lambda: not server.studio.pages)
        connected()
        eventually(lambda: graph.subscription_count("/clock") == 1)
    finally:
        graph.parameters.delete("/use_sim_time")


def test_only_the_server_and_its_tables_know_the_whole_studio() -> None:
    folder = Path(studio.__file__).parent
    knows = re.compile(r"gazelle\.studio\.studio\b|gazelle\.studio import .*\bStudio\b")
    found = {
        str(path.relative_to(folder))
        for path in folder.rglob("*.py")
        if knows.search(path.read_text(encoding="utf-8"))
    }
    server = {"connection.py", "protocol.py", "server.py", "windows/page_owner.py"}
    assert found == {"__init__.py", *server}
