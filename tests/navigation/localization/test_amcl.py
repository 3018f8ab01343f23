"""Motion models, sensor models, and finding the robot."""

from __future__ import annotations

import importlib.util
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.navigation.localization import MOTION_MODELS, Amcl, AmclOptions, moved
from gazelle.navigation.localization.amcl import best_cluster, statistics
from gazelle.navigation.localization.amcl_kernels import ParticleNeed, cast_ray, resample
from gazelle.navigation.localization.beam_refinement import Refiner
from gazelle.navigation.localization.laser_model import LikelihoodMap, ScanModel, chosen_beams

_QUIET = AmclOptions(
    odom_alpha1=0.0, odom_alpha2=0.0, odom_alpha3=0.0, odom_alpha4=0.0, odom_alpha5=0.0
)


def _soak() -> Any:
    path = Path(__file__).parents[3] / "benchmarks" / "soak" / "amcl_convergence.py"
    spec = importlib.util.spec_from_file_location("amcl_convergence", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _room() -> OccupancyGrid:
    cells = np.zeros((60, 80), np.int8)
    cells[[0, -1]] = 100
    cells[:, [0, -1]] = 100
    cells[40:50, 55:70] = 100
    return OccupancyGrid(cells, 0.05)


def _scan(pose: tuple[float, float, float], longest_m: float = 3.5) -> Scan:
    step = math.tau / 90
    cells = _room().cells
    ranges = [
        0.05 * cast_ray(cells, pose[0] / 0.05, pose[1] / 0.05, pose[2] + k * step, 1e3) + 0.02
        for k in range(90)
    ]
    values = np.array([value if value < longest_m else math.inf for value in ranges])
    return Scan(0, 0.0, step, values.astype(np.float32), 0.1, longest_m)


@pytest.mark.parametrize("seed", range(3))
def test_robot_is_found_from_half_a_metre_and_30_degrees_away(seed: int) -> None:
    """100 of them are in benchmarks/soak/amcl_convergence.py."""
    metres, degrees = _soak().error_of_run(seed)
    assert metres < 0.1
    assert degrees < 5


@pytest.mark.parametrize("model", ["diff", "omni", "diff-corrected", "omni-corrected",
                                   "nav2_amcl::DifferentialMotionModel"])  # fmt: skip
def test_without_noise_particles_go_where_odometry_goes(model: str) -> None:
    options = replace(_QUIET, odom_model_type=model)
    particles = np.array([[1.0, 2.0, 0.5], [0.0, 0.0, -2.0]])
    random = np.random.default_rng(0)
    after = moved(particles, (5.0, 5.0, 0.2), (5.4, 5.3, 1.0), options, random)
    c, s = math.cos(0.2), math.sin(0.2)
    ahead, aside = c * 0.4 + s * 0.3, c * 0.3 - s * 0.4
    for one, (x, y, yaw) in zip(after, particles, strict=True):
        want = (
            x + math.cos(yaw) * ahead - math.sin(yaw) * aside,
            y + math.sin(yaw) * ahead + math.cos(yaw) * aside,
        )
        np.testing.assert_allclose(one[:2], want, atol=1e-12)
        assert math.remainder(one[2] - yaw - 0.8, math.tau) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("model", "spread"), [("diff", 0.3 * 0.5**2), ("diff-corrected", 0.3**0.5 * 0.5)]
)
def test_noise_along_the_way_is_that_of_alpha_3(model: str, spread: float) -> None:
    """The model that is not corrected takes a variance for a standard deviation."""
    options = replace(_QUIET, odom_model_type=model, odom_alpha3=0.3)
    random = np.random.default_rng(1)
    after = moved(np.zeros((20_000, 3)), (0.0, 0.0, 0.0), (0.5, 0.0, 0.0), options, random)
    assert after[:, 0].std() == pytest.approx(spread, rel=0.03)
    assert after[:, 0].mean() == pytest.approx(0.5, abs=0.01)
    assert np.abs(after[:, 1]).max() == 0


