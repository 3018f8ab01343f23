"""``gz log``."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually

from gazelle.bag import BagWriter, Storage, create_bag, ros1_connection
from gazelle.graph import Graph
from gazelle.interfaces import ros1_message_type, to_ros1
from gazelle.simulator import Simulation

Run = Callable[..., Any]


class _Row:
    """A topic of the bag and the names in it; the first one moves."""

    def __init__(self, bag: BagWriter, topic: str, kind: str, names: list[str]) -> None:
        self.names = names
        self.type = ros1_message_type(f"gazebo_msgs/{kind}")
        self.connection = bag.add(ros1_connection(f"/gazebo/{topic}", f"gazebo_msgs/{kind}"))

    def states(self, *, x_m: float, vx: float) -> bytes:
        pose, twist = (ros1_message_type(f"geometry_msgs/{one}") for one in ("Pose", "Twist"))
        message = self.type(name=self.names)
        message.pose = [pose() for _ in self.names]
        message.twist = [twist() for _ in self.names]
        for one in message.pose:
            one.orientation.w = 1.0
        message.pose[0].position.x, message.twist[0].linear.x = x_m, vx
        return to_ros1(message)


@pytest.fixture
def record(tmp_path: Path) -> str:
    """Ten states, a hundredth of a second apart, of an arm that moves and a lamp."""
    path = tmp_path / "state.bag"
    with closing(create_bag(path, Storage.ROS1)) as bag:
        rows = [
            _Row(bag, "link_states", "LinkStates", ["arm::base", "arm::bob", "lamp::foot"]),
            _Row(bag, "model_states", "ModelStates", ["arm", "lamp"]),
        ]
        for count in range(10):
            for row in rows:
                stamp_ns = 2_000_000_000 + count * 10_000_000
                bag.write(row.connection, stamp_ns, row.states(x_m=0.5 * count, vx=50.0))
    return str(path)


def states(text: str) -> list[ElementTree.Element]:
    return list(ElementTree.fromstring(f"<all>{text}</all>"))


def test_states_are_elements_of_sdf(record: str, gz: Run) -> None:
    found = states(gz("log", "-e", "-f", record).out)
    assert len(found) == 10
    last = found[-1]
    assert last.findtext("sim_time") == "2 90000000"
    assert [one.get("name") for one in last.findall("model")] == ["arm", "lamp"]
    assert last.findtext("model[@name='arm']/pose") == "4.5 0 0 0 0 0"
    assert last.findtext("model[@name='arm']/link[@name='base']/velocity") == "50 0 0 0 0 0"
    assert last.findtext("model[@name='lamp']/link[@name='foot']/pose") == "0 0 0 0 0 0"


def test_states_are_chosen_and_thinned(record: str, gz: Run) -> None:
    found = states(gz("log", "-e", "-f", record, "--filter", "a*/bob", "-z", "40").out)
    assert [one.findtext("sim_time") for one in found] == [
        "2 0", "2 30000000", "2 60000000", "2 90000000",
    ]  # fmt: skip
    assert [one.get("name") for one in found[0].iter("model")] == ["arm"]
    assert [one.get("name") for one in found[0].iter("link")] == ["bob"]


def test_states_come_one_by_one(record: str, gz: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    answers = iter(["", "q"])
    monkeypatch.setattr("builtins.input", lambda _text: next(answers))
    assert len(states(gz("log", "-s", "-f", record).out)) == 2


def test_bag_is_told_about(record: str, gz: Run) -> None:
    assert "/gazebo/model_states   10 msgs" in gz("log", "-i", "-f", record).out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("-e",), "-f FILE names the bag"),
        (("-e", "-f", "no_such.bag"), "no_such.bag"),
        (("-f", "x.bag"), "nothing to do; see gz help log"),
        (("-d", "yes"), "--record is 0 or 1, not 'yes'"),
        (("-d", "0"), "no recorder runs; gz log -d 1 starts one"),
        (("-e", "-f", "x.bag", "--filter", "a/b/c"), "--filter is MODEL or MODEL/LINK"),
    ],
)
def test_what_cannot_be_done_is_told(
    graph: Graph, gz: Run, words: tuple[str, ...], said: str
) -> None:
    found = gz("log", *words)
    assert found.code == 255
    assert said in found.err


def test_other_files_are_told(gz: Run, tmp_path: Path) -> None:
    file = tmp_path / "state.log"
    file.write_text("<?xml version='1.0'?>\n<gazebo_log>\n</gazebo_log>\n")
    assert "is a state.log of Gazebo" in gz("log", "-e", "-f", str(file)).err
    create_bag(tmp_path / "other.bag", Storage.ROS1).close()
    told = gz("log", "-e", "-f", str(tmp_path / "other.bag")).err
    assert "there is no /gazebo/model_states in" in told


def test_world_is_recorded(world: Simulation, gz: Run, tmp_path: Path) -> None:
    file = tmp_path / "run.bag"
    assert gz("log", "-d", "1", "-f", str(file)).out == (
        f"recording to {file}; gz log -d 0 stops it\n"
    )
    assert "a recorder runs already" in gz("log", "-d", "1").err

    def has_grown() -> bool:
        gz("world", "-m", "20")
        return any(one.stat().st_size > 50_000 for one in tmp_path.glob("run.bag*"))

    eventually(has_grown)
    assert gz("log", "-d", "0").code == 0
    shown = gz("log", "-e", "-f", str(file), "--filter", "arm")
    found = states(shown.out)
    assert found, shown.err
    assert found[0].findtext("model/pose") is not None


def test_no_world_is_told(graph: Graph, gz: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gazelle.cli.gz.world_link._WAIT_S", 0.05)
    found = gz("log", "-d", "1")
    assert (found.code, found.err.split(" (")[0]) == (255, "no world is running on this graph")
