"""How well a scan fits where particles are, by beams or by the likelihood field of the map."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.navigation.localization.amcl_parameters import AmclOptions

__all__ = ["BeamTerms", "Beams", "LikelihoodMap", "MapFrame", "ScanModel", "chosen_beams"]


class MapFrame(NamedTuple):
    """Where the cells of a map are, as kernels take it.

    Attributes:
        x_m, y_m: of cell (0, 0).
        cell_m: side of a cell.
        per_m: cells per metre.
    """

    x_m: float
    y_m: float
    cell_m: float
    per_m: float


@dataclass(frozen=True, eq=False)
class LikelihoodMap:
    """Free cells and distances to walls.

    Attributes:
        blocked: (height, width) int8, 1 for occupied cells, 2 for unknown ones, 0 for free ones.
        distances_m: (height, width) float32, to the nearest occupied cell, at most `reach_m`.
        free: columns and rows of free cells, (n, 2).
        resolution_m: side of a cell.
        origin: of cell (0, 0), m.
        reach_m: longest distance that is told apart.
    """

    blocked: NDArray[np.int8]
    distances_m: NDArray[np.float32]
    free: NDArray[np.int64]
    resolution_m: float
    origin: tuple[float, float]
    reach_m: float

    @cached_property
    def frame(self) -> MapFrame:
        """Where its cells are."""
        x, y = self.origin
        return MapFrame(float(x), float(y), float(self.resolution_m), 1.0 / self.resolution_m)

    @classmethod
    def of_grid(cls, grid: OccupancyGrid, reach_m: float) -> LikelihoodMap:
        """Look at a map; occupied is 100, free is 0, everything else unknown, as in amcl.

        A map whose frame is turned is looked at without the turn, as amcl does.
        """
        from gazelle.navigation.costmap.costmap_kernels import squared_distances

        occupied = grid.cells == 100
        reach = int(np.ceil(reach_m / grid.resolution_m))
        squares = squared_distances(occupied, reach)
        distances = np.sqrt(np.minimum(squares, reach * reach)) * grid.resolution_m
        blocked = np.where(occupied, 1, np.where(grid.cells == 0, 0, 2)).astype(np.int8)
        rows, columns = np.nonzero(grid.cells == 0)
        return cls(
            blocked,
            np.minimum(distances, reach_m).astype(np.float32),
            np.column_stack([columns, rows]),
            grid.resolution_m,
            (grid.origin[0], grid.origin[1]),
            reach_m,
        )

    def problem_at(self, x_m: float, y_m: float) -> str:
        """Return why a robot cannot be at a place, empty when it can."""
        x, y = self.origin
        height, width = self.blocked.shape
        column = int(np.floor((x_m - x) / self.resolution_m))
        row = int(np.floor((y_m - y) / self.resolution_m))
        if not (0 <= column < width and 0 <= row < height):
            right, top = x + width * self.resolution_m, y + height * self.resolution_m
            return f"off the map, which is from ({x:.2f}, {y:.2f}) to ({right:.2f}, {top:.2f})"
        kind = int(self.blocked[row, column])
        return ("", "in a wall of the map", "where the map is unknown")[kind]

    def random_poses(self, count: int, random: np.random.Generator) -> NDArray[np.float64]:
        """Return poses anywhere on free ground, (count, 3).

        Raises:
            ValueError: the map has no free cell.
        """
        if not len(self.free):
            raise ValueError("the map has no free cell, so there is no place for a robot")
        cells = self.free[random.integers(len(self.free), size=count)]
        inside = random.random((count, 2))
        places = (cells + inside) * self.resolution_m + self.origin
        return np.column_stack([places, random.uniform(-np.pi, np.pi, count)])


class Beams(NamedTuple):
    """The beams of a scan that are looked at.

    Attributes:
        bearings_rad: (n,), in the robot's frame.
        ranges_m: (n,), `longest_m` for beams that met nothing.
        longest_m: longest range that counts.
        laser: x, y of the lidar in the robot's frame, m.
    """

    bearings_rad: NDArray[np.float64]
    ranges_m: NDArray[np.float64]
    longest_m: float
    laser: tuple[float, float]

    @property
    def ends(self) -> NDArray[np.float64]:
        """Where beams that met something end, in the robot's frame, (n, 2)."""
        hit = self.ranges_m < self.longest_m
        ranges, bearings = self.ranges_m[hit], self.bearings_rad[hit]
        x, y = self.laser
        return np.column_stack([x + ranges * np.cos(bearings), y + ranges * np.sin(bearings)])


