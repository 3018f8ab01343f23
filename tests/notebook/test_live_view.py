"""A simulation that is looked at while a program steps it."""

from __future__ import annotations

import http.client
import json
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from tests.patience import eventually
from tests.studio.page import Page

from gazelle.interfaces import message_type
from gazelle.notebook import live_view
from gazelle.simulator import Simulation
from gazelle.simulator.intra_process_node import LocalNode

_CART = """<robot name="cart"><link name="world"/><link name="cart"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="world"/><child link="cart"/>
  <axis xyz="1 0 0"/><limit lower="-9" upper="9" effort="50" velocity="9"/></joint></robot>"""


@pytest.fixture
def sim() -> Iterator[Simulation]:
    """A cart on a rail."""
    with Simulation.load(_CART, world=None) as made:
        yield made


def _page(view: Any) -> Page:
    path = view.url.split("/", 3)[3].partition("?")[0]
    return Page(int(view.url.split(":")[2].split("/")[0]), path=f"/{path}ws")


def _status(view: Any) -> int:
    host, path = view.url.removeprefix("http://").split("/", 1)
    connection = http.client.HTTPConnection(host, timeout=60)
    connection.request("GET", f"/{path}")
    status = connection.getresponse().status
    connection.close()
    return status


def test_a_page_sees_what_a_program_steps(sim: Simulation) -> None:
    view = sim.view(real_time_factor=None)
    with _page(view) as page:
        scene = page.open("world.scene")
        assert scene.until(lambda items: items[-1] is not None)[-1]["models"][0]["name"] == "cart"
        stats = page.open("world.stats")
        sim.joint("slide").command_velocity(0.5)
        sim.run(seconds=2.0)
        assert stats.until(lambda value: value["sim_s"] >= 1.999)
    assert sim.joint("slide").position > 0.5


def test_what_is_looked_at_comes_to_the_same_state(sim: Simulation) -> None:
    with Simulation.load(_CART, world=None) as alone:
        for one in (alone, sim):
            one.joint("slide").command_velocity(0.5)
        alone.run(seconds=0.5)
        view = sim.view(real_time_factor=1.0)
        with _page(view):
            eventually(lambda: view.watchers == 1)
            sim.run(seconds=0.5)
        assert alone.state_hash() == sim.state_hash()


