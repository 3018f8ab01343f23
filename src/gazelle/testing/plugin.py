"""Fixtures for pytest: launches, graphs and simulations of robot packages.

pytest loads this module in every run where Gazelle is installed, so it imports nothing but pytest;
what fixtures need comes when they are used.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Generator, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import pytest

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.simulator import Simulation
    from gazelle.testing.launch import Launch

__all__ = ["gazelle_graph", "gazelle_launch", "gazelle_simulation"]

# Launch tests of ROS 2.
pytest_plugins = ("gazelle.testing.launch_testing_plugin",)

_MARKER = "gazelle"
_MAX_LINES = 200
_LAUNCHES = "gazelle.testing.launch"


class _Options(NamedTuple):
    """What ``@pytest.mark.gazelle(…)`` may say."""

    seed: int = 0
    port: int | None = None
    timeout_s: float = 60.0


def pytest_configure(config: pytest.Config) -> None:
    """Make the marker known."""
    config.addinivalue_line(
        "markers",
        "gazelle(seed=0, port=None, timeout_s=60): seed of all noise, port of the graph (a free "
        "one), patience of waits",
    )


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Add what launches have written to the report of a test that fails while they run."""
    report = yield
    launches = sys.modules.get(_LAUNCHES)
    if report.failed and launches is not None:
        for one in launches.running():
            lines = one.output.splitlines()
            left_out = len(lines) - _MAX_LINES
            head = [f"… {left_out} lines before"] if left_out > 0 else []
            report.sections.append((one.title, "\n".join([*head, *lines[-_MAX_LINES:]])))
    return report


@pytest.fixture
def gazelle_graph(request: pytest.FixtureRequest) -> Iterator[Graph]:
    """A graph of the test's own, carried by this process."""
    from gazelle.testing import open_graph

    with open_graph(_options(request).port) as graph:
        yield graph


@pytest.fixture
def gazelle_launch(
    request: pytest.FixtureRequest, gazelle_graph: Graph, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Callable[..., Launch]]:
    """Starts launch files: ``gazelle_launch("PACKAGE", "FILE.launch", args={…})``.

    Takes what `gazelle.testing.launched` takes. The workspace is that of the test's file. All
    launches of a test are on one graph, and all their processes end with it.
    """
    from gazelle.testing import launched

    options = _options(request)
    with contextlib.ExitStack() as stack:

        def run(*words: str, **given: Any) -> Launch:
            given.setdefault("cwd", request.path.parent)
            given.setdefault("home", tmp_path_factory.mktemp("ros_home"))
            given.setdefault("seed", options.seed)
            given.setdefault("timeout_s", options.timeout_s)
            return stack.enter_context(launched(*words, graph=gazelle_graph, **given))

        yield run


@pytest.fixture
def gazelle_simulation(request: pytest.FixtureRequest) -> Iterator[Callable[..., Simulation]]:
    """Loads simulations into this process: ``gazelle_simulation("robot.urdf", world="empty")``.

    Takes what `gazelle.Simulation.load` takes. The workspace is that of the test's file.
    """
    from gazelle.simulator import Simulation
    from gazelle.workspace import Workspace

    seed = _options(request).seed
    with contextlib.ExitStack() as stack:

        def load(source: Any = None, **given: Any) -> Simulation:
            if "workspace" not in given:
                given["workspace"] = Workspace.discover(cwd=request.path.parent)
            given.setdefault("seed", seed)
            return stack.enter_context(Simulation.load(source, **given))

        yield load


def _options(request: pytest.FixtureRequest) -> _Options:
    """Read the marker.

    Raises:
        pytest.UsageError: it has an option that does not exist.
    """
    values: dict[str, Any] = {}
    for mark in reversed(list(request.node.iter_markers(_MARKER))):
        unknown = [*map(repr, mark.args), *(set(mark.kwargs) - set(_Options._fields))]
        if unknown:
            raise pytest.UsageError(
                f"@pytest.mark.gazelle has no option {', '.join(sorted(unknown))}; it takes "
                f"{', '.join(f'{name}=…' for name in _Options._fields)}"
            )
        values.update(mark.kwargs)
    return _Options(**values)
