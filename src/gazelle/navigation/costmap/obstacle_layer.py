"""The layer of what sensors see: observations, marking, clearing along rays, forgetting."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import compose, transform_points
from gazelle.navigation.costmap.cost_grid import FREE, UNKNOWN, CostGrid, Window
from gazelle.navigation.costmap.costmap_parameters import (
    ObstacleOptions,
    SourceOptions,
    VoxelOptions,
)
from gazelle.navigation.costmap.footprint import Footprint

__all__ = ["Observation", "ObstacleLayer", "observation_of_scan"]


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """Points in the costmap's frame.

    Attributes:
        stamp_ns: when they were seen.
        origin: x, y, z of the sensor, m.
        points: what is there, (n, 3), m; it marks, and clears what is before it.
        ends: ends of beams that met nothing, (m, 3), m; they only clear.
    """

    stamp_ns: int
    origin: tuple[float, float, float]
    points: NDArray[np.float64]
    ends: NDArray[np.float64] | None = None


def observation_of_scan(
    scan: Scan,
    T_global_base: tuple[float, float, float],
    *,
    height_m: float = 0.0,
    inf_is_valid: bool = False,
) -> Observation:
    """Return what a scan shows.

    Args:
        scan: the scan.
        T_global_base: the robot in the costmap's frame at the time of the scan.
        height_m: of the lidar above the ground, m.
        inf_is_valid: beams of infinite range clear up to just below the largest range, as the
            parameter of this name says; without it they say nothing.
    """
    pose = tuple(map(float, compose(T_global_base, scan.T_base_laser)))
    flat = transform_points(T_global_base, scan.points())
    ends = _beam_ends(scan, pose) if inf_is_valid else np.zeros((0, 2))
    return Observation(
        scan.stamp_ns,
        (pose[0], pose[1], height_m),
        _raised(flat, height_m),
        _raised(ends, height_m),
    )


def _beam_ends(scan: Scan, pose: tuple[float, ...]) -> NDArray[np.float64]:
    nothing = np.isposinf(scan.ranges_m)
    angles = scan.angles_rad[nothing] * (-1.0 if scan.upside_down else 1.0)
    # costmap_2d puts such beams 0.1 mm inside of the largest range.
    reach = scan.range_max_m - 1e-4
    ends = np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=-1)
    return transform_points(pose, ends)


def _raised(points: NDArray[np.float64], height_m: float) -> NDArray[np.float64]:
    return np.column_stack([points, np.full(len(points), height_m)])


_NOTHING = (1 << 40, 1 << 40, -1, -1)


@dataclass(eq=False)
class ObstacleLayer:
    """Obstacles as sensors see them.

    Attributes:
        options: its parameters.
        sources: its sensors by name.
        name: of the layer.
    """

    options: ObstacleOptions
    sources: Mapping[str, SourceOptions] = field(default_factory=dict)
    name: str = "obstacle_layer"

    def __post_init__(self) -> None:
        """Begin without anything seen."""
        self._grid: CostGrid | None = None
        self._seen: dict[str, list[Observation]] = {source: [] for source in self.sources}
        self._heard_ns: dict[str, int] = {}
        self._extra = Window(0, 0, 0, 0)
        self._footprint: NDArray[np.float64] | None = None

    @property
    def grid(self) -> CostGrid | None:
        """What the layer itself knows; None before the costmap has a size."""
        return self._grid

    def observe(self, source: str, observation: Observation, heard_ns: int) -> None:
        """Take what a sensor saw; what has expired by now is forgotten.

        Raises:
            KeyError: there is no such source.
        """
        self._seen[source].append(observation)
        self._heard_ns[source] = heard_ns
        self._forget(source, heard_ns)

    def stale(self, now_ns: int) -> list[str]:
        """Return which sensors are silent for too long, in words."""
        found = []
        for name, options in self.sources.items():
            wanted = options.expected_update_rate
            age_s = (now_ns - self._heard_ns.get(name, 0)) * 1e-9
            if wanted > 0 and (name not in self._heard_ns or age_s > wanted):
                topic = options.topic or name
                text = (
                    f"has not been updated for {age_s:.2f} seconds"
                    if name in self._heard_ns
                    else "has never been updated"
                )
                found.append(
                    f"The {topic} observation buffer {text}, and it should be updated every "
                    f"{wanted:.2f} seconds."
                )
        return found

    def match(self, master: CostGrid) -> None:
        """Take the costmap's size and place, and keep what lies in both."""
        old = self._grid
        if (
            old is not None
            and old.origin == master.origin
            and old.costs.shape == master.costs.shape
        ):
            return
        fresh = CostGrid(
            np.full(master.costs.shape, self._default, np.uint8), master.resolution_m, master.origin
        )
        if old is not None and old.resolution_m == master.resolution_m:
            copy_overlap(old, fresh)
        self._grid = fresh

    def clear(self, window: Window, *, inside: bool) -> None:
        """Forget what was seen inside or outside of a window of cells."""
        if self._grid is None:
            return
        window = window.within(self._grid.width, self._grid.height)
        kept = None if inside else self._grid.costs[window.cells].copy()
        self._grid.costs[window.cells if inside else ...] = self._default
        if kept is not None:
            self._grid.costs[window.cells] = kept
        self._extra = self._grid.whole

    def reset(self) -> None:
        """Forget everything that was seen."""
        for held in self._seen.values():
            held.clear()
        if self._grid is not None:
            self._grid.costs[...] = self._default
            self._extra = self._grid.whole

    def changes(
        self,
        master: CostGrid,
        pose: tuple[float, float, float],
        footprint: Footprint,
        now_ns: int,
    ) -> Window:
        """Clear and mark by what the sensors saw; returns what has changed."""
        self.match(master)
        assert self._grid is not None
        bounds = np.array(_NOTHING, np.int64)
        for name in self.sources:
            self._forget(name, now_ns)
        for clearing in (True, False):
            for name, options in self.sources.items():
                for observation in self._seen[name]:
                    self._apply(observation, options, clearing, bounds)
        self._footprint = None
        if self.options.footprint_clearing_enabled:
            self._footprint = (footprint.at(pose) - self._grid.origin) / self._grid.resolution_m
            self._clear_under(self._grid, bounds)
        seen = Window(*map(int, bounds)) if bounds[2] >= 0 else Window(0, 0, 0, 0)
        extra, self._extra = self._extra, Window(0, 0, 0, 0)
        return seen.union(extra)

    def write(self, master: CostGrid, window: Window) -> None:
        """Write obstacles into a window."""
        if self._grid is None:
            return
        if self._footprint is not None:
            self._clear_under(master, np.array(_NOTHING, np.int64))
        own, target = self._grid.costs[window.cells], master.costs[window.cells]
        taken = own != UNKNOWN
        if self.options.combination_method == 1:
            taken &= (target == UNKNOWN) | (target < own)
        elif self.options.combination_method == 2:
            taken &= (target != UNKNOWN) & (target < own)
        target[taken] = own[taken]

    @property
    def _default(self) -> int:
        return UNKNOWN if self.options.track_unknown_space else FREE

    def _forget(self, source: str, now_ns: int) -> None:
        held, persistence_s = self._seen[source], self.sources[source].observation_persistence
        if persistence_s == 0:
            del held[:-1]
        else:
            oldest = now_ns - int(persistence_s * 1e9)
            held[:] = [item for item in held if item.stamp_ns >= oldest]

    def _apply(
        self,
        observation: Observation,
        options: SourceOptions,
        clearing: bool,
        bounds: NDArray[np.int64],
    ) -> None:
        from gazelle.navigation.costmap.costmap_kernels import clear_rays, mark_points

        assert self._grid is not None
        if not (options.clearing if clearing else options.marking):
            return
        inverse = 1.0 / self._grid.resolution_m
        ox, oy = (np.array(observation.origin[:2]) - self._grid.origin) * inverse
        points = self._kept(observation.points, options)
        if clearing and observation.ends is not None:
            points = np.concatenate([points, observation.ends])
        cells = np.ascontiguousarray((points[:, :2] - self._grid.origin) * inverse)
        if clearing:
            near, far = options.raytrace_min_range, options.raytrace_range
            clear_rays(self._grid.costs, ox, oy, cells, near * inverse, far * inverse, bounds)
        else:
            near, far = options.obstacle_min_range, options.obstacle_range
            mark_points(self._grid.costs, ox, oy, cells, near * inverse, far * inverse, bounds)

    def _kept(self, points: NDArray[np.float64], options: SourceOptions) -> NDArray[np.float64]:
        """Return points whose height counts."""
        low = max(options.min_obstacle_height, self.options.min_obstacle_height)
        high = self.options.max_obstacle_height
        # A maximum of 0 is Nav2's way to say nothing about it.
        if options.max_obstacle_height > 0:
            high = min(high, options.max_obstacle_height)
        if isinstance(self.options, VoxelOptions):
            column = self.options.z_voxels * self.options.z_resolution
            low, high = max(low, self.options.origin_z), min(high, self.options.origin_z + column)
        z = points[:, 2]
        keep = (z >= low) & (z <= high) & np.isfinite(points).all(axis=1)
        return points if keep.all() else points[keep]

    def _clear_under(self, grid: CostGrid, bounds: NDArray[np.int64]) -> None:
        from gazelle.navigation.costmap.costmap_kernels import fill_polygon

        fill_polygon(grid.costs, self._footprint, np.uint8(FREE), bounds)


def copy_overlap(old: CostGrid, fresh: CostGrid) -> None:
    """Copy the cells that two grids share; their origins differ by whole cells."""
    dx = round((fresh.origin[0] - old.origin[0]) / old.resolution_m)
    dy = round((fresh.origin[1] - old.origin[1]) / old.resolution_m)
    there = Window(-dx, -dy, old.width - dx, old.height - dy).within(fresh.width, fresh.height)
    if not there.empty:
        source = Window(there.x0 + dx, there.y0 + dy, there.x1 + dx, there.y1 + dy)
        fresh.costs[there.cells] = old.costs[source.cells]