def test_a_run_keeps_real_time_only_while_somebody_looks(
    sim: Simulation, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gazelle.notebook import live_world

    slept: list[float] = []
    clock = SimpleNamespace(monotonic=lambda: sum(slept), sleep=slept.append)
    monkeypatch.setattr(live_world, "time", clock)
    view = sim.view(real_time_factor=2.0)
    sim.run(seconds=1.0)
    assert slept == []
    with _page(view):
        eventually(lambda: view.watchers == 1)
        sim.run(seconds=1.0)
    assert sum(slept) == pytest.approx(0.5, abs=1e-6)


def test_a_closed_view_lets_nobody_in_and_the_others_go_on(sim: Simulation) -> None:
    one, other = sim.view(), sim.view()
    assert (_status(one), _status(other)) == (200, 200)
    one.close()
    one.close()
    assert (_status(one), _status(other)) == (403, 200)
    assert one.watchers == 0


def test_a_simulation_that_closes_ends_its_views() -> None:
    with Simulation.load(_CART, world=None) as sim:
        view = sim.view()
        node = sim.server.node
    with pytest.raises(OSError):
        _status(view)
    assert isinstance(node, LocalNode)


def test_a_view_says_nothing_of_its_address_by_itself(sim: Simulation) -> None:
    view = sim.view()
    assert repr(view) == "<view of default, open>"
    view.close()
    assert repr(view) == "<view of default, closed>"


def test_a_page_drives_what_listens_and_hears_nothing_twice(sim: Simulation) -> None:
    heard: list[Any] = []
    float64 = message_type("std_msgs/Float64")
    sim.server.world_resources.subscription("/push", "std_msgs/Float64", heard.append)
    publisher = sim.server.world_resources.publisher("/push", "std_msgs/Float64")
    view = sim.view()
    publisher.publish(float64(data=1.0))
    sim.publish("/push", float64(data=2.0))
    graph = sim._live.server.studio.node.graph  # type: ignore[union-attr]
    other = graph.create_node("somebody", rosout=False)
    theirs = other.create_publisher("/push", float64)
    eventually(lambda: theirs.matched)
    theirs.publish(float64(data=3.0))
    eventually(lambda: len(heard) >= 3)
    assert [one.data for one in heard] == [1.0, 2.0, 3.0]
    view.close()
    other.shutdown()


class _Shell:
    """IPython's shell with a front end, as far as a view needs it."""

    def __init__(self) -> None:
        self.kernel = object()
        self.execution_count = 1
        self.shown: list[dict[str, Any]] = []
        self.after: list[Any] = []
        self.events = SimpleNamespace(register=lambda name, call: self.after.append(call))

    def display(self, bundle: dict[str, Any], **_options: Any) -> Any:
        self.shown.append(bundle)
        return SimpleNamespace(update=lambda new, raw: self.shown.append(new))


@pytest.fixture
def shell(monkeypatch: pytest.MonkeyPatch) -> _Shell:
    """A notebook."""
    made = _Shell()
    display = SimpleNamespace(display=made.display)
    ipython = SimpleNamespace(get_ipython=lambda: made, display=display)
    monkeypatch.setitem(live_view.sys.modules, "IPython", ipython)
    monkeypatch.setitem(live_view.sys.modules, "IPython.display", display)
    monkeypatch.setattr(live_view, "_NOBODY_CAME_S", 0.0)
    return made


def test_a_cell_gets_the_live_page_with_a_picture_for_later(sim: Simulation, shell: _Shell) -> None:
    view = sim.view()
    view._ipython_display_()  # type: ignore[attr-defined]
    (bundle,) = shell.shown
    assert "<script>" in bundle["text/html"]
    assert "/frame/" in bundle["text/html"]
    assert bundle["text/plain"] == "<view of default, open>"


def test_a_view_shows_once_more_in_a_later_cell(sim: Simulation, shell: _Shell) -> None:
    view = sim.view()
    shell.execution_count = 2
    view._ipython_display_()  # type: ignore[attr-defined]
    assert len(shell.shown) == 2


def test_where_no_browser_came_the_cell_shows_the_run_so_far(
    sim: Simulation, shell: _Shell
) -> None:
    sim.view()
    (after_cell,) = shell.after
    after_cell()
    assert len(shell.shown) == 1
    sim.run(seconds=0.5)
    after_cell()
    assert "srcdoc=" in shell.shown[-1]["text/html"]
    after_cell()
    assert len(shell.shown) == 2


def test_a_live_page_is_not_taken_away(sim: Simulation, shell: _Shell) -> None:
    view = sim.view()
    assert _status(view) == 200
    sim.run(seconds=0.5)
    shell.after[0]()
    assert len(shell.shown) == 1


def test_a_view_that_ends_leaves_a_replay_in_its_cell(sim: Simulation, shell: _Shell) -> None:
    view = sim.view()
    sim.joint("slide").command_velocity(0.5)
    sim.run(seconds=0.5)
    view.close()
    html = shell.shown[-1]["text/html"]
    assert 'sandbox="allow-scripts"' in html
    assert "srcdoc=" in html
    assert "/frame/" not in html


def test_a_replay_that_is_too_large_leaves_a_picture(
    sim: Simulation, shell: _Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live_view, "_MAX_REPLAY_BYTES", 10)
    view = sim.view()
    view.close()
    assert "0.000 s simulated" in shell.shown[-1]["text/html"]


@pytest.mark.slow(15)
def test_a_real_kernel_shows_a_view(tmp_path: Path) -> None:
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed")
    nbclient = pytest.importorskip("nbclient", reason="nbclient is not installed")
    pytest.importorskip("ipykernel", reason="ipykernel is not installed")
    cells = [
        f"import gazelle\nsim = gazelle.Simulation.load({_CART!r}, world=None)\nsim.view()",
        "sim.run(seconds=0.5)\nsim.plot('slide/position')",
        "sim.close()",
    ]
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    client = nbclient.NotebookClient(book, kernel_name="python3", timeout=600)
    client.execute(cwd=str(tmp_path))
    shown, plotted = (cell.outputs for cell in book.cells[:2])
    (live,) = [one for one in shown if one.output_type == "display_data"]
    assert "srcdoc=" in live.data["text/html"]
    assert live.data["text/plain"] == "<view of default, closed>"
    assert "<svg" in plotted[0].data["text/html"]
    assert "error" not in json.dumps([one.output_type for one in (*shown, *plotted)])
