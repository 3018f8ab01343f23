"""The schedule of a player, on a clock of the test's own."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.bag import Connection, Encoding
from gazelle.bag.playing import Controls, Player, PlayOptions, Timeline
from gazelle.cli import rosbag


class _Wall:
    ns = 0

    def __call__(self) -> int:
        return self.ns


def test_a_timeline_runs_at_its_rate() -> None:
    wall = _Wall()
    line = Timeline(1000, 2.0, wall)
    assert line.wait_ns(1000 + 500) == 250
    wall.ns = 100
    assert line.stamp_ns() == 1200


def test_a_held_timeline_goes_on_where_it_was() -> None:
    wall = _Wall()
    line = Timeline(0, 1.0, wall)
    wall.ns = 300
    line.hold()
    wall.ns = 900
    assert line.stamp_ns() == 300
    line.go_on()
    assert line.wait_ns(400) == 100
    line.set_rate(0.5)
    wall.ns = 1000
    assert line.stamp_ns() == 350


def test_every_step_is_taken_once() -> None:
    controls = Controls(paused=True)
    controls.step()
    controls.step()
    assert [controls.take_step() for _ in range(3)] == [True, True, False]
    controls.toggle()
    assert not controls.paused


def test_another_definition_is_told_when_a_bag_is_played(
    tmp_path: Path, free_port: int, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture
) -> None:
    from gazelle.bag import Storage, create_bag
    from gazelle.graph import Graph

    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    # A type of the test's own: what it means differs from now on in this process.
    folder = tmp_path / "played_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Word.msg").write_text("string data\n")
    from gazelle.interfaces import add_package

    add_package("played_msgs", folder.parent)
    writer = create_bag(tmp_path / "a.bag", Storage.ROS1)
    one = Connection(0, "/word", "played_msgs/Word", Encoding.ROS1, "int32 data\n", "3" * 32)
    writer.write(writer.add(one), 5, b"\1\0\0\0")
    writer.close()
    with Graph.open(port=free_port):
        monkeypatch.setattr("gazelle.cli.rosbag.at_stop_signal", lambda _stop: None)
        assert rosbag.main(["play", "-d", "0", str(tmp_path / "a.bag")]) == 0
    captured = capfd.readouterr()
    assert "[bag.other-definition]" in captured.err
    assert "Done." in captured.out


def test_bags_that_define_a_type_differently_are_played_together(
    tmp_path: Path, free_port: int
) -> None:
    from gazelle.bag import Storage, create_bag, open_bag
    from gazelle.graph import Graph
    from gazelle.interfaces import exists

    told: list[str] = []
    for name, kind, data in (("a", "int32", b"\1\0\0\0"), ("b", "int16", b"\2\0")):
        one = Connection(
            0, "/own", "torn_msgs/Own", Encoding.ROS1, f"{kind} data\n", name * 32, "/n"
        )
        writer = create_bag(tmp_path / f"{name}.bag", Storage.ROS1)
        writer.write(writer.add(one), 5, data)
        writer.close()
    bags = [open_bag(tmp_path / f"{name}.bag") for name in "ab"]
    with Graph.open(port=free_port) as graph:
        got: list[bytes] = []
        node = graph.create_node("player")
        node.create_subscription(
            "/own", None, lambda message: got.append(bytes(message.data)), raw=True, inline=True
        )
        say = (lambda _level, text: told.append(text), lambda *_args: None)
        player = Player(node, bags, PlayOptions(immediate=True), Controls(), *say)
        player.play()
        assert len(player.publishers) == 2 and told == []
    assert sorted(got) == [b"\0\1\0\0\1\0\0\0", b"\0\1\0\0\2\0"]
    assert not exists("torn_msgs/Own")