def test_driving_backwards_is_as_noisy_as_driving_forwards() -> None:
    options = AmclOptions(odom_model_type="diff-corrected")
    spreads = [
        moved(np.zeros((4000, 3)), (0.0, 0.0, 0.0), (way, 0.0, 0.0), options,
              np.random.default_rng(2)).std(axis=0)
        for way in (0.5, -0.5)
    ]  # fmt: skip
    np.testing.assert_allclose(spreads[0], spreads[1], rtol=0.1)


def test_models_of_both_generations_are_known() -> None:
    assert MOTION_MODELS["nav2_amcl::OmniMotionModel"] == ("omni", True)
    with pytest.raises(KeyError):
        moved(np.zeros((1, 3)), (0, 0, 0), (1, 0, 0), replace(_QUIET, odom_model_type="car"),
              np.random.default_rng(0))  # fmt: skip


@pytest.mark.parametrize("model", ["likelihood_field", "likelihood_field_prob", "beam"])
def test_the_true_pose_weighs_most(model: str) -> None:
    options = AmclOptions(laser_model_type=model, laser_max_beams=45, do_beamskip=True)
    place = LikelihoodMap.of_grid(_room(), 2.0)
    true = (1.2, 1.6, 0.4)
    rng = np.random.default_rng(0)
    particles = np.vstack([[true], np.array(true) + rng.normal(0, 0.3, (300, 3))])
    beams = chosen_beams(_scan(true), options)
    weights = ScanModel(place, options).weights(particles, beams, converged=True)
    assert np.isfinite(weights).all()
    best = particles[int(weights.argmax())]
    assert math.hypot(best[0] - true[0], best[1] - true[1]) < 0.12


def test_a_field_weight_is_what_the_formula_says() -> None:
    options = AmclOptions(laser_z_hit=0.6, laser_z_rand=0.4, laser_sigma_hit=0.1)
    cells = np.zeros((1, 40), np.int8)
    cells[0, 20] = 100
    model = ScanModel(LikelihoodMap.of_grid(OccupancyGrid(cells, 0.1), 2.0), options)
    scan = Scan(0, 0.0, 0.1, np.array([1.25], np.float32), 0.1, 4.0)
    weights = model.weights(np.array([[0.45, 0.05, 0.0]]), chosen_beams(scan, options))
    # The beam ends in cell 17, three cells before the wall.
    want = 0.6 * math.exp(-(0.3**2) / (2 * 0.1**2)) + 0.4 / 4.0
    assert weights[0] == pytest.approx(1 + want**3, rel=1e-5)


def test_beams_are_spread_and_cleaned() -> None:
    ranges = np.array([0.05, 1.0, np.nan, 2.0, np.inf, 3.0, 9.0], np.float32)
    scan = Scan(0, -0.3, 0.1, ranges, 0.1, 5.0)
    options = AmclOptions(laser_max_beams=30, laser_max_range=2.5)
    beams = chosen_beams(scan, options)
    np.testing.assert_allclose(beams.ranges_m, [2.5, 1.0, 2.0, 2.5, 2.5, 2.5])
    assert len(beams.ends) == 2
    few = chosen_beams(Scan(0, 0.0, 0.01, np.ones(361, np.float32), 0.1, 5.0), AmclOptions())
    assert len(few.ranges_m) == 31


@pytest.mark.parametrize("angle", np.linspace(-math.pi, math.pi, 25))
def test_rays_end_at_the_first_cell_that_is_not_free(angle: float) -> None:
    cells = np.zeros((50, 50), np.int8)
    cells[10:15, 30:40] = 1
    x, y = 20.3, 25.7
    far = cast_ray(cells, x, y, angle, 100.0)
    steps = np.arange(0, far - 1e-6, 0.01)
    u, v = np.floor(x + steps * math.cos(angle)), np.floor(y + steps * math.sin(angle))
    assert not cells[v.astype(int), u.astype(int)].any()
    end = (x + (far + 1e-6) * math.cos(angle), y + (far + 1e-6) * math.sin(angle))
    outside = min(end) < 0 or max(end) >= 50
    assert outside or cells[int(end[1]), int(end[0])]


