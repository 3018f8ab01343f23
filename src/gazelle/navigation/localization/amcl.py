"""Adaptive Monte Carlo localisation (Fox 2001; Thrun and others 2005, chapter 8), as ``amcl``."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.navigation.localization.amcl_parameters import AmclOptions
from gazelle.navigation.localization.beam_refinement import Refiner
from gazelle.navigation.localization.global_localization import chances_of, places_like
from gazelle.navigation.localization.laser_model import (
    Beams,
    LikelihoodMap,
    ScanModel,
    chosen_beams,
)
from gazelle.navigation.localization.motion_model import moved

__all__ = ["Amcl", "Estimate", "best_cluster", "statistics"]


_CELL = np.array([0.5, 0.5, math.pi / 18])

_MAX_CELLS = 20_000_000

_ANGLES = 36


def statistics(
    particles: NDArray[np.float64], weights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return mean pose (3,) and covariance (3, 3); of angles the circular ones, as amcl."""
    total = float(weights.sum())
    share = weights / total if total > 0 else np.full(len(weights), 1 / len(weights))
    place = share @ particles[:, :2]
    c, s = share @ np.cos(particles[:, 2]), share @ np.sin(particles[:, 2])
    covariance = np.zeros((3, 3))
    off = particles[:, :2] - place
    covariance[:2, :2] = (off * share[:, None]).T @ off
    covariance[2, 2] = -2 * math.log(min(max(math.hypot(c, s), 1e-12), 1.0))
    return np.append(place, math.atan2(s, c)), covariance


