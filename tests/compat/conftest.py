"""Node programs in processes of their own, on a graph that the test is part of."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests import patience

from gazelle.graph import Graph, Node


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """The graph, carried by the test."""
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield graph


@pytest.fixture
def node(graph: Graph) -> Node:
    """The test's own node."""
    return graph.create_node("test", rosout=False)


@pytest.fixture
def program(gazelle: Callable[..., Any], graph: Graph, tmp_path: Path) -> Callable[..., Any]:
    """Runs a program as launched nodes are run; it has to end with 0 and print ``fine``."""

    def run(text: str, *words: str, **environ: str) -> Any:
        file = tmp_path / "program.py"
        file.write_text(text, encoding="utf-8")
        return gazelle(str(file), *words, module="gazelle.compat.script_runner", **environ)

    return run


@pytest.fixture
def passes(program: Callable[..., Any]) -> Callable[..., Any]:
    """Runs a program of assertions to its end."""

    def run(text: str, *words: str, **environ: str) -> Any:
        done = program(text + "\nprint('fine')\n", *words, **environ)
        code = done.wait()
        assert code == 0 and "fine" in done.lines, done.text
        return done

    return run


@pytest.fixture
def eventually() -> Callable[[Callable[[], Any]], Any]:
    """Waits until a condition gives something true, and returns it."""

    return patience.eventually
