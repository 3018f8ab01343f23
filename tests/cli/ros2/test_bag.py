"""``ros2 bag``: recorded, shown, played again, converted."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.bag import Storage, cdr_connection, create_bag, open_bag
from gazelle.cli.ros2 import bag
from gazelle.graph import Graph
from gazelle.interfaces import message_type, to_cdr


def _bag(path: Path, storage: Storage = Storage.MCAP, count: int = 20) -> None:
    writer = create_bag(path, storage)
    words = writer.add(cdr_connection("/word", "std_msgs/msg/String"))
    others = writer.add(cdr_connection("/other", "std_msgs/msg/String"))
    kind = message_type("std_msgs/msg/String")
    for place in range(count):
        one = others if place % 4 == 0 else words
        writer.write(one, 10**18 + place * 50_000_000, to_cdr(kind(data=f"{place}")))
    writer.close()


@pytest.mark.parametrize("storage", [Storage.MCAP, Storage.SQLITE])
def test_info_prints_what_is_in_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], storage: Storage
) -> None:
    _bag(tmp_path / "a", storage)
    assert bag.main(["info", str(tmp_path / "a")]) == 0
    out = capsys.readouterr().out
    assert f"Storage id:        {storage}\n" in out
    assert "Duration:          0.950000000s\n" in out
    assert "Messages:          20\n" in out
    row = "Topic: /word | Type: std_msgs/msg/String | Count: 15 | Serialization Format: cdr"
    assert row in out


def test_a_folder_without_metadata_is_shown_and_reindexed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _bag(tmp_path / "a")
    (tmp_path / "a" / "metadata.yaml").unlink()
    assert bag.main(["info", str(tmp_path / "a")]) == 0
    shown = capsys.readouterr()
    assert "Messages:          20\n" in shown.out and "ros2 bag reindex" in shown.err
    assert bag.main(["reindex", str(tmp_path / "a")]) == 0
    assert open_bag(tmp_path / "a").summary.is_indexed


def test_convert_writes_what_the_file_says(tmp_path: Path) -> None:
    _bag(tmp_path / "a")
    uri = tmp_path / "b"
    (tmp_path / "o.yaml").write_text(
        f"output_bags: [{{uri: {uri}, storage_id: sqlite3, topics: [/other]}}]"
    )
    words = ["convert", "-i", str(tmp_path / "a"), "-o", str(tmp_path / "o.yaml")]
    assert bag.main(words) == 0
    found = open_bag(uri)
    assert found.storage is Storage.SQLITE
    assert {one.connection.topic for one in found.messages()} == {"/other"}


def test_convert_refuses_keys_it_does_not_know(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "o.yaml").write_text("output_bags: [{uri: b, max_bagfile_size: 5}]")
    assert bag.main(["convert", "-i", "a", "-o", str(tmp_path / "o.yaml")]) == 1
    assert "'max_bagfile_size' has no effect here" in capsys.readouterr().err


def test_wrong_words_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert bag.main(["recrd"]) == 2
    with pytest.raises(SystemExit):
        bag.main(["record"])
    err = capsys.readouterr().err
    assert "did you mean 'record'" in err
    assert "Invalid choice: Must specify topic(s) or --all-topics" in err


def test_what_is_played_is_recorded(gazelle: Callable, tmp_path: Path, free_port: int) -> None:
    _bag(tmp_path / "a")
    with Graph.open(port=free_port, environ={}) as graph:
        got: list[Any] = []
        listener = graph.create_node("listener")
        listener.create_subscription(
            "/word", "std_msgs/msg/String", lambda one: got.append((time.monotonic(), one.data))
        )
        record = gazelle("ros2", "bag", "record", "-a", "-o", "b", "-x", "/rosout")
        record.wait_for_line("Recording...")
        play = gazelle("ros2", "bag", "play", "a", "-r", "2", "-d", "2", "-m", "/other:=/new")
        assert play.wait() == 0, play.text
        record.eventually(lambda: len(got) == 15)
        record.eventually(lambda: open_bag(next((tmp_path / "b").glob("*.mcap"))).summary.messages)
        assert record.stop() == 0
    # Messages of 0.9 s at twice their rate; tests/bag/test_playing.py has that to the millisecond.
    assert got[-1][0] - got[0][0] < stretched(0.65)
    found = open_bag(tmp_path / "b")
    assert {one.topic for one in found.connections} == {"/word", "/new"}
    assert found.summary.messages == 20