def best_cluster(
    particles: NDArray[np.float64], weights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return mean pose (3,) and covariance (3, 3) of the heaviest group of particles.

    Particles of neighbouring cells of 0.5 m × 0.5 m × 10° belong together.
    """
    cells = np.floor(particles / _CELL).astype(np.int64)
    cells[:, 2] %= _ANGLES
    low = cells[:, :2].min(axis=0)
    size = cells[:, :2].max(axis=0) - low + 1
    if int(size[0]) * int(size[1]) * _ANGLES > _MAX_CELLS:
        return statistics(particles, weights)
    # One slice more on either side of the angles, so that neighbours across ±180° are seen.
    held = np.zeros((size[0], size[1], _ANGLES + 1), bool)
    column, row, angle = cells[:, 0] - low[0], cells[:, 1] - low[1], cells[:, 2]
    held[column, row, angle] = True
    held[..., _ANGLES] = held[..., 0]
    labels, count = label(held, structure=np.ones((3, 3, 3)))
    same = np.arange(count + 1)
    for a, b in zip(labels[..., 0].ravel(), labels[..., _ANGLES].ravel(), strict=True):
        if a and same[a] != same[b]:
            same[same == same[b]] = same[a]
    groups = same[labels[column, row, angle]]
    sums = np.bincount(groups, weights)
    best = int(sums.argmax())
    chosen = groups == best
    return statistics(particles[chosen], weights[chosen])


Pose = tuple[float, float, float]

_TOGETHER_M = 0.5

_FOUND_M = 0.2


@dataclass(frozen=True, slots=True, eq=False)
class Estimate:
    """Where the robot is.

    Attributes:
        pose: of the heaviest group of particles, in the map's frame, moved to where the scan fits
            best near there.
        covariance: of all particles, (3, 3).
        resampled: the particles were drawn anew.
    """

    pose: Pose
    covariance: NDArray[np.float64]
    resampled: bool


class Amcl:
    """A particle filter in a map. Not safe for several threads at once."""

    def __init__(self, options: AmclOptions, seed: int = 0) -> None:
        """Begin at the initial pose of the options, without a map.

        Args:
            options: parameters.
            seed: of everything random.
        """
        self._options = options
        self._random = np.random.default_rng(seed)
        self._map: LikelihoodMap | None = None
        self._model: ScanModel | None = None
        self._refiner: Refiner | None = None
        self._odometry: Pose | None = None
        self._lasers: set[str] = set()
        self._pending: set[str] = set()
        self._particles: NDArray[np.float64] = np.zeros((0, 3))
        self._weights: NDArray[np.float64] = np.zeros(0)
        self._forced = self._lost = False
        self._updates = 0
        self._slow = self._fast = 0.0
        o = options
        spread = np.diag([o.initial_cov_xx, o.initial_cov_yy, o.initial_cov_aa])
        self.initialise((o.initial_pose_x, o.initial_pose_y, o.initial_pose_a), spread)

    @property
    def particles(self) -> NDArray[np.float64]:
        """Poses, (n, 3)."""
        return self._particles

    @property
    def weights(self) -> NDArray[np.float64]:
        """Of the n particles, (n,); their sum is 1."""
        return self._weights

    @property
    def has_map(self) -> bool:
        """Whether there is a map."""
        return self._map is not None

    def problem_at(self, x_m: float, y_m: float) -> str:
        """Return why a robot cannot be at a place of the map, empty when it can."""
        return "" if self._map is None else self._map.problem_at(x_m, y_m)

    def set_options(self, options: AmclOptions) -> None:
        """Go on with other parameters; the particles stay."""
        if options.laser_likelihood_max_dist != self._options.laser_likelihood_max_dist:
            self._model = None
        self._options = options
        if self._map is not None and self._model is not None:
            self._model = ScanModel(self._map, options)

    def set_map(self, grid: OccupancyGrid) -> None:
        """Take a map; the particles stay where they are."""
        self._map = LikelihoodMap.of_grid(grid, self._options.laser_likelihood_max_dist)
        self._model = ScanModel(self._map, self._options)
        self._refiner = Refiner(self._map)

    def initialise(self, pose: Pose, covariance: NDArray[np.float64]) -> None:
        """Spread the particles around a pose.

        Args:
            pose: in the map's frame.
            covariance: (3, 3) of x, y (m) and yaw (rad).
        """
        count = self._options.max_particles
        # A covariance that is not positive is taken as far as it is.
        values, vectors = np.linalg.eigh((covariance + covariance.T) / 2)
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        drawn = self._random.standard_normal((count, 3)) @ root.T
        self._begin_with(np.asarray(pose) + drawn)

    def spread_everywhere(self) -> None:
        """Spread the particles over all free ground (service ``global_localization``).

        The next scan is compared with many more places than there are particles, which go to
        those that look like it. Until they are together, they are weighed by how well scans fit
        beam by beam, as amcl's likelihoods tell places that look alike apart only slowly, and
        chance decides before.

        Raises:
            ValueError: there is no map, or it has no free cell.
        """
        if self._map is None:
            raise ValueError("there is no map yet")
        self._begin_with(self._map.random_poses(self._options.max_particles, self._random))
        self._lost = True

    def request_update(self) -> None:
        """Let the next scan count although the robot stands (``request_nomotion_update``)."""
        self._forced = True

    def update(self, odometry: Pose, scan: Scan, laser: str = "") -> Estimate | None:
        """Take in a scan.

        One without a single number (a blinded or starting lidar) says nothing, so it neither
        answers `request_update` nor counts as the first look from an initial pose.

        Args:
            odometry: the robot in the odometry's frame at the time of the scan.
            scan: what the lidar saw.
            laser: name of the lidar, where there are several.

        Returns:
            Where the robot is, when that changed; None while it has not moved far enough, or
            before there is a map.
        """
        if self._model is None or self._map is None or self._refiner is None:
            return None
        if np.isnan(scan.ranges_m).all():
            return None
        first = self._odometry is None
        self._lasers.add(laser)
        if self._odometry is None:
            self._odometry = odometry
            self._pending = set(self._lasers)
            self._updates = 0
        elif self._moved_enough(odometry):
            self._pending = set(self._lasers)
        if laser not in self._pending:
            return None
        self._pending.discard(laser)
        self._forced = False
        if not first:
            self._particles = moved(
                self._particles, self._odometry, odometry, self._options, self._random
            )
        self._odometry = odometry
        beams = chosen_beams(scan, self._options)
        if self._lost and first:
            self._particles = places_like(
                beams.ends, self._map, self._refiner, len(self._particles), self._random
            )
        self._weigh(beams)
        self._updates += 1
        resampled = self._updates % self._options.resample_interval == 0
        if resampled:
            self._resample()
        return self._estimate(beams, resampled)

    def _estimate(self, beams: Beams, resampled: bool) -> Estimate:
        mean, spread = best_cluster(self._particles, self._weights)
        if self._refiner is not None:
            mean = self._refiner.refine(mean, spread, beams.ends)
        _mean, covariance = statistics(self._particles, self._weights)
        return Estimate((float(mean[0]), float(mean[1]), float(mean[2])), covariance, resampled)

    def _begin_with(self, particles: NDArray[np.float64]) -> None:
        self._particles = particles
        self._weights = np.full(len(particles), 1.0 / len(particles))
        self._slow = self._fast = 0.0
        self._odometry = None
        self._lost = False

    def _moved_enough(self, odometry: Pose) -> bool:
        o, last = self._options, self._odometry
        assert last is not None
        turn = abs(math.remainder(odometry[2] - last[2], math.tau))
        way = max(abs(odometry[0] - last[0]), abs(odometry[1] - last[1]))
        return self._forced or way > o.update_min_d or turn > o.update_min_a

    def _weigh(self, beams: Beams) -> None:
        assert self._model is not None
        assert self._refiner is not None
        o = self._options
        converged = o.do_beamskip and self._together()
        if self._lost:
            likelihoods = chances_of(self._refiner.log_fits(self._particles, beams.ends))
        else:
            likelihoods = self._model.weights(self._particles, beams, converged=converged)
        weights = self._weights * likelihoods
        total = float(weights.sum())
        if not total > 0:
            self._weights = np.full(len(weights), 1.0 / len(weights))
            return
        average = total / len(weights)
        self._slow += (average - self._slow) * (o.recovery_alpha_slow if self._slow else 1.0)
        self._fast += (average - self._fast) * (o.recovery_alpha_fast if self._fast else 1.0)
        self._weights = weights / total

    def _together(self) -> bool:
        off = np.abs(self._particles[:, :2] - self._particles[:, :2].mean(axis=0))
        return bool((off <= _TOGETHER_M).all())

    def _resample(self) -> None:
        from gazelle.navigation.localization.amcl_kernels import ParticleNeed, resample

        o, weights = self._options, self._weights
        assert self._map is not None
        if o.selective_resampling and 1.0 / float((weights**2).sum()) > len(weights) / 2:
            return
        elsewhere = max(0.0, 1.0 - self._fast / self._slow) if self._slow > 0 else 0.0
        count = o.max_particles
        draws = np.zeros((count, 4))
        # Any first part of these is spread evenly, which loses fewer good particles by chance.
        draws[:, 0] = (self._random.permutation(count) + self._random.random(count)) / count
        if elsewhere > 0 and len(self._map.free):
            draws[:, 1:] = self._map.random_poses(count, self._random)
            # Random poses begin a new judgement, as amcl resets its averages.
            self._slow = self._fast = 0.0
        else:
            elsewhere = 0.0
        cumulative = np.cumsum(weights)
        cumulative[-1] = 1.0
        least = count if self._lost else min(o.min_particles, count)
        need = ParticleNeed(least, count, float(o.kld_err), float(o.kld_z))
        chances = self._random.random(count)
        self._particles = resample(self._particles, cumulative, chances, draws, elsewhere, need)
        self._weights = np.full(len(self._particles), 1.0 / len(self._particles))
        self._lost &= bool(self._particles[:, :2].std(axis=0).max() > _FOUND_M)
