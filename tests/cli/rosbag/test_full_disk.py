"""A recorder whose disk is full."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually

from gazelle.bag import open_bag
from gazelle.graph import Graph
from gazelle.interfaces import message_type

resource = pytest.importorskip("resource", reason="the system limits no file sizes")
pytestmark = pytest.mark.skipif(
    not hasattr(resource, "prlimit"), reason="the system lets nobody limit other processes"
)
_MAX_BYTES = 200_000


@pytest.mark.parametrize(
    ("words", "active", "bag"),
    [
        (("rosbag", "record", "-O", "a.bag"), "a.bag.active", "a.bag.active"),
        (("ros2", "bag", "record", "-s", "mcap", "-o", "a"), "a/a_0.mcap", "a"),
        (("ros2", "bag", "record", "-s", "sqlite3", "-o", "a"), "a/a_0.db3", "a"),
    ],
    ids=["bag", "mcap", "db3"],
)
def test_a_recorder_on_a_full_disk_ends_with_the_reason_and_a_readable_bag(
    gazelle: Callable[..., Any], tmp_path: Path, free_port: int,
    words: tuple[str, ...], active: str, bag: str,
) -> None:  # fmt: skip
    kind = message_type("std_msgs/msg/String")
    file = tmp_path / active
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        out = graph.create_node("talker").create_publisher("/words", kind)
        run = gazelle(*words, "/words")
        eventually(lambda: out.matched and file.exists())
        for _ in range(10):
            out.publish(kind(data="x" * 10_000))
        # Write-ahead logs count, too.
        written = lambda: sum(one.stat().st_size for one in file.parent.glob(f"{file.name}*"))  # noqa: E731
        eventually(lambda: written() > 100_000)
        _, hard = resource.prlimit(run.popen.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(run.popen.pid, resource.RLIMIT_FSIZE, (_MAX_BYTES, hard))

        def has_ended() -> bool:
            out.publish(kind(data="x" * 10_000))
            return run.popen.poll() is not None

        eventually(has_ended)
        assert run.wait() == 1
    assert re.search(rf"Error writing to file: .*{re.escape(file.name)}: ", run.text)
    opened = open_bag(tmp_path / bag)
    assert len(list(opened.messages())) >= 10
    opened.close()
