"""A recorder hears before its file can be seen."""

from __future__ import annotations

import shutil
import threading
from pathlib import Path

import pytest
from tests.patience import eventually, stretched

from gazelle.bag import BagError, open_bag
from gazelle.bag.recording import Limits, Recorder, Ros1Files, Selection
from gazelle.graph import Graph
from gazelle.interfaces import message_type

_INT = message_type("std_msgs/msg/Int32")


def test_who_waits_for_the_file_loses_no_message(tmp_path: Path, free_port: int) -> None:
    selection, stop = Selection(("/named",), every=True), threading.Event()
    with Graph.open(port=free_port) as hub, Graph.open(port=free_port, role="client") as own:
        names = ("/named", "/there")
        talker = hub.create_node("talker")
        outs = [talker.create_publisher(name, _INT) for name in names]
        assert own.discovery.wait_for(
            lambda known: {"/there"} <= {one.name for one in known}, stretched()
        )
        sink = Ros1Files(lambda: str(tmp_path / "a"))
        recorder = Recorder(own, own.create_node("recorder"), sink)
        file = tmp_path / "a.bag.active"
        assert not file.exists()
        recorder.begin(selection)
        assert file.exists() and set(recorder.topics) >= set(names)
        assert hub.discovery.wait_for(lambda _known: all(one.matched for one in outs), stretched())
        for number in range(20):
            for out in outs:
                out.publish(_INT(data=number))
        thread = threading.Thread(target=recorder.run, args=(selection, stop))
        thread.start()
        eventually(lambda: recorder.written >= 40)
        stop.set()
        thread.join()
    counts = [one.connection.topic for one in open_bag(tmp_path / "a.bag").messages()]
    assert [counts.count(name) for name in names] == [20, 20]


def test_what_is_on_its_way_when_recording_ends_is_recorded(tmp_path: Path, free_port: int) -> None:
    selection = Selection(("/named",))
    with Graph.open(port=free_port) as hub, Graph.open(port=free_port, role="client") as own:
        for turn in range(10):
            stop = threading.Event()
            sink = Ros1Files(lambda turn=turn: str(tmp_path / f"{turn}"))
            recorder = Recorder(own, own.create_node(f"recorder{turn}"), sink)
            recorder.begin(selection)
            thread = threading.Thread(target=recorder.run, args=(selection, stop))
            thread.start()
            with Graph.open(port=free_port, role="client") as other:
                out = other.create_node("talker").create_publisher("/named", _INT)
                eventually(lambda out=out: out.matched)
                for number in range(50):
                    out.publish(_INT(data=number))
            # The hub has all of it, and may not have sent it on yet.
            eventually(lambda: not any(one.node == "/talker" for one in hub.discovery.known()))
            stop.set()
            thread.join()
            assert len(list(open_bag(tmp_path / f"{turn}.bag").messages())) == 50


def test_a_file_that_cannot_be_created_is_told_at_the_beginning(
    tmp_path: Path, free_port: int
) -> None:
    with Graph.open(port=free_port) as graph:
        sink = Ros1Files(lambda: str(tmp_path / "nowhere" / "a"))
        recorder = Recorder(graph, graph.create_node("recorder"), sink)
        with pytest.raises(BagError, match="No such file or directory"):
            recorder.begin(Selection(("/named",)))


def test_a_file_that_somebody_removes_is_written_anew(tmp_path: Path, free_port: int) -> None:
    folder, said, stop = tmp_path / "runs", list[str](), threading.Event()
    folder.mkdir()
    with Graph.open(port=free_port) as hub, Graph.open(port=free_port, role="client") as own:
        out = hub.create_node("talker").create_publisher("/named", _INT)
        sink = Ros1Files(lambda: str(folder / "a"))
        say = lambda level, text: said.append(f"{level}: {text}")  # noqa: E731
        recorder = Recorder(own, own.create_node("recorder"), sink, say=say)
        selection = Selection(("/named",))
        recorder.begin(selection)
        thread = threading.Thread(target=recorder.run, args=(selection, stop))
        thread.start()
        eventually(lambda: out.matched)
        out.publish(_INT(data=1))
        eventually(lambda: recorder.written == 1)
        shutil.rmtree(folder)
        out.publish(_INT(data=2))
        text = f"warn: somebody removed the file of '{folder / 'a.bag'}'; it is written anew"
        eventually(lambda: text in said)
        shutil.rmtree(folder)
        stop.set()
        thread.join()
    # The second time at the end.
    assert said.count(text) == 2
    assert len(list(open_bag(folder / "a.bag").messages())) == 2


def test_what_finds_no_place_in_the_buffer_is_told_and_the_newest_is_recorded(
    tmp_path: Path, free_port: int
) -> None:
    selection, stop, said = Selection(("/named",)), threading.Event(), list[str]()
    with Graph.open(port=free_port) as hub, Graph.open(port=free_port, role="client") as own:
        out = hub.create_node("talker").create_publisher("/named", _INT)
        recorder = Recorder(
            own,
            own.create_node("recorder"),
            Ros1Files(lambda: str(tmp_path / "a")),
            limits=Limits(buffer=80),
            say=lambda level, text: said.append(f"{level}: {text}"),
        )
        recorder.begin(selection)
        assert hub.discovery.wait_for(lambda _known: bool(out.matched), stretched())
        # Nobody writes yet.
        for number in range(100):
            out.publish(_INT(data=number))
        eventually(lambda: recorder.dropped == 90)
        stop.set()
        recorder.run(selection, stop)
    kept = [one.data for one in open_bag(tmp_path / "a.bag").messages()]
    assert [int.from_bytes(data, "little") for data in kept] == list(range(90, 100))
    assert said[1:] == ["warn: rosbag record buffer exceeded.  Dropping oldest queued message."]
