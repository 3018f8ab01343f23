"""How well a scan fits where particles are."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.laser_scan import Scan
from gazelle.navigation.localization.amcl_options import AmclOptions
from gazelle.navigation.localization.likelihood_field import LikelihoodMap

__all__ = ["BeamTerms", "Beams", "ScanModel", "chosen_beams"]


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
