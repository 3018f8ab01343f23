"""What zones leave of a command."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.nodes.nav2.collision_monitor.polygons import Action, Polygon, SubPolygon, guarded

_BOX = np.array([[0.3, 0.3], [0.3, -0.3], [-0.3, -0.3], [-0.3, 0.3]])
_FORWARD = (0.4, 0.0, 0.2)


def _cluster(x: float, y: float, count: int = 4) -> np.ndarray:
    return np.array([[x, y + 0.001 * number] for number in range(count)])


def _polygon(action: Action, **values: object) -> Polygon:
    return Polygon(action.name, action, outline=_BOX, **values)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("x", "y", "inside"),
    [(0.0, 0.0, True), (0.29, -0.29, True), (0.31, 0.0, False), (0.0, 0.31, False)],
)
def test_points_are_counted_inside_the_outline(x: float, y: float, inside: bool) -> None:
    assert _polygon(Action.STOP).count(np.array([[x, y]])) == inside
    assert Polygon("c", Action.STOP, radius_m=0.3).count(np.array([[x, y]])) == (
        math.hypot(x, y) < 0.3
    )


def test_an_outline_that_is_not_convex_leaves_its_bay_out() -> None:
    bay = np.array([[0, 0], [2, 0], [2, 2], [1, 0.5], [0, 2]], float)
    found = Polygon("u", Action.STOP, outline=bay).count(
        np.array([[1.0, 1.0], [0.2, 1.0], [1, 0.2]])
    )
    assert found == 2


@pytest.mark.parametrize(("count", "left"), [(3, _FORWARD), (4, (0.0, 0.0, 0.0))])
def test_stop_needs_min_points(count: int, left: tuple[float, float, float]) -> None:
    verdict = guarded(_FORWARD, [_polygon(Action.STOP)], {"scan": _cluster(0.2, 0.0, count)})
    assert verdict.velocity == left


def test_slowdown_keeps_the_direction() -> None:
    verdict = guarded(_FORWARD, [_polygon(Action.SLOWDOWN, ratio=0.3)], {"scan": _cluster(0.2, 0)})
    assert verdict.velocity == pytest.approx((0.12, 0.0, 0.06))
    assert (verdict.action, verdict.polygon) == (Action.SLOWDOWN, "SLOWDOWN")


@pytest.mark.parametrize(
    ("limits", "share"), [((0.2, 9.0), 0.5), ((9.0, 0.05), 0.25), ((0.2, 0.05), 0.25), ((9, 9), 1)]
)
def test_limit_takes_the_smaller_share(limits: tuple[float, float], share: float) -> None:
    verdict = guarded(_FORWARD, [_polygon(Action.LIMIT, limits=limits)], {"s": _cluster(0.2, 0.0)})
    assert verdict.velocity == pytest.approx([value * share for value in _FORWARD])


@pytest.mark.parametrize("wall_m", [0.5, 0.7, 0.9])
def test_approach_keeps_the_time_before_a_collision(wall_m: float) -> None:
    """0.3 m of outline lie before the robot, and 0.4 m/s leave so much time."""
    polygon = _polygon(Action.APPROACH, horizon_s=2.0, step_s=0.01)
    verdict = guarded((0.4, 0.0, 0.0), [polygon], {"scan": _cluster(wall_m, 0.0)})
    expected = 0.4 * min((wall_m - 0.3) / 0.4 / 2.0, 1.0)
    assert verdict.velocity[0] == pytest.approx(expected, abs=0.4 * 0.011 / 2.0)


def test_approach_never_reaches_the_wall() -> None:
    """Driven by what is left of a command, the outline stops before the wall."""
    polygon, x = _polygon(Action.APPROACH, horizon_s=1.2, step_s=0.1), 0.0
    for _ in range(2000):
        x += (
            0.02 * guarded((0.4, 0.0, 0.0), [polygon], {"scan": _cluster(1.0 - x, 0.0)}).velocity[0]
        )
    assert 0.6 < x <= 0.7 + 1e-9


def test_approach_sees_what_a_turn_sweeps() -> None:
    long = np.array([[0.6, 0.1], [0.6, -0.1], [-0.1, -0.1], [-0.1, 0.1]])
    polygon = Polygon("arm", Action.APPROACH, outline=long)
    points = {"scan": _cluster(0.0, 0.5)}
    assert guarded((0.0, 0.0, 1.0), [polygon], points).action is Action.APPROACH
    assert guarded((0.0, 0.0, -1.0), [polygon], points).action is Action.NONE


def test_the_slowest_zone_counts_and_stop_ends_the_search() -> None:
    slow, slower = _polygon(Action.SLOWDOWN, ratio=0.5), _polygon(Action.SLOWDOWN, ratio=0.2)
    slow.name, slower.name = "slow", "slower"
    seen = {"scan": _cluster(0.2, 0.0)}
    assert guarded(_FORWARD, [slow, slower], seen).polygon == "slower"
    assert guarded(_FORWARD, [slower, slow], seen).polygon == "slower"
    assert guarded(_FORWARD, [slow, _polygon(Action.STOP), slower], seen).polygon == "STOP"


def test_zones_may_be_off_and_look_at_some_sensors_only() -> None:
    seen = {"scan": _cluster(0.2, 0.0)}
    for polygon in (
        _polygon(Action.STOP, enabled=False),
        _polygon(Action.STOP, sources=("sonar",)),
    ):
        assert guarded(_FORWARD, [polygon], seen).velocity == _FORWARD
    assert guarded(_FORWARD, [_polygon(Action.STOP, sources=("scan",))], seen).velocity[0] == 0.0


def test_the_outline_goes_by_the_command() -> None:
    sub_polygons = (
        SubPolygon(_BOX, (0.0, 1.0), (-1.0, 1.0)),
        SubPolygon(_BOX / 3, (-1.0, 0.0), (-1.0, 1.0)),
    )
    polygon = Polygon("v", Action.STOP, sub_polygons=sub_polygons)
    seen = {"scan": _cluster(0.2, 0.0)}
    assert guarded((0.4, 0.0, 0.0), [polygon], seen).action is Action.STOP
    assert guarded((-0.4, 0.0, 0.0), [polygon], seen).action is Action.NONE
    # Beyond all bands the last outline stays.
    assert guarded((2.0, 0.0, 0.0), [polygon], seen).action is Action.NONE


@pytest.mark.parametrize(
    ("command", "held"),
    [((0.0, 0.5, 0.0), True), ((0.5, 0.0, 0.0), False), ((-0.5, 0.1, 0.0), True)],
)
def test_bands_of_holonomic_robots_have_directions(
    command: tuple[float, float, float], held: bool
) -> None:
    sub_polygon = SubPolygon(_BOX, (0.0, 1.0), (-1.0, 1.0), (1.0, -1.0), is_holonomic=True)
    assert sub_polygon.holds(command) is held
