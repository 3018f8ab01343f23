"""The square, walked by a turtle without a graph."""

from __future__ import annotations

import itertools
import math
from types import SimpleNamespace

import pytest

from gazelle.nodes.turtlesim.draw_square import Square
from gazelle.nodes.turtlesim.turtle import WORLD_M, Turtle


def _walk(turtle: Turtle, corners: int) -> list[tuple[float, float]]:
    """Return where the turtle is when it begins to turn."""
    square, places = Square(), []
    for _step in range(60_000):
        pose = SimpleNamespace(
            x=turtle.x_m,
            y=turtle.y_m,
            theta=turtle.theta_rad,
            linear_velocity=turtle.linear_x_m_s,
            angular_velocity=turtle.angular_rad_s,
        )
        command, texts = square.next(pose)
        if "Reached goal" in texts:
            places.append((turtle.x_m, turtle.y_m))
        if len(places) == 2 * corners:
            return places[::2]
        if command is not None:
            turtle.command(command[0], 0.0, command[1])
        turtle.move()
    raise AssertionError(f"only {len(places)} goals reached")


def test_square_closes_with_sides_of_about_two_metres() -> None:
    start = (WORLD_M / 2, WORLD_M / 2)
    places = [start, *_walk(Turtle.at(*start, 0.0), 4)]
    sides = [math.dist(one, other) for one, other in itertools.pairwise(places)]
    assert sides == pytest.approx([1.92] * 4, abs=0.05)
    assert math.dist(places[0], places[-1]) < 0.15


@pytest.mark.parametrize("theta", [math.pi / 2, math.pi - 0.001, -1.0])
def test_square_closes_from_any_heading(theta: float) -> None:
    start = (WORLD_M / 2, WORLD_M / 2)
    assert math.dist(start, _walk(Turtle.at(*start, theta), 4)[-1]) < 0.15


def test_goals_are_told_in_the_originals_words() -> None:
    pose = SimpleNamespace(x=1.0, y=2.0, theta=0.0, linear_velocity=0.0, angular_velocity=0.0)
    command, texts = Square().next(pose)
    assert texts == ["New goal [3.000000 2.000000, 0.000000]"]
    assert command == (1.0, 0.0)


def test_node_resets_the_turtles_and_sets_out(bench, capfd) -> None:
    bench.start("turtlesim/turtlesim_node")
    bench.call("/turtle1/teleport_absolute", "turtlesim/TeleportAbsolute", x=1.0, y=1.0)
    poses = bench.listen("/turtle1/pose", "turtlesim/msg/Pose")
    bench.start("turtlesim/draw_square")
    bench.eventually(lambda: poses and poses[-1].x > 5.6)
    assert poses[-1].y == pytest.approx(WORLD_M / 2, abs=1e-3)
    assert bench.stop() == [0, 0]
    texts = "".join(capfd.readouterr())
    assert "Resetting turtlesim." in texts
    assert "New goal [" in texts