def test_resampling_keeps_shares_and_needs_fewer_when_they_agree() -> None:
    rng = np.random.default_rng(0)
    particles = np.array([[0.1, 0.1, 0.0], [5.0, 5.0, 1.0]])
    draws = np.zeros((4000, 4))
    draws[:, 0] = rng.random(4000)
    options = (np.cumsum([0.25, 0.75]), rng.random(4000), draws, 0.0)
    every = resample(particles, *options, ParticleNeed(4000, 4000, 0.01, 0.99))
    assert (every[:, 0] > 1).mean() == pytest.approx(0.75, abs=0.03)
    need = ParticleNeed(10, 4000, 0.01, 0.99)
    few = resample(particles, *options, need)
    assert len(few) < 200
    wide = rng.uniform(-20, 20, (2000, 3))
    spread = (np.cumsum(np.full(2000, 1 / 2000)), rng.random(4000), draws, 0.0)
    assert len(resample(wide, *spread, need)) == 4000


def test_the_heavier_group_is_the_pose_also_across_180_degrees() -> None:
    rng = np.random.default_rng(0)
    one = np.array([1.0, 1.0, math.pi]) + rng.normal(0, 0.05, (300, 3))
    other = np.array([4.0, 1.0, 0.0]) + rng.normal(0, 0.05, (200, 3))
    particles = np.vstack([one, other])
    mean, spread = best_cluster(particles, np.full(500, 1 / 500))
    np.testing.assert_allclose(np.diag(spread), 0.05**2, rtol=0.25)
    np.testing.assert_allclose(mean[:2], (1.0, 1.0), atol=0.02)
    assert abs(math.remainder(mean[2] - math.pi, math.tau)) < 0.02
    _mean, covariance = statistics(one, np.full(300, 1.0))
    np.testing.assert_allclose(np.diag(covariance), 0.05**2, rtol=0.25)


def test_a_robot_that_stands_is_looked_at_only_on_request() -> None:
    amcl = Amcl(AmclOptions(max_particles=300, resample_interval=1), seed=1)
    assert amcl.update((0.0, 0.0, 0.0), _scan((1.2, 1.6, 0.4))) is None
    amcl.set_map(_room())
    amcl.initialise((1.2, 1.6, 0.4), np.diag([0.01, 0.01, 0.01]))
    scan = _scan((1.2, 1.6, 0.4))
    assert amcl.update((0.0, 0.0, 0.0), scan) is not None
    assert amcl.update((0.05, 0.0, 0.0), scan) is None
    amcl.request_update()
    assert amcl.update((0.05, 0.0, 0.0), scan) is not None
    assert amcl.update((0.3, 0.0, 0.0), scan) is not None


def test_a_scan_without_numbers_does_not_use_up_a_request() -> None:
    amcl = Amcl(AmclOptions(max_particles=300, resample_interval=1), seed=1)
    amcl.set_map(_room())
    amcl.initialise((1.2, 1.6, 0.4), np.diag([0.01, 0.01, 0.01]))
    scan = _scan((1.2, 1.6, 0.4))
    blind = replace(scan, ranges_m=np.full_like(scan.ranges_m, np.nan))
    assert amcl.update((0.0, 0.0, 0.0), blind) is None
    assert amcl.update((0.0, 0.0, 0.0), scan) is not None
    amcl.request_update()
    assert amcl.update((0.0, 0.0, 0.0), blind) is None
    assert amcl.update((0.0, 0.0, 0.0), scan) is not None


def test_a_kidnapped_robot_is_found_after_spreading_everywhere() -> None:
    options = AmclOptions(
        max_particles=3000, resample_interval=1, laser_max_beams=60,
        laser_model_type="likelihood_field_prob",
    )  # fmt: skip
    amcl = Amcl(options, seed=3)
    with pytest.raises(ValueError, match="there is no map yet"):
        amcl.spread_everywhere()
    amcl.set_map(_room())
    amcl.spread_everywhere()
    true, found = np.array([1.0, 1.0, 0.3]), None
    start = true.copy()
    for _ in range(12):
        found = amcl.update(tuple(true - start), _scan(tuple(true))) or found
        true = true + np.array([0.1, 0.02, 0.25])
        amcl.request_update()
    assert found is not None
    last = true - np.array([0.1, 0.02, 0.25])
    assert math.hypot(found.pose[0] - last[0], found.pose[1] - last[1]) < 0.15


