"""Costmaps made of layers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.navigation.costmap import (
    CostmapOptions,
    Footprint,
    InflationLayer,
    InflationOptions,
    Layer,
    LayeredCostmap,
    Observation,
    ObstacleLayer,
    ObstacleOptions,
    SourceOptions,
    StaticLayer,
    StaticOptions,
    VoxelOptions,
    Window,
    costs_of_map,
    observation_of_scan,
)

_SMALL = Footprint.of_radius(0.1)
_HERE = (0.0, 0.0, 0.0)
_S = 1_000_000_000


def _room(cells: int = 100) -> OccupancyGrid:
    """A square room with walls, 5 m wide, (0, 0) in its middle."""
    occupancy = np.zeros((cells, cells), np.int8)
    occupancy[[0, -1]] = 100
    occupancy[:, [0, -1]] = 100
    half = cells * 0.05 / 2
    return OccupancyGrid(occupancy, 0.05, (-half, -half, 0.0))


def _source(**options: object) -> dict[str, SourceOptions]:
    return {"scan": SourceOptions(topic="scan", **{"clearing": True, **options})}  # type: ignore[arg-type]


def _obstacles(sources: dict[str, SourceOptions] | None = None, **options: object) -> ObstacleLayer:
    return ObstacleLayer(
        ObstacleOptions(footprint_clearing_enabled=False, **options),  # type: ignore[arg-type]
        sources or _source(),
    )


def _rolling(*layers: ObstacleLayer | InflationLayer | StaticLayer) -> LayeredCostmap:
    options = CostmapOptions(rolling_window=True, width=3.0, height=3.0, resolution=0.05)
    return LayeredCostmap(options, layers, _SMALL)


def _seen(*points: tuple[float, ...], stamp_ns: int = 0) -> Observation:
    held = np.array([(*point, 0.1)[:3] for point in points]).reshape(-1, 3)
    return Observation(stamp_ns, (0.0, 0.0, 0.1), held)


def test_static_map_gives_size_place_and_costs() -> None:
    costmap = LayeredCostmap(CostmapOptions(), [StaticLayer(StaticOptions())], _SMALL)
    costmap.set_static_map(_room())
    assert costmap.update(_HERE, 0) == Window(0, 0, 100, 100)
    assert costmap.grid.origin == (-2.5, -2.5)
    assert costmap.grid.cost_at(0.0, 0.0) == 0
    assert costmap.grid.cost_at(2.49, 0.0) == 254


def test_nothing_is_written_when_nothing_has_changed() -> None:
    costmap = LayeredCostmap(CostmapOptions(), [StaticLayer(StaticOptions())], _SMALL)
    costmap.set_static_map(_room())
    costmap.update(_HERE, 0)
    assert costmap.update(_HERE, _S) is None


@pytest.mark.parametrize(
    ("options", "want"),
    [
        (StaticOptions(), [255, 0, 0, 254]),
        (StaticOptions(track_unknown_space=False), [0, 0, 0, 254]),
        (StaticOptions(lethal_cost_threshold=50), [255, 0, 254, 254]),
        (StaticOptions(trinary_costmap=False), [255, 0, 127, 254]),
        (StaticOptions(unknown_cost_value=50), [254, 0, 255, 254]),
    ],
)
def test_occupancy_becomes_cost(options: StaticOptions, want: list[int]) -> None:
    grid = OccupancyGrid(np.array([[-1, 0, 50, 100]], np.int8), 0.05)
    np.testing.assert_array_equal(costs_of_map(grid, options)[0], want)


def test_a_changed_part_of_the_map_is_the_window() -> None:
    layer = StaticLayer(StaticOptions(subscribe_to_updates=True))
    costmap = LayeredCostmap(CostmapOptions(), [layer], _SMALL)
    costmap.set_static_map(_room())
    costmap.update(_HERE, 0)
    costmap.update_static_map(50, 60, np.full((2, 3), 100, np.int8))
    assert costmap.update(_HERE, 0) == Window(50, 60, 53, 62)
    assert (costmap.grid.costs[60:62, 50:53] == 254).all()


def test_first_map_only_keeps_the_first_one() -> None:
    costmap = LayeredCostmap(
        CostmapOptions(), [StaticLayer(StaticOptions(first_map_only=True))], _SMALL
    )
    costmap.set_static_map(_room())
    costmap.set_static_map(_room(20))
    assert costmap.grid.costs.shape == (100, 100)


def test_points_mark_and_rays_clear() -> None:
    costmap = _rolling(_obstacles())
    costmap.observe("scan", _seen((1.0, 0.0)))
    costmap.update(_HERE, 0)
    assert costmap.grid.cost_at(1.01, 0.01) == 254
    costmap.observe("scan", _seen((1.2, 0.0), stamp_ns=1))
    costmap.update(_HERE, 0)
    assert costmap.grid.cost_at(1.01, 0.01) == 0
    assert costmap.grid.cost_at(1.21, 0.01) == 254


def test_only_the_window_of_rays_is_written() -> None:
    costmap = LayeredCostmap(CostmapOptions(), [StaticLayer(StaticOptions()), _obstacles()], _SMALL)
    costmap.set_static_map(_room())
    costmap.update(_HERE, 0)
    costmap.observe("scan", _seen((1.0, 0.0), (0.0, 0.5)))
    window = costmap.update(_HERE, 0)
    assert window is not None
    assert window == Window(50, 50, 71, 61)


def test_window_grows_by_the_inflation_radius() -> None:
    layers: list[Layer] = [
        StaticLayer(StaticOptions()),
        _obstacles(),
        InflationLayer(InflationOptions()),
    ]
    costmap = LayeredCostmap(CostmapOptions(), layers, _SMALL)
    costmap.set_static_map(_room())
    costmap.update(_HERE, 0)
    costmap.observe("scan", _seen((1.0, 0.0), (0.0, 0.5)))
    assert costmap.update(_HERE, 0) == Window(39, 39, 82, 72)


@pytest.mark.parametrize("seed", range(5))
def test_windows_amount_to_the_whole(seed: int) -> None:
    """Law: after any sequence of windows the costs are those of one full update."""
    rng = np.random.default_rng(seed)
    obstacles = _obstacles()
    layers: list[Layer] = [
        StaticLayer(StaticOptions()),
        obstacles,
        InflationLayer(InflationOptions()),
    ]
    costmap = LayeredCostmap(CostmapOptions(), layers, _SMALL)
    costmap.set_static_map(_room())
    for step in range(10):
        points = rng.uniform(-2.3, 2.3, (30, 2))
        costmap.observe("scan", _seen(*map(tuple, points), stamp_ns=step))
        costmap.update(_HERE, step)
    held = costmap.grid.costs.copy()
    costmap._all = True
    costmap.update(_HERE, 10)
    np.testing.assert_array_equal(costmap.grid.costs, held)


def test_what_is_out_of_range_neither_marks_nor_is_cleared_to() -> None:
    costmap = _rolling(_obstacles(_source(obstacle_range=0.8, raytrace_range=0.5)))
    costmap.observe("scan", _seen((1.0, 0.0)))
    costmap.update(_HERE, 0)
    assert not costmap.grid.costs.any()
    costmap.observe("scan", _seen((0.7, 0.0)))
    costmap.update(_HERE, 0)
    costmap.observe("scan", _seen((1.2, 0.0)))
    costmap.update(_HERE, 0)
    assert costmap.grid.cost_at(0.71, 0.01) == 254


@pytest.mark.parametrize(
    ("layer", "z", "marks"),
    [
        (ObstacleOptions(), 0.1, True),
        (ObstacleOptions(), 2.5, False),
        (ObstacleOptions(min_obstacle_height=0.3), 0.1, False),
        (VoxelOptions(z_voxels=4, z_resolution=0.1), 0.39, True),
        (VoxelOptions(z_voxels=4, z_resolution=0.1), 0.5, False),
        (VoxelOptions(origin_z=0.2), 0.1, False),
    ],
)
def test_height_says_what_counts(layer: ObstacleOptions, z: float, marks: bool) -> None:
    costmap = _rolling(ObstacleLayer(layer, _source()))
    costmap.observe("scan", _seen((1.0, 0.0, z)))
    costmap.update(_HERE, 0)
    assert (costmap.grid.cost_at(1.01, 0.01) == 254) == marks


def test_observations_expire_by_persistence() -> None:
    layer = _obstacles(_source(observation_persistence=0.5, clearing=False))
    costmap = _rolling(layer)
    costmap.observe("scan", _seen((1.0, 0.0)))
    costmap.update(_HERE, 0)
    costmap.reset()
    costmap.observe("scan", _seen((0.5, 0.0), stamp_ns=0))
    costmap.update(_HERE, _S)
    assert costmap.grid.cost_at(0.51, 0.01) == 0


def test_robot_stands_on_free_ground() -> None:
    layer = ObstacleLayer(ObstacleOptions(), _source())
    costmap = _rolling(layer)
    costmap.observe("scan", _seen((0.05, 0.0), (1.0, 0.0)))
    costmap.update(_HERE, 0)
    assert costmap.grid.cost_at(0.05, 0.01) == 0
    assert costmap.grid.cost_at(1.01, 0.01) == 254


def test_unknown_space_is_seen_free_along_rays() -> None:
    options = CostmapOptions(
        rolling_window=True, width=3.0, height=3.0, resolution=0.05, track_unknown_space=True
    )
    costmap = LayeredCostmap(options, [_obstacles(track_unknown_space=True)], _SMALL)
    costmap.observe("scan", _seen((1.0, 0.0)))
    costmap.update(_HERE, 0)
    assert costmap.grid.cost_at(0.5, 0.01) == 0
    assert costmap.grid.cost_at(0.5, 0.5) == 255


def test_rolling_window_keeps_what_it_knows() -> None:
    costmap = _rolling(_obstacles())
    costmap.observe("scan", _seen((1.0, 0.0)))
    costmap.update(_HERE, 0)
    costmap.update((0.52, -0.3, 0.0), 0)
    np.testing.assert_allclose(costmap.grid.origin, (-1.0, -1.8), atol=1e-9)
    assert costmap.grid.cost_at(1.01, 0.01) == 254
    costmap.update((5.0, 0.0, 0.0), 0)
    assert not costmap.grid.costs.any()


def test_static_map_in_another_frame_is_turned() -> None:
    costmap = _rolling(StaticLayer(StaticOptions()))
    costmap.set_static_map(_room(40))
    # The costmap's frame lies at x = 0.5 of the map, turned by 90°.
    costmap.update(_HERE, 0, (0.5, 0.0, math.pi / 2))
    assert costmap.grid.cost_at(0.0, -0.48) == 254
    assert costmap.grid.cost_at(0.0, -0.4) == 0


@pytest.mark.parametrize(("inside", "near", "far"), [(False, 254, 0), (True, 0, 254)])
def test_clearing_forgets_one_side_of_a_square(inside: bool, near: int, far: int) -> None:
    costmap = _rolling(_obstacles(_source(clearing=False)))
    costmap.observe("scan", _seen((0.3, 0.0), (1.2, 0.0)))
    costmap.update(_HERE, 0)
    costmap.layers[0]._seen["scan"].clear()  # type: ignore[union-attr]
    costmap.clear(["local_costmap/obstacle_layer"], _HERE, 1.0, inside=inside)
    costmap.update(_HERE, 0)
    assert costmap.grid.cost_at(0.31, 0.01) == near
    assert costmap.grid.cost_at(1.21, 0.01) == far


def test_silent_sensors_and_missing_maps_are_told() -> None:
    layers: list[Layer] = [
        StaticLayer(StaticOptions()),
        _obstacles(_source(expected_update_rate=0.5)),
    ]
    costmap = LayeredCostmap(CostmapOptions(), layers, _SMALL)
    assert costmap.stale(_S) == [
        "the layer static_layer has no map yet",
        "The scan observation buffer has never been updated, and it should be updated every "
        "0.50 seconds.",
    ]
    costmap.set_static_map(_room())
    costmap.observe("scan", _seen((1.0, 0.0), stamp_ns=_S))
    assert costmap.stale(_S) == []
    (text,) = costmap.stale(3 * _S)
    assert "has not been updated for 2.00 seconds" in text


def test_a_source_that_nobody_has_is_an_error() -> None:
    with pytest.raises(KeyError, match="no layer of the costmap has a source 'sonar'"):
        _rolling(_obstacles()).observe("sonar", _seen((1.0, 0.0)))


def test_disabled_layers_do_nothing() -> None:
    costmap = _rolling(_obstacles(enabled=False))
    costmap.observe("scan", _seen((1.0, 0.0)))
    costmap.update(_HERE, 0)
    assert not costmap.grid.costs.any()


def test_combination_methods() -> None:
    for method, want in ((0, 0), (1, 254), (2, 254)):
        layers: list[Layer] = [StaticLayer(StaticOptions()), _obstacles(combination_method=method)]
        costmap = LayeredCostmap(CostmapOptions(), layers, _SMALL)
        costmap.set_static_map(_room())
        costmap.update(_HERE, 0)
        assert costmap.grid.cost_at(2.49, 0.0) == want


def _scan(ranges: list[float], **options: object) -> Scan:
    values = np.array(ranges, np.float32)
    return Scan(7, 0.0, math.pi / 2, values, 0.1, 3.5, **options)  # type: ignore[arg-type]


def test_scans_become_points_in_the_costmaps_frame() -> None:
    scan = _scan([1.0, 2.0, math.inf, math.nan], T_base_laser=(0.5, 0.0, 0.0))
    seen = observation_of_scan(scan, (1.0, 0.0, math.pi / 2), height_m=0.2)
    np.testing.assert_allclose(seen.points, [[1.0, 1.5, 0.2], [-1.0, 0.5, 0.2]], atol=1e-6)
    np.testing.assert_allclose(seen.origin, (1.0, 0.5, 0.2), atol=1e-9)
    assert seen.ends is not None
    assert len(seen.ends) == 0


def test_infinite_beams_clear_when_they_are_valid() -> None:
    scan = _scan([math.inf, math.nan, 0.01, -math.inf])
    seen = observation_of_scan(scan, _HERE, inf_is_valid=True)
    assert len(seen.points) == 0
    assert seen.ends is not None
    np.testing.assert_allclose(seen.ends, [[3.4999, 0.0, 0.0]], atol=1e-6)


@pytest.mark.parametrize("angle", np.linspace(0, math.tau, 17))
def test_rays_that_leave_the_window_clear_up_to_its_edge(angle: float) -> None:
    costmap = _rolling(_obstacles(_source(raytrace_range=50.0), track_unknown_space=True))
    far = (40 * math.cos(angle), 40 * math.sin(angle))
    costmap.observe("scan", _seen(far))
    costmap.update(_HERE, 0)
    layer = costmap.layers[0]
    assert isinstance(layer, ObstacleLayer)
    assert layer.grid is not None
    rows, columns = np.nonzero(layer.grid.costs == 0)
    assert len(rows) >= 30
    assert max(np.abs(columns - 29.5).max(), np.abs(rows - 29.5).max()) >= 29
