"""Recording and playing from the page."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.patience import await_change

from gazelle.bag import open_bag
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.studio.errors import StudioError
from gazelle.studio.studio import Studio

_TEXT: Any = message_type("std_msgs/String")


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield graph


@pytest.fixture
def studio(graph: Graph, tmp_path: Path) -> Iterator[Studio]:
    studio = Studio(graph, tmp_path)
    yield studio
    studio.close()


class _Ear:
    """Hears texts on a topic."""

    def __init__(self, node: Node, topic: str) -> None:
        self.heard: list[str] = []
        self._changed = threading.Condition()
        node.create_subscription(topic, _TEXT, self._take)

    def _take(self, message: Any) -> None:
        with self._changed:
            self.heard.append(message.data)
            self._changed.notify_all()

    def wait(self, wanted: Callable[[list[str]], bool]) -> list[str]:
        with self._changed:
            assert await_change(self._changed, lambda: wanted(self.heard)), self.heard
            return list(self.heard)


@pytest.fixture
def bag(studio: Studio, graph: Graph, tmp_path: Path) -> Path:
    """A hundred texts, one each 10 ms, recorded by the page's own recorder."""
    talker = graph.create_node("talker", rosout=False)
    publisher = talker.create_publisher("/words", _TEXT)
    recording = studio.bags.recording
    path = Path(recording.begin(["/words"], str(tmp_path / "said"), "bag"))
    done = threading.Event()
    for number in range(100):
        publisher.publish(_TEXT(data=str(number)))
        done.wait(0.01)
    state = recording.state()
    assert state is not None and state["topics"] == ["/words"]
    assert recording.stop() == str(path)
    talker.shutdown()
    return path


def test_recorded_bag_plays_to_its_end_and_from_the_start_again(
    studio: Studio, graph: Graph, bag: Path
) -> None:
    ear = _Ear(graph.create_node("ear", rosout=False), "/words")
    playing = studio.bags.playing
    playing.open(str(bag))
    playing.set_rate(5.0)
    for _ in range(2):
        ear.heard.clear()
        playing.play(clock=False)
        assert ear.wait(lambda heard: heard[-1:] == ["99"]) == [str(n) for n in range(100)]
    state = playing.state()
    assert state is not None
    assert state["topics"] == [{"name": "/words", "type": "std_msgs/String", "count": 100}]


def test_pause_stands_still_and_seek_shows_what_was_last(
    studio: Studio, graph: Graph, bag: Path
) -> None:
    ear = _Ear(graph.create_node("ear", rosout=False), "/words")
    playing = studio.bags.playing
    playing.open(str(bag))
    playing.play(clock=False)
    ear.wait(lambda heard: len(heard) > 5)
    playing.pause()
    state = playing.state()
    assert state is not None and state["playing"] is False
    assert state["begin_s"] < state["time_s"] < state["end_s"]
    ear.heard.clear()
    middle_s = (state["begin_s"] + state["end_s"]) / 2
    playing.seek(middle_s)
    # What was on its way when it paused may come after the clearing.
    shown = [int(one) for one in ear.wait(lambda heard: heard and int(heard[-1]) >= 35)]
    after = playing.state()
    assert after is not None and after["time_s"] == pytest.approx(middle_s)
    assert after["playing"] is False
    assert len([one for one in shown if one >= 35]) == 1 and shown[-1] <= 65


@pytest.mark.parametrize("kind", ["bag", "mcap", "db3"])
@pytest.mark.parametrize("path", ["/etc/said", "../said", "x/../../said", "link/said", "~/said"])
def test_nothing_is_recorded_beside_the_folder(
    studio: Studio, tmp_path: Path, path: str, kind: str
) -> None:
    (tmp_path / "link").symlink_to("/")
    with pytest.raises(StudioError, match=r"is not below .*, where this page may write") as caught:
        studio.bags.recording.begin(None, path, kind)
    assert "--folder" in caught.value.hint


def test_bag_that_is_there_is_not_overwritten(studio: Studio, tmp_path: Path) -> None:
    (tmp_path / "said.bag").write_bytes(b"precious")
    for name in ("said", "said.bag"):
        with pytest.raises(StudioError, match=r"said\.bag is there already"):
            studio.bags.recording.begin(None, name, "bag")
    assert (tmp_path / "said.bag").read_bytes() == b"precious"


@pytest.mark.parametrize("kind", ["mcap", "db3"])
def test_other_formats_are_recorded(studio: Studio, tmp_path: Path, kind: str) -> None:
    recording = studio.bags.recording
    path = recording.begin(None, str(tmp_path / "b"), kind)
    with pytest.raises(StudioError, match="is being recorded; stop that first"):
        recording.begin(None, str(tmp_path / "c"), kind)
    recording.stop()
    assert open_bag(path).summary.messages == 0
    with pytest.raises(StudioError, match="is there already"):
        recording.begin(None, path, kind)


def test_no_bag_is_said(studio: Studio) -> None:
    with pytest.raises(StudioError, match="no bag is open"):
        studio.bags.playing.play(clock=False)
    assert studio.bags.playing.state() is None