@pytest.mark.parametrize("seed", range(3))
def test_a_kidnapped_robot_is_found_at_once_with_amcls_default_model(seed: int) -> None:
    amcl = Amcl(AmclOptions(max_particles=1000, resample_interval=1, laser_max_beams=60), seed)
    amcl.set_map(_room())
    amcl.spread_everywhere()
    assert np.ptp(amcl.particles[:, 0]) > 3.0
    for _ in range(2):
        amcl.request_update()
        found = amcl.update((0.0, 0.0, 0.0), _scan((1.0, 1.0, 0.3)))
    assert found is not None
    assert math.hypot(found.pose[0] - 1.0, found.pose[1] - 1.0) < 0.1
    assert abs(found.pose[2] - 0.3) < 0.05


def test_scans_that_say_nothing_leave_the_particles_everywhere() -> None:
    amcl = Amcl(AmclOptions(max_particles=1000, resample_interval=1), 0)
    amcl.set_map(_room())
    amcl.spread_everywhere()
    nothing = Scan(0, 0.0, math.tau / 90, np.full(90, np.nan, np.float32), 0.1, 3.5)
    assert amcl.update((0.0, 0.0, 0.0), nothing) is None
    assert np.ptp(amcl.particles[:, 0]) > 3.0


def test_the_pose_is_where_the_scan_fits_best_near_the_particles() -> None:
    refiner = Refiner(LikelihoodMap.of_grid(_room(), 2.0))
    ends = chosen_beams(_scan((1.2, 1.6, 0.4)), AmclOptions(laser_max_beams=90)).ends
    mean, wide = np.array([1.27, 1.55, 0.45]), np.diag([0.01, 0.01, 0.01])
    np.testing.assert_allclose(refiner.refine(mean, wide, ends), (1.2, 1.6, 0.4), atol=0.025)
    np.testing.assert_array_equal(refiner.refine(mean, wide, ends[:0]), mean)


def test_along_a_corridor_the_mean_of_the_particles_stays() -> None:
    cells = np.zeros((40, 200), np.int8)
    cells[[0, -1]] = 100
    refiner = Refiner(LikelihoodMap.of_grid(OccupancyGrid(cells, 0.05), 2.0))
    along = np.linspace(-1, 1, 41)
    ends = np.vstack([np.column_stack([along, np.full(41, side)]) for side in (-0.975, 0.975)])
    found = refiner.refine(np.array([5.0, 1.05, 0.02]), np.diag([0.02, 0.02, 0.01]), ends)
    np.testing.assert_allclose(found, (5.0, 1.0, 0.0), atol=0.03)


def test_recovery_alphas_throw_in_random_poses_when_scans_no_longer_fit() -> None:
    def spread(slow: float, fast: float) -> float:
        options = AmclOptions(
            max_particles=1000, min_particles=1000, resample_interval=1,
            recovery_alpha_slow=slow, recovery_alpha_fast=fast,
        )  # fmt: skip
        amcl = Amcl(options, seed=0)
        amcl.set_map(_room())
        amcl.initialise((1.2, 1.6, 0.4), np.diag([1e-4, 1e-4, 1e-4]))
        for pose in [(1.2, 1.6, 0.4)] * 4 + [(2.4, 0.7, 2.0)]:
            amcl.request_update()
            amcl.update((0.0, 0.0, 0.0), _scan(pose))
        return float(np.ptp(amcl.particles[:, 0]))

    assert spread(0.0, 0.0) < 0.5
    assert spread(0.001, 0.3) > 1.5


def test_the_same_seed_gives_the_same_particles() -> None:
    clouds = []
    for _ in range(2):
        amcl = Amcl(AmclOptions(max_particles=200), seed=5)
        amcl.set_map(_room())
        for step in range(3):
            amcl.update((0.3 * step, 0.0, 0.0), _scan((1.2 + 0.3 * step, 1.6, 0.0)))
        clouds.append(amcl.particles)
    np.testing.assert_array_equal(clouds[0], clouds[1])