def chosen_beams(scan: Scan, options: AmclOptions) -> Beams:
    """Return evenly spaced beams; what is shorter than the shortest range met nothing.

    Beams that are not numbers are left out.
    """
    longest, shortest = scan.range_max_m, scan.range_min_m
    if options.laser_max_range > 0:
        longest = min(longest, options.laser_max_range)
    if options.laser_min_range > 0:
        shortest = max(shortest, options.laser_min_range)
    count = len(scan.ranges_m)
    step = max((count - 1) // max(options.laser_max_beams - 1, 1), 1)
    if options.laser_model_type == "likelihood_field_prob":
        step = max(math.ceil(count / options.laser_max_beams), 1)
    ranges = scan.ranges_m[::step].astype(float)
    known = ~np.isnan(ranges)
    ranges = np.where((ranges <= shortest) | (ranges > longest), longest, ranges)
    x, y, _yaw = scan.T_base_laser
    return Beams(
        scan.bearings_rad[::step][known], ranges[known], float(longest), (float(x), float(y))
    )


class BeamTerms(NamedTuple):
    """What a beam can have met, and how likely that is.

    Attributes:
        hit: share of what the map says.
        short: of something before it.
        longest: of nothing.
        random: of anything.
        sigma_m: standard deviation of the range of a hit.
        short_per_m: how fast things before it become rarer with the range.
    """

    hit: float
    short: float
    longest: float
    random: float
    sigma_m: float
    short_per_m: float


class ScanModel:
    """Likelihoods of scans in one map."""

    def __init__(self, place: LikelihoodMap, options: AmclOptions) -> None:
        """Take a map and the parameters of the model."""
        self._map = place
        self._options = options
        self._fields: dict[float, tuple[NDArray[np.float32], np.float32]] = {}

    def weights(
        self, particles: NDArray[np.float64], beams: Beams, *, converged: bool = False
    ) -> NDArray[np.float64]:
        """Return, by particle, what its weight is multiplied with.

        Args:
            particles: (n, 3).
            beams: of a scan.
            converged: particles lie together, so that beams may be left out.
        """
        kind = self._options.laser_model_type
        if kind == "beam":
            return self._beam(particles, beams)
        if kind == "likelihood_field_prob":
            return self._prob(particles, beams, converged)
        from gazelle.navigation.localization.amcl_kernels import field_sums

        field, outside = self._field(beams.longest_m)
        out = np.empty(len(particles))
        field_sums(particles, beams.ends, field, outside, self._map.frame, out)
        return out

    def _field(self, longest_m: float) -> tuple[NDArray[np.float32], np.float32]:
        """Return what a beam's end in a cell adds, and what one outside of the map adds."""
        if longest_m not in self._fields:
            o, place = self._options, self._map
            distances = np.append(place.distances_m.ravel(), place.reach_m).astype(float)
            p = o.laser_z_hit * np.exp(-(distances**2) / (2 * o.laser_sigma_hit**2))
            p += o.laser_z_rand / longest_m
            if o.laser_model_type == "likelihood_field_prob":
                values = np.log(np.maximum(p, 1e-300)).astype(np.float32)
            else:
                values = (p**3).astype(np.float32)
            self._fields.clear()
            field = np.ascontiguousarray(values[:-1].reshape(place.distances_m.shape))
            self._fields[longest_m] = field, values[-1]
        return self._fields[longest_m]

    def _prob(
        self, particles: NDArray[np.float64], beams: Beams, converged: bool
    ) -> NDArray[np.float64]:
        from gazelle.navigation.localization.amcl_kernels import fitting_shares, log_sums

        o, ends = self._options, beams.ends
        used = np.ones(len(ends), bool)
        if o.do_beamskip and converged and len(ends):
            distances = self._map.distances_m
            shares = fitting_shares(
                particles, ends, distances, o.beam_skip_distance, self._map.frame
            )
            used = shares >= o.beam_skip_threshold
            if (~used).mean() >= o.beam_skip_error_threshold:
                used[:] = True
        field, outside = self._field(beams.longest_m)
        out = np.empty(len(particles))
        log_sums(particles, ends, used, field, outside, self._map.frame, out)
        # What all have in common does not matter, and would underflow.
        return np.asarray(np.exp(out - out.max()) if len(out) else out)

    def _beam(self, particles: NDArray[np.float64], beams: Beams) -> NDArray[np.float64]:
        from gazelle.navigation.localization.amcl_kernels import beam_likelihoods

        o, place = self._options, self._map
        out = np.empty(len(particles))
        terms = BeamTerms(
            float(o.laser_z_hit),
            float(o.laser_z_short),
            float(o.laser_z_max),
            float(o.laser_z_rand),
            float(o.laser_sigma_hit),
            float(o.laser_lambda_short),
        )
        beam_likelihoods(particles, beams, place.blocked, place.frame, terms, out)
        return out
