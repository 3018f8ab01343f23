"""Groups of joints: arrays in, arrays out; joints held in place."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gazelle.description.model import Inertial, Joint, JointAxis, JointType, Link, Model
from gazelle.errors import EngineError, NotFoundError
from gazelle.geometry import Pose

G = 9.8


def chain(count: int = 3, name: str = "chain", **axis) -> Model:
    """Rods of 1 kg and 0.3 m, one below the other."""
    rod = Inertial(1.0, Pose((0, 0, -0.15)), (0.0075, 0, 0, 0.0075, 0, 1e-4))
    links = tuple(Link(f"l{i}", Pose((0, 0, -0.3 * i)), inertial=rod) for i in range(count))
    parents = ["world", *(f"l{i}" for i in range(count))]
    joints = tuple(
        Joint(f"j{i}", JointType.REVOLUTE, parents[i], f"l{i}", Pose((0, 0, -0.3 * i)),
              axis=JointAxis((0, 1, 0), **axis))
        for i in range(count)
    )  # fmt: skip
    return Model(name, links=links, joints=joints)


def group_of(engine, count: int = 3, name: str = "chain"):
    return engine.joint_group([f"{name}::j{i}" for i in range(count)])


def state(group):
    position, velocity = np.empty((2, len(group.names)))
    group.read(position, velocity)
    return position, velocity


def effort(group):
    out = np.empty(len(group.names))
    group.effort(out)
    return out


def test_group_reads_what_handles_read(build):
    engine = build.engine(chain())
    engine.joint("chain::j1").set_state(0.3, -0.2)
    engine.step(50)
    group = group_of(engine)
    position, velocity = state(group)
    handles = [engine.joint(name) for name in group.names]
    assert position.tolist() == [handle.position for handle in handles]
    assert velocity.tolist() == [handle.velocity for handle in handles]


def test_efforts_are_clamped_kept_and_skipped_where_nan(build):
    engine = build.engine(chain(effort=5.0))
    group = group_of(engine)
    group.set_effort(np.array([1.0, 2.0, 9.0]))
    group.set_effort(np.array([np.nan, -np.inf, np.nan]))
    engine.step(20)
    assert effort(group).tolist() == [1.0, -5.0, 5.0]
    engine.spawn(build.block(pose=Pose((9, 0, 9))))
    engine.step(1)
    assert effort(group).tolist() == [1.0, -5.0, 5.0]
    group.release([2])
    assert effort(group).tolist() == [1.0, -5.0, 0.0]


def test_infinite_effort_without_a_limit_is_refused(build):
    group = group_of(build.engine(chain()))
    with pytest.raises(EngineError, match=r"joint 'chain::j1' was given an infinite value"):
        group.set_effort(np.array([0.0, np.inf, np.nan]))


def test_unknown_and_fixed_joints_are_refused(build):
    engine = build.engine(chain())
    with pytest.raises(NotFoundError, match="chain::j1"):
        engine.joint_group(["chain::j11"])
    fixed = Joint("joint", JointType.FIXED, "world", "disc")
    engine = build.engine(replace(build.wheel(), joints=(fixed,)))
    with pytest.raises(
        EngineError, match=r"joint 'wheel::joint' \(fixed\) has no single coordinate"
    ):
        engine.joint_group(["wheel::joint"])


@pytest.mark.parametrize("damping", [0.0, 5.0])
def test_locked_joints_follow_a_moving_target_within_a_step(build, damping):
    engine = build.engine(chain(damping=damping, effort=0.1))
    group = group_of(engine)
    phase = np.array([0.0, 1.0, 2.0])
    engine.step(10)
    for k in range(300):
        target = 0.1 * np.sin(0.01 * k + phase) - 0.1 * np.sin(phase)
        group.lock_position(target)
        engine.step()
        position, velocity = state(group)
        assert position == pytest.approx(target, abs=1e-5)
        if k > 3:
            assert position == pytest.approx(target, abs=1e-7)
            assert velocity == pytest.approx(np.cos(0.01 * (k - 0.5) + phase), abs=1e-3)


def test_commands_every_tenth_step_make_an_even_motion(build):
    engine = build.engine(chain())
    group = group_of(engine)
    group.lock_position(np.zeros(3))
    engine.step()
    speeds = []
    for k in range(1, 40):
        group.lock_position(np.full(3, 0.01 * k), steps=10)
        for _ in range(10):
            engine.step()
            speeds.append(state(group)[1])
        assert state(group)[0] == pytest.approx(np.full(3, 0.01 * k), abs=1e-7)
    assert np.array(speeds) == pytest.approx(np.ones((390, 3)), abs=1e-2)
    assert np.array(speeds[5:]) == pytest.approx(np.ones((385, 3)), abs=1e-6)
    engine.step(5)
    assert state(group)[1] == pytest.approx(np.zeros(3), abs=1e-6)


def test_lock_delivers_the_torque_that_holds_against_gravity(build):
    engine = build.engine(build.arm(mass=2.0, axis=JointAxis((0, 1, 0), effort=1.0)))
    group = engine.joint_group(["arm::joint"])
    group.lock_position(np.array([0.4]))
    engine.step(20)
    load = 2.0 * G * math.sin(0.4)
    assert effort(group)[0] == pytest.approx(load, rel=1e-3)
    assert engine.joint("arm::joint").effort == pytest.approx(load, rel=1e-3)
    engine.step(3000)
    assert engine.is_asleep(engine.body_id("arm::rod"))
    assert effort(group)[0] == pytest.approx(load, rel=1e-3)
    assert state(group)[0] == pytest.approx([0.4], abs=1e-6)


def test_target_that_changes_wakes_a_sleeping_robot(build):
    engine = build.engine(chain())
    group = group_of(engine)
    group.lock_position(np.zeros(3))
    engine.step(1000)
    assert engine.is_asleep(engine.body_id("chain::l2"))
    group.lock_position(np.array([np.nan, 0.01, np.nan]))
    engine.step(3)
    assert state(group)[0] == pytest.approx([0.0, 0.01, 0.0], abs=1e-6)
    engine.step(1000)
    group.release()
    engine.step(500)
    assert abs(state(group)[0][0]) > 1e-4


def test_jump_is_taken_at_once_without_speed_and_within_limits(build):
    engine = build.engine(chain(lower=-1.0, upper=1.5))
    group = group_of(engine)
    group.lock_position(np.array([1.0, -3.0, 2.0]))
    engine.step()
    position, velocity = state(group)
    assert position == pytest.approx([1.0, -1.0, 1.5], abs=1e-5)
    assert velocity == pytest.approx(np.zeros(3), abs=1e-2)


def test_lock_pushes_back_on_what_carries_it(build):
    """Angular momentum: a free body turns against the wheel it moves."""

    def inertial(value):
        return Inertial(1.0, inertia_kg_m2=(value, 0, 0, value, 0, value))

    joint = Joint("j", JointType.CONTINUOUS, "body", "wheel", axis=JointAxis())
    links = (Link("body", inertial=inertial(0.03)), Link("wheel", inertial=inertial(0.01)))
    engine = build.engine(Model("sat", links=links, joints=(joint,)), gravity_m_s2=(0, 0, 0))
    group = engine.joint_group(["sat::j"])
    for k in range(1, 200):
        group.lock_position(np.array([0.004 * k]))
        engine.step()
    turned = engine.link("sat::body").velocity_world().angular_rad_s[2]
    assert turned == pytest.approx(-1.0, rel=1e-3)


def test_locks_and_motors_replace_each_other(build):
    engine = build.engine(chain(damping=0.3))
    group = group_of(engine)
    group.set_velocity(np.full(3, 0.5), np.full(3, np.inf))
    engine.step(100)
    assert state(group)[1] == pytest.approx(np.full(3, 0.5), abs=1e-3)
    position = state(group)[0]
    group.lock_position(position)
    engine.step(100)
    assert state(group)[0] == pytest.approx(position, abs=1e-6)
    group.set_velocity(np.full(3, -0.5), np.full(3, np.inf))
    engine.step(100)
    assert state(group)[1] == pytest.approx(np.full(3, -0.5), abs=1e-3)


def test_velocity_respects_effort_and_infinity_means_none(build):
    engine = build.engine(build.wheel(inertia=0.01, effort=0.02))
    group = engine.joint_group(["wheel::joint"])
    group.set_velocity(np.array([10.0]), np.array([5.0]))
    engine.step(500)
    assert state(group)[1] == pytest.approx([0.02 / 0.01 * 0.5], rel=1e-3)
    group.set_velocity(np.array([10.0]), np.array([np.inf]))
    engine.step(5)
    assert state(group)[1] == pytest.approx([10.0], rel=1e-3)
    assert abs(effort(group)[0]) < 0.1


def test_one_group_needs_one_recompile(build):
    engine = build.engine(chain())
    before = engine.revision
    group = group_of(engine)
    group.lock_position(np.zeros(3))
    engine.step()
    assert engine.revision == before + 1
    group.set_velocity(np.ones(3), np.full(3, 9.0))
    engine.step()
    assert engine.revision == before + 2


def test_saved_state_continues_to_the_bit_with_ramps_and_locks(build):
    engine = build.engine(chain())
    group = group_of(engine)
    group.lock_position(np.array([0.1, 0.2, np.nan]), steps=60)
    engine.step(20)
    saved = engine.save_state()
    engine.step(200)
    expected = engine.state_hash()
    group.release()
    engine.step(30)
    assert engine.state_hash() != expected
    engine.restore_state(saved)
    engine.step(200)
    assert engine.state_hash() == expected
    assert state(group)[0][:2] == pytest.approx([0.1, 0.2], abs=1e-6)


def test_locks_survive_spawning_and_deleting_others(build):
    engine = build.engine(chain(), chain(name="other"))
    other, group = group_of(engine, name="other"), group_of(engine)
    other.lock_position(np.full(3, 0.1))
    group.lock_position(np.array([0.2, 0.1, 0.0]))
    engine.step(10)
    engine.spawn(build.block(pose=Pose((9, 0, 9))))
    engine.step(100)
    engine.delete("other")
    engine.step(100)
    assert state(group)[0] == pytest.approx([0.2, 0.1, 0.0], abs=1e-6)


def test_reset_lets_locked_joints_go(build):
    engine = build.engine(build.arm())
    group = engine.joint_group(["arm::joint"])
    group.lock_position(np.array([0.5]))
    engine.step(10)
    engine.reset()
    assert state(group)[0].tolist() == [0.0]
    engine.joint("arm::joint").set_state(0.5)
    engine.step(500)
    assert state(group)[0][0] < 0.1


def test_handle_locks_and_releases_one_joint(build):
    engine = build.engine(build.arm())
    joint = engine.joint("arm::joint")
    joint.lock_position(0.3)
    engine.step(100)
    assert joint.position == pytest.approx(0.3, abs=1e-6)
    joint.release()
    engine.step(300)
    assert joint.position < 0.2


def test_lock_holds_a_joint_where_it_was_put(build):
    engine = build.engine(build.arm())
    joint = engine.joint("arm::joint")
    joint.lock_position(0.3)
    engine.step(10)
    joint.set_state(-0.5, 0.0)
    engine.step(100)
    assert joint.position == pytest.approx(-0.5, abs=1e-5)


def test_ramp_needs_a_step(build):
    group = group_of(build.engine(chain()))
    with pytest.raises(EngineError, match="at least one step"):
        group.lock_position(np.zeros(3), steps=0)


def test_attached_links_move_as_one_until_detached(build):
    engine = build.engine(build.block("a", Pose((0, 0, 5))), build.block("b", Pose((0.5, 0, 5))))
    before = engine.link("a::link").T_world_link().inverse() @ engine.link("b::link").T_world_link()
    engine.attach("a::link", "b::link")
    engine.link("a::link").apply_wrench((0.0, 0.0, 200.0), (0.0, 5.0, 0.0))
    engine.step(300)
    now = engine.link("a::link").T_world_link().inverse() @ engine.link("b::link").T_world_link()
    assert now.position_m == pytest.approx(before.position_m, abs=1e-3)
    assert now.quat_xyzw == pytest.approx(before.quat_xyzw, abs=1e-3)
    engine.detach("b::link", "a::link")
    engine.step(100)
    falling = engine.link("b::link").acceleration_world().linear_m_s2
    assert falling == pytest.approx([0.0, 0.0, -G], abs=1e-6)


def test_attachments_survive_recompiles_and_end_with_their_models(build):
    engine = build.engine(build.block("a", Pose((0, 0, 5))), build.block("b", Pose((0.5, 0, 5))))
    engine.attach("a::link", "b::link")
    saved = engine.save_state()
    engine.spawn(build.ball("c", Pose((9, 9, 9))))
    engine.link("a::link").apply_wrench((50.0, 0, 0), (0, 0, 0))
    engine.step(200)
    assert engine.link("b::link").velocity_world().linear_m_s[0] > 0.5
    engine.delete("a")
    engine.step(1)
    engine.restore_state(saved)
    engine.step(1)
    with pytest.raises(EngineError, match="cannot be attached to itself"):
        engine.attach("a::link", "a::link")


def test_same_velocity_is_sent_again_after_a_reset_or_release(build):
    engine = build.engine(chain())
    group = group_of(engine)
    for end in (engine.reset, engine.joint("chain::j0").release):
        group.set_velocity(np.full(3, 0.5), np.full(3, 1e3))
        engine.step(5)
        end()
        group.set_velocity(np.full(3, 0.5), np.full(3, 1e3))
        engine.step(5)
        assert state(group)[1] == pytest.approx(np.full(3, 0.5), abs=1e-2)


def test_empty_group_does_nothing(build):
    engine = build.engine(chain())
    group = engine.joint_group([])
    group.lock_position(np.zeros(0))
    group.set_effort(np.zeros(0))
    group.set_velocity(np.zeros(0), np.zeros(0))
    engine.step(5)
    assert [len(values) for values in state(group)] == [0, 0]
    assert len(effort(group)) == 0


def test_sleeping_arm_still_weighs_on_its_joint(build):
    engine = build.engine(build.arm(mass=2.0))
    joint = engine.joint("arm::joint")
    joint.lock_position(math.pi / 2)
    engine.step(2000)
    assert engine.is_asleep(engine.body_id("arm::rod"))
    wrench = joint.reaction_wrench()
    assert wrench.force_n == pytest.approx([0.0, 0.0, 2 * G], abs=1e-3)
    assert abs(wrench.torque_nm[1]) == pytest.approx(2 * G, rel=1e-3)
    assert engine.link("arm::rod").acceleration_world().linear_m_s2.tolist() == [0.0, 0.0, 0.0]


def test_efforts_of_a_moving_robot_do_not_wake_others(build, monkeypatch):
    alone = build.engine(chain())
    beside = build.engine(chain(), chain(name="resting"))
    resting = group_of(beside, name="resting")
    resting.set_velocity(np.zeros(3), np.full(3, 50.0))
    beside.step(500)
    alone.step(500)
    assert beside.is_asleep(beside.body_id("resting::l1"))
    monkeypatch.setattr("gazelle.engine.engine.waking_copy", pytest.fail)
    efforts = []
    for engine in (alone, beside):
        moving = group_of(engine)
        for index in range(3):
            engine.joint(f"chain::j{index}").set_state(0.0, 0.0)
        moving.set_velocity(np.full(3, 0.4), np.full(3, 50.0))
        engine.step(20)
        efforts.append(effort(moving))
    assert np.abs(efforts[0]).max() > 0.1
    assert efforts[1] == pytest.approx(efforts[0], rel=1e-9)


def test_resting_robot_is_not_woken_by_a_speed_at_which_it_would_rest_again(build):
    """A position servo leaves such speeds: a loaded motor creeps a little."""
    engine = build.engine(chain())
    group = group_of(engine)
    group.set_velocity(np.zeros(3), np.full(3, 50.0))
    engine.step(500)
    assert engine.is_asleep(engine.body_id("chain::l1"))
    group.set_velocity(np.array([1e-5, -1e-5, 0.0]), np.full(3, 50.0))
    engine.step(5)
    assert engine.is_asleep(engine.body_id("chain::l1"))
    group.set_velocity(np.array([1e-3, 0.0, 0.0]), np.full(3, 50.0))
    engine.step(100)
    assert state(group)[1][0] == pytest.approx(1e-3, rel=1e-2)


def test_only_joints_whose_velocity_changes_get_a_new_command(build, monkeypatch):
    engine = build.engine(chain())
    group = group_of(engine)
    group.set_velocity(np.full(3, 0.1), np.full(3, 50.0))
    engine.step()
    group.set_velocity(np.array([0.1, 0.2, np.nan]), np.full(3, 50.0))
    sent = []
    command = engine.command_motor
    monkeypatch.setattr(
        engine, "command_motor", lambda *row: (sent.append(row[1].target), command(*row))
    )
    group.set_velocity(np.array([0.1, 0.3, np.nan]), np.full(3, 50.0))
    assert sent == [0.3]
    group.set_velocity(np.array([np.nan, np.nan, 0.4]), np.full(3, 50.0))
    group.set_velocity(np.array([0.1, 0.3, 0.4]), np.full(3, 50.0))
    assert sent == [0.3, 0.4]


def test_feedback_is_a_damper_about_its_effort_on_light_and_heavy_joints(build):
    for inertia in (1e-9, 1e-6, 1e-2):
        engine = build.engine(build.wheel(inertia=inertia))
        group = engine.joint_group(["wheel::joint"])
        one = np.ones(1)
        group.set_feedback([0], 2.0 * one, 0.5 * one, -10.0 * one, 10.0 * one)
        engine.step(1)
        own = max(inertia, 0.5 * 1e-3 / 9000.0)
        assert engine.joint("wheel::joint").velocity == pytest.approx(
            2.0 / (own / 1e-3 + 0.5), rel=1e-3
        )
        engine.step(20)
        group.end_feedback([0])
        speed = engine.joint("wheel::joint").velocity
        engine.step(5)
        assert engine.joint("wheel::joint").velocity == pytest.approx(speed, rel=1e-3)


def test_feedback_stays_within_its_own_bounds(build):
    engine = build.engine(build.wheel(inertia=1e-2))
    group = engine.joint_group(["wheel::joint"])
    one = np.ones(1)
    group.set_feedback([0], 500.0 * one, 0.5 * one, -3.0 * one, 1.0 * one)
    engine.step(10)
    assert engine.joint("wheel::joint").velocity == pytest.approx(10e-3 * 1.0 / 1e-2, rel=1e-3)
    effort = np.empty(1)
    group.effort(effort)
    assert effort[0] == pytest.approx(1.0, rel=1e-6)


def test_one_joint_takes_a_feedback_and_plain_efforts_in_turn(build):
    engine = build.engine(build.wheel(inertia=1e-6))
    joint = engine.joint("wheel::joint")
    for _ in range(50):
        joint.set_feedback(-100.0 * (joint.position - 0.3) - 10.0 * joint.velocity, 100.0, 10.0)
        engine.step()
    before = joint.position
    joint.set_feedback(0.0, 0.0, 0.0)
    engine.step(10)
    assert 0.0 < before < 0.3
    assert joint.effort == 0.0
    joint.set_state(velocity=0.0)
    joint.set_feedback(1e-6, 0.0, 0.0)
    engine.step(10)
    assert joint.velocity == pytest.approx(0.01, rel=1e-6)
