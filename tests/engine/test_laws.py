"""Mechanics: what the engine does against what the textbook says."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.description.model import JointAxis
from gazelle.geometry import Pose

# A max_vel that limits nothing: springs and dampers act alone.
UNLIMITED = 100.0


def speed_along_slope(engine, name, tilt):
    linear, _ = engine.model_velocity(name)
    return float(linear @ [math.cos(tilt), 0.0, -math.sin(tilt)])


def test_free_fall_follows_half_g_t_squared(build):
    engine = build.engine(build.block(pose=Pose((0, 0, 10))))
    engine.step(1000)
    fallen = 10 - engine.model_pose("block").position_m[2]
    assert fallen == pytest.approx(0.5 * build.G, rel=2e-3)
    assert engine.model_velocity("block")[0][2] == pytest.approx(-build.G, rel=1e-9)


@pytest.mark.parametrize("mu", [0.2, 0.5])
def test_block_on_steep_slope_slides_with_coulomb_acceleration(build, mu):
    tilt = math.atan(mu) + 0.2
    engine = build.engine(
        build.ground(tilt), build.block(pose=build.on_slope(tilt, 0.1), mu1=mu, mu2=mu)
    )
    engine.step(300)
    before = speed_along_slope(engine, "block", tilt)
    engine.step(1000)
    acceleration = speed_along_slope(engine, "block", tilt) - before
    wanted = build.G * (math.sin(tilt) - mu * math.cos(tilt))
    assert acceleration == pytest.approx(wanted, rel=0.02)


@pytest.mark.parametrize("mu", [0.2, 0.5, 1.0])
def test_block_on_gentle_slope_sticks(build, mu):
    tilt = math.atan(mu) - 0.03
    engine = build.engine(
        build.ground(tilt), build.block(pose=build.on_slope(tilt, 0.1), mu1=mu, mu2=mu)
    )
    engine.step(500)
    start = np.array(engine.model_pose("block").position_m)
    engine.step(10000)
    assert np.abs(engine.model_pose("block").position_m - start).max() < 2e-4


@pytest.mark.parametrize(("pair", "slides"), [((1.0, 0.1), True), ((0.1, 1.0), True)])
def test_smaller_friction_of_two_surfaces_decides(build, pair, slides):
    tilt = 0.3
    engine = build.engine(
        build.ground(tilt, mu1=pair[0], mu2=pair[0]),
        build.block(pose=build.on_slope(tilt, 0.1), mu1=pair[1], mu2=pair[1]),
    )
    engine.step(1000)
    assert (speed_along_slope(engine, "block", tilt) > 1.0) == slides


def test_friction_differs_by_direction_on_level_ground(build):
    engine = build.engine(build.ground(), build.block(mu1=0.1, mu2=0.4))
    decelerations = []
    for direction in ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0)):
        engine.reset()
        engine.step(100)
        engine.set_model_velocity("block", np.multiply(direction, 2.0), (0, 0, 0))
        engine.step(300)
        decelerations.append((2.0 - np.linalg.norm(engine.model_velocity("block")[0])) / 0.3)
    assert decelerations[0] == pytest.approx(0.1 * build.G, rel=0.03)
    assert decelerations[1] == pytest.approx(0.4 * build.G, rel=0.03)


@pytest.mark.parametrize("kp", [1e3, 1e4, 1e5])
@pytest.mark.parametrize(("limit", "tolerance_m"), [(None, 3e-6), (UNLIMITED, 0.0)])
def test_ball_sinks_its_weight_over_kp(build, kp, limit, tolerance_m):
    ball = build.ball(kp=kp, kd=50.0, max_vel_m_s=limit)
    engine = build.engine(build.ground(), ball)
    engine.step(8000)
    depth = 0.1 - engine.model_pose("ball").position_m[2]
    assert depth == pytest.approx(build.G / kp, rel=0.01, abs=tolerance_m)


def test_springs_of_two_surfaces_act_in_series(build):
    engine = build.engine(build.ground(kp=2e4, kd=20.0), build.ball(kp=2e4, kd=20.0))
    engine.step(8000)
    depth = 0.1 - engine.model_pose("ball").position_m[2]
    assert depth == pytest.approx(build.G / 1e4, rel=0.01)


def test_four_contact_points_share_the_weight(build):
    engine = build.engine(build.ground(), build.block(kp=1e4, kd=50.0))
    engine.step(8000)
    depth = 0.1 - engine.model_pose("block").position_m[2]
    assert depth == pytest.approx(2 * build.G / (4 * 1e4), rel=0.02)


def test_default_surface_sinks_less_than_a_tenth_of_a_millimetre(build):
    engine = build.engine(build.ground(), build.ball())
    engine.step(3000)
    depth = 0.1 - engine.model_pose("ball").position_m[2]
    assert depth == pytest.approx(0.03 / 0.97 * build.G / 1e4, abs=3e-6)


@pytest.mark.parametrize("overlap_m", [0.01, 0.05])
def test_bodies_placed_inside_each_other_part_without_a_leap(build, overlap_m):
    engine = build.engine(build.ground(), build.block(pose=Pose((0, 0, 0.1 - overlap_m))))
    highest_m = 0.0
    for _ in range(200):
        engine.step(5)
        highest_m = max(highest_m, engine.model_pose("block").position_m[2] - 0.1)
    assert highest_m < 0.3 * overlap_m


def test_collision_keeps_momentum(build):
    engine = build.engine(
        build.ball("left", Pose((-0.5, 0, 0)), mass=1.0),
        build.ball("right", Pose((0.5, 0, 0)), mass=3.0),
        gravity_m_s2=(0.0, 0.0, 0.0),
    )
    engine.set_model_velocity("left", (2.0, 0, 0), (0, 0, 0))
    engine.step(1000)
    left, right = (engine.model_velocity(name)[0] for name in ("left", "right"))
    assert left + 3.0 * right == pytest.approx([2.0, 0, 0], abs=1e-9)
    assert right[0] > left[0] - 1e-3 and right[0] > 0.4


@pytest.mark.parametrize("restitution", [0.3, 0.6, 0.9])
def test_ball_bounces_to_e_squared_of_its_height(build, restitution):
    bouncy = {"restitution": restitution, "bounce_threshold_m_s": 0.01}
    engine = build.engine(
        build.ground(**bouncy), build.ball(pose=Pose((0, 0, 1.1)), **bouncy), step_s=0.0005
    )
    heights = []
    for _ in range(500):
        engine.step(4)
        heights.append(engine.model_pose("ball").position_m[2] - 0.1)
    lowest = int(np.argmin(heights))
    assert max(heights[lowest:]) == pytest.approx(restitution**2, abs=0.02)


def test_default_bounce_threshold_means_no_bounce(build):
    bouncy = {"restitution": 0.9, "bounce_threshold_m_s": 100000.0}
    engine = build.engine(build.ground(**bouncy), build.ball(pose=Pose((0, 0, 1.1)), **bouncy))
    engine.step(500)
    assert max(_heights(engine, 500)) < 0.105


def _heights(engine, steps):
    for _ in range(steps):
        engine.step()
        yield engine.model_pose("ball").position_m[2]


@pytest.mark.parametrize(("shape", "share"), [("ball", 0.4), ("roller", 0.5)])
def test_rolling_without_slip_accelerates_by_inertia(build, shape, share):
    tilt = math.radians(10)
    body = getattr(build, shape)(pose=build.on_slope(tilt, 0.1))
    engine = build.engine(build.ground(tilt), body)
    engine.step(200)
    before = speed_along_slope(engine, shape, tilt)
    engine.step(1000)
    after = speed_along_slope(engine, shape, tilt)
    assert after - before == pytest.approx(build.G * math.sin(tilt) / (1 + share), rel=0.01)
    spin = engine.model_velocity(shape)[1][1]
    assert spin * 0.1 == pytest.approx(after, rel=0.01)


def test_pendulum_keeps_its_energy(build):
    engine = build.engine(build.arm())
    joint = engine.joint("arm::joint")
    joint.set_state(1.0, 0.0)

    def energy():
        return 0.5 * joint.velocity**2 + build.G * (1 - math.cos(joint.position))

    start = energy()
    worst = 0.0
    for _ in range(1000):
        engine.step(10)
        worst = max(worst, abs(energy() - start))
    assert worst < 0.01 * start


@pytest.mark.parametrize("amplitude", [0.05, 2.0])
def test_pendulum_swings_with_its_period(build, amplitude):
    from scipy.special import ellipk

    engine = build.engine(build.arm())
    joint = engine.joint("arm::joint")
    joint.set_state(amplitude)
    crossings, last = [], joint.position
    while len(crossings) < 9:
        engine.step()
        if last > 0 >= joint.position:
            crossings.append(
                engine.time_ns * 1e-9 + 1e-3 * joint.position / (last - joint.position)
            )
        last = joint.position
    period = (crossings[-1] - crossings[0]) / 8
    wanted = 4 * math.sqrt(1 / build.G) * ellipk(math.sin(amplitude / 2) ** 2)
    assert period == pytest.approx(wanted, rel=1e-3)


@pytest.mark.parametrize("limit", [-0.3, 0.7])
def test_joint_stops_at_its_limit(build, limit):
    axis = JointAxis((0, 1, 0), lower=min(limit, 0), upper=max(limit, 0), damping=0.1)
    engine = build.engine(build.arm(axis=axis, mass=0.2))
    joint = engine.joint("arm::joint")
    joint.set_effort(math.copysign(5.0, limit))
    engine.step(3000)
    assert joint.position == pytest.approx(limit, abs=2e-3)
    assert abs(joint.velocity) < 1e-3


def test_joint_damping_and_spring_make_an_oscillator(build):
    axis = {"spring_stiffness": 4.0, "spring_reference": 0.5, "damping": 0.04}
    engine = build.engine(build.wheel(inertia=0.01, **axis))
    joint = engine.joint("wheel::joint")
    engine.step(5000)
    assert joint.position == pytest.approx(0.5, abs=1e-3)
    joint.set_state(1.5, 0.0)
    engine.step(round(2 * math.pi / math.sqrt(400 - 4) * 1000))
    assert joint.position - 0.5 == pytest.approx(
        math.exp(-2 * 2 * math.pi / math.sqrt(396)), rel=0.03
    )


def test_joint_friction_holds_until_it_is_exceeded(build):
    engine = build.engine(build.wheel(inertia=0.01, friction=0.5))
    joint = engine.joint("wheel::joint")
    joint.set_effort(0.45)
    engine.step(2000)
    assert abs(joint.velocity) < 1e-3
    joint.set_effort(0.7)
    engine.step(1000)
    assert joint.velocity == pytest.approx((0.7 - 0.5) / 0.01, rel=0.01)


def test_velocity_decay_loses_its_share_each_step(build):
    from dataclasses import replace

    model = build.block()
    slowed = replace(model, links=(replace(model.links[0], linear_damping=0.01),))
    engine = build.engine(slowed, gravity_m_s2=(0.0, 0.0, 0.0))
    engine.set_model_velocity("block", (1.0, 0, 0), (0, 0, 0))
    engine.step(100)
    assert engine.model_velocity("block")[0][0] == pytest.approx(0.99**100, rel=0.01)


def test_stack_of_five_blocks_stands_and_rests(build):
    tower = [build.block(f"block{i}", Pose((0, 0, 0.1 + 0.2 * i))) for i in range(5)]
    engine = build.engine(build.ground(), *tower)
    engine.step(3000)
    assert np.abs(engine.snapshot().T[1:, :2]).max() < 1e-4
    assert (engine.data.tree_asleep >= 0).all()


def test_slow_swing_does_not_fall_asleep(build):
    engine = build.engine(build.arm())
    joint = engine.joint("arm::joint")
    joint.set_state(0.01)
    engine.step(20000)
    reached = []
    for _ in range(100):
        engine.step(25)
        reached.append(abs(joint.position))
    assert max(reached) == pytest.approx(0.01, rel=0.05)


def test_max_vel_parts_overlapping_bodies_slowly(build):
    soft = {"kp": 1e5, "kd": 1.0, "max_vel_m_s": 0.01}
    engine = build.engine(build.ground(), build.ball(pose=Pose((0, 0, 0.09)), **soft))
    highest_m_s = 0.0
    for _ in range(100):
        engine.step(5)
        highest_m_s = max(highest_m_s, float(engine.model_velocity("ball")[0][2]))
    # The overlap of 1 cm is ten times the one that max_vel is for.
    assert 0.05 < highest_m_s < 0.105


@pytest.mark.parametrize("kp", [1e3, 1e5, 1e8, 1e15])
@pytest.mark.parametrize("kd", [None, 1.0, 1e4])
def test_what_falls_onto_a_spring_is_not_thrown_back(build, kp, kd):
    engine = build.engine(build.ground(), build.ball(pose=Pose((0, 0, 1.1)), kp=kp, kd=kd))
    highest_m_s = 0.0
    for _ in range(300):
        engine.step(5)
        highest_m_s = max(highest_m_s, float(engine.model_velocity("ball")[0][2]))
    assert highest_m_s < 0.1


def test_max_vel_leaves_the_depth_at_rest_to_kp(build):
    engine = build.engine(build.ground(), build.ball(kp=2e4, kd=50.0, max_vel_m_s=0.1))
    engine.step(8000)
    depth = 0.1 - engine.model_pose("ball").position_m[2]
    assert depth == pytest.approx(build.G / 2e4, rel=0.02)


def test_a_high_max_vel_leaves_the_spring_alone(build):
    hashes = set()
    for limit in (UNLIMITED, 10 * UNLIMITED):
        surface = {"kp": 1e4, "kd": 50.0, "max_vel_m_s": limit}
        engine = build.engine(build.ground(), build.ball(**surface))
        engine.step(500)
        hashes.add(engine.state_hash())
    assert len(hashes) == 1
