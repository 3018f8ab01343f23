"""How turtles move: circles, walls, teleports, headings."""

from __future__ import annotations

import math

import pytest

from gazelle.nodes.turtlesim.turtle import (
    METER_PX,
    PERIOD_S,
    WORLD_M,
    Pen,
    Teleport,
    Turtle,
    normalized,
    single,
)


def _drive(turtle: Turtle, seconds: float, linear: float, angular: float) -> list[tuple]:
    places = []
    for _step in range(round(seconds / PERIOD_S)):
        turtle.command(linear, 0.0, angular)
        turtle.move()
        places.append((turtle.x_m, turtle.y_m))
    return places


def test_world_is_499_pixels_of_45_to_the_metre() -> None:
    assert f"{WORLD_M:.6f}" == "11.088889"
    assert f"{single(WORLD_M / 2):f}" == "5.544445"


def test_turtle_goes_round_a_circle_of_radius_v_over_omega() -> None:
    turtle = Turtle.at(5.5, 5.5, 0.0)
    places = _drive(turtle, 2 * math.pi / 1.8, 2.0, 1.8)
    centre = (5.5, 5.5 + 2.0 / 1.8)
    radii = [math.dist(centre, place) for place in places]
    # Euler's steps go a little outwards of the true circle.
    assert radii == pytest.approx([2.0 / 1.8] * len(radii), rel=0.02)
    assert places[-1] == pytest.approx((5.5, 5.5), abs=0.05)


def test_command_holds_for_one_second() -> None:
    turtle = Turtle.at(1.0, 1.0, 0.0)
    turtle.command(1.0, 0.0, 0.0)
    for _step in range(200):
        turtle.move()
    assert turtle.x_m == pytest.approx(1.0 + 1.0, abs=2 * PERIOD_S)
    assert turtle.linear_x_m_s == 0.0


@pytest.mark.parametrize(
    ("theta", "place", "hit"),
    [
        (0.0, (WORLD_M, 5.0), lambda x, y: x > WORLD_M),
        (math.pi, (0.0, 5.0), lambda x, y: x < 0),
        (math.pi / 2, (5.0, WORLD_M), lambda x, y: y < 0),
        (-math.pi / 2, (5.0, 0.0), lambda x, y: y > WORLD_M),
    ],
)
def test_wall_stops_the_turtle_and_tells_where_it_would_be(theta, place, hit) -> None:
    turtle = Turtle.at(5.0, 5.0, theta)
    beyond = None
    for _step in range(300):
        turtle.command(5.0, 0.0, 0.0)
        _strokes, beyond = turtle.move()
    assert (turtle.x_m, turtle.y_m) == pytest.approx(place, abs=1e-5)
    assert beyond is not None
    assert hit(*beyond)


def test_heading_stays_between_minus_pi_and_pi() -> None:
    turtle = Turtle.at(5.0, 5.0, 3.1)
    _drive(turtle, 1.0, 0.0, 1.0)
    assert turtle.theta_rad == pytest.approx(4.1 - 2 * math.pi, abs=0.02)
    assert normalized(3 * math.pi) == pytest.approx(-math.pi)


def test_relative_teleport_turns_first_and_then_goes() -> None:
    turtle = Turtle.at(2.0, 2.0, 0.0)
    turtle.teleport(Teleport(math.pi / 2, linear_m=1.5, is_relative=True))
    (stroke,) = turtle.jump()
    assert (turtle.x_m, turtle.y_m) == pytest.approx((2.0, 3.5), abs=1e-6)
    assert stroke.end_px[1] - stroke.start_px[1] == pytest.approx(-1.5 * METER_PX)
    assert turtle.jump() == []


def test_teleport_beyond_the_wall_ends_at_it_with_the_next_step() -> None:
    turtle = Turtle.at(2.0, 2.0, 0.0)
    turtle.teleport(Teleport(1.0, 20.0, 20.0))
    turtle.jump()
    _strokes, beyond = turtle.move()
    assert beyond == (20.0, 0.0)
    assert (turtle.x_m, turtle.y_m) == (WORLD_M, WORLD_M)


def test_pen_that_is_off_draws_nothing() -> None:
    turtle = Turtle.at(2.0, 2.0, 0.0)
    turtle.pen = Pen(is_on=False)
    turtle.teleport(Teleport(0.0, 4.0, 4.0))
    assert turtle.jump() == []
    turtle.command(1.0, 0.0, 0.0)
    assert turtle.move()[0] == []


def test_sideways_velocity_moves_to_the_left() -> None:
    turtle = Turtle.at(2.0, 2.0, 0.0)
    turtle.command(0.0, 1.0, 0.0)
    turtle.move()
    assert (turtle.x_m, turtle.y_m) == pytest.approx((2.0, 2.0 + PERIOD_S), abs=1e-6)


@pytest.mark.parametrize(("heading", "speed"), [(2.0, 1.0), (-2.0, -1.0)])
def test_turning_to_a_heading_goes_the_short_way_and_stops_near_it(heading, speed) -> None:
    turtle, reached = Turtle.at(5.0, 5.0, 0.0), False
    steps = 0
    while not reached:
        _remaining, reached = turtle.turn_towards(heading)
        if steps == 0:
            assert turtle.angular_rad_s == speed
        turtle.move()
        steps += 1
    assert turtle.theta_rad == pytest.approx(heading, abs=0.02)
    assert steps * PERIOD_S == pytest.approx(2.0, abs=0.05)
