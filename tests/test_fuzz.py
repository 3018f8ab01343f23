"""Damaged files end in findings, never in a crash: the same ones every time.

`benchmarks/soak/fuzz.py` reads a million of them.
"""

from __future__ import annotations

import socket
import struct
import threading
import tracemalloc
from pathlib import Path

import pytest
from tests.fuzzing.guided import reached, read_guided
from tests.fuzzing.kinds import KINDS, SCOUT
from tests.fuzzing.mutations import damaged
from tests.fuzzing.run import is_error, read_damaged, read_one

from gazelle.bridge.ros1.tcpros import read_frame
from gazelle.graph.key_expressions import Entity
from gazelle.workspace import Workspace

COUNT = 35
# The machine may be busy and the first file of a kind imports what it needs.
PATIENCE_S = 30.0
# What is damaged there is left out or shown as something else, as the originals do.
LENIENT = {
    "cdr_grid", "cmake_lists", "material", "mcap", "mcap_lz4", "mcap_zstd", "model_config",
    "qt_form", "setup", "setup_cfg", "texture_jpeg", "texture_png", "texture_tga", "texture_tiff",
    "urdfdom",
}  # fmt: skip
CORPUS = Path(__file__).parent / "fuzz_corpus"


@pytest.mark.parametrize("name", KINDS)
def test_damaged_files_end_in_findings(name: str, tmp_path: Path) -> None:
    outcome = read_damaged(KINDS[name], range(COUNT), tmp_path, most_s=PATIENCE_S)
    assert not outcome.crashes
    assert outcome.refused > COUNT // 10 or name in LENIENT


@pytest.mark.parametrize("name", KINDS)
def test_undamaged_files_are_read(name: str, tmp_path: Path) -> None:
    workspace = Workspace.discover(extra=[SCOUT])
    found = read_one(KINDS[name], KINDS[name].good(), tmp_path, workspace)
    assert not [line for line in found if is_error(line) or line.startswith("crash")]


@pytest.mark.parametrize(
    "path", sorted(CORPUS.glob("*/*")), ids=lambda path: f"{path.parent.name}-{path.name}"
)
def test_files_that_once_crashed_end_in_findings(path: Path, tmp_path: Path) -> None:
    workspace = Workspace.discover(extra=[SCOUT])
    found = read_one(KINDS[path.parent.name], path.read_bytes(), tmp_path, workspace)
    assert any(map(is_error, found)) or path.parent.name in LENIENT, found
    assert not [line for line in found if line.startswith("crash")]


@pytest.mark.parametrize(
    ("name", "number"),
    [("bag", 260), ("db3", 1), ("db3", 14), ("db3", 86), ("db3", 94), ("mcap", 16), ("mcap", 283),
     ("mcap_lz4", 302), ("pose_graph", 5), ("pose_graph", 176), ("rviz", 76), ("rviz_ros2", 87),
     ("texture_png", 3), ("texture_png", 6), ("texture_tiff", 22)],
)  # fmt: skip
def test_damage_that_once_crashed_ends_in_findings(name: str, number: int, tmp_path: Path) -> None:
    outcome = read_damaged(KINDS[name], [number], tmp_path, most_s=PATIENCE_S)
    assert not outcome.crashes


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("cmake_lists", "foreach(a x)\n" * 300 + "endforeach()\n" * 300),
        ("cmake_lists", "foreach(a 1 2 3 4 5 6 7 8 9)\n" * 9 + "endforeach()\n" * 9),
        ("setup", "x = " + " + ".join(["1"] * 900)),
    ],
    ids=["deep blocks", "endless loops", "long sum"],
)
def test_nesting_of_builds_has_an_end(name: str, text: str, tmp_path: Path) -> None:
    workspace = Workspace.discover(extra=[SCOUT])
    assert read_one(KINDS[name], text.encode(), tmp_path, workspace) == []


def test_a_stream_of_ros_1_takes_no_more_memory_than_it_sends() -> None:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        theirs.sendall(struct.pack("<I", 1 << 29) + b"no more")
        theirs.shutdown(socket.SHUT_WR)
        tracemalloc.start()
        with pytest.raises(ConnectionError):
            read_frame(ours)
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    assert most < 1 << 26


def test_a_long_frame_of_ros_1_comes_whole() -> None:
    data = bytes(range(256)) * (160 << 10)
    ours, theirs = socket.socketpair()
    with ours, theirs:
        sender = threading.Thread(
            target=theirs.sendall, args=(struct.pack("<I", len(data)) + data,)
        )
        sender.start()
        assert read_frame(ours) == data
        sender.join()


def test_what_reaches_new_lines_is_damaged_further(tmp_path: Path) -> None:
    first, again = (
        read_guided(KINDS["graph_token"], range(COUNT), tmp_path, most_s=PATIENCE_S)
        for _ in range(2)
    )
    assert not first.crashes
    assert (first.files, first.refused) == (COUNT, again.refused)


def test_lines_that_are_reached_are_known() -> None:
    lines = reached(lambda: Entity.from_token("a"))
    assert lines
    assert {Path(file).name for file, _ in lines} == {"key_expressions.py"}


def test_lines_that_other_threads_reach_are_not_counted() -> None:
    def elsewhere() -> None:
        thread = threading.Thread(target=Entity.from_token, args=("a",))
        thread.start()
        thread.join()

    alone = reached(lambda: Entity.from_token("a"))
    assert reached(elsewhere) == set()

    def both() -> None:
        elsewhere()
        Entity.from_token("a")

    assert reached(both) == alone


def test_damage_is_the_same_every_time() -> None:
    good = KINDS["urdf"].good()
    assert [damaged(good, number) for number in range(20)] == [
        damaged(good, number) for number in range(20)
    ]
