"""A recorder in another process keeps the definitions that a bag is played with."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.graph.test_process_queries_requests import HOSTILE
from tests.patience import eventually, stretched

from gazelle.bag import Connection, Encoding, Storage, create_bag, open_bag
from gazelle.bag.message_definitions import TextShare, fetch_text
from gazelle.bag.playing import Controls, Player, PlayOptions
from gazelle.graph import Graph
from gazelle.interfaces import RosVersion, md5sum


def test_texts_and_unknown_types_come_from_the_player(tmp_path: Path, free_port: int) -> None:
    words = "# Of the bag.\nstring data  # words\n"
    own = "# Nobody else knows this.\nint32 count\n"
    connections = [
        Connection(
            0, "/word", "std_msgs/String", Encoding.ROS1, words, md5sum("std_msgs/String"), "/n"
        ),
        Connection(
            0, "/own", "test_only_msgs/Own", Encoding.ROS1, own,
            "602d642babe509c7c59f497c23e716a9", "/n",
        ),
    ]  # fmt: skip
    writer = create_bag(tmp_path / "in.bag", Storage.ROS1)
    for one in connections:
        added = writer.add(one)
        for place in range(3):
            writer.write(added, 10**18 + place * 10**6, b"\0\0\0\0")
    writer.close()
    topics = [one.topic for one in connections]
    command = [sys.executable, "-m", "gazelle.cli", "rosbag", "record", "-O", "out", "-l", "3"]
    environ = {**os.environ, "GAZELLE_PORT": str(free_port)}
    with Graph.open(port=free_port) as graph:
        recorder = subprocess.Popen([*command, *topics], cwd=tmp_path, env=environ)
        bag = open_bag(tmp_path / "in.bag")
        quiet = (lambda *_args: None, lambda *_args: None)
        node = graph.create_node("player")
        player = Player(node, [bag], PlayOptions(), Controls(), *quiet)
        eventually(lambda: all(one.matched for one in player.publishers))
        player.play()
        assert recorder.wait(stretched()) == 0
    found = {one.topic: one for one in open_bag(tmp_path / "out.bag").connections}
    for one in connections:
        kept = found[one.topic]
        assert (kept.type_name, kept.definition) == (one.type_name, one.definition)
        assert kept.md5sum == one.md5sum


def test_texts_of_definitions_are_asked_for_and_answered_with_anything(
    free_port: int, capsys: pytest.CaptureFixture[str]
) -> None:
    answers = iter(HOSTILE)

    def answer(query: Any) -> None:
        with query:
            query.reply(f"{space}/1/nowhere_msgs/Thing/abc", next(answers))

    with Graph.open(port=free_port) as graph, Graph.open(port=free_port, role="client") as other:
        space = f"@gazelle/{graph.domain}/definition"
        share = TextShare(graph)
        for words in ("1", "1/a/b", "3/a/b/c", "1/std_msgs/String/*/d", "²/a/b/c", "1/../x/*"):
            assert not list(other.session.get(f"{space}/{words}", timeout=5.0)), words
        share.close()
        queryable = graph.session.declare_queryable(f"{space}/**", answer, complete=True)
        for _data in HOSTILE:
            fetch_text(other, "nowhere_msgs/Thing", RosVersion.ROS1)
        queryable.undeclare()
    assert next(answers, None) is None
    assert "Traceback" not in capsys.readouterr().err
