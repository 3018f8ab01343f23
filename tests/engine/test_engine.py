"""The engine's life: names, spawn and delete, state, snapshots, wrenches, divergence."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gazelle.description.model import Inertial, Joint, JointAxis, JointType, Link, Model
from gazelle.diagnostics import SourceSpan
from gazelle.errors import EngineError, NotFoundError, SimulationDivergedError
from gazelle.geometry import Pose


def test_missing_link_names_the_nearest(build):
    engine = build.engine(build.ground(), build.block())
    with pytest.raises(NotFoundError, match="link 'block::lnk' not found; did you mean 'block::l"):
        engine.link("block::lnk")


def test_missing_joint_names_the_nearest(build):
    engine = build.engine(build.arm())
    with pytest.raises(NotFoundError, match="did you mean 'arm::joint'"):
        engine.joint("arm::jiont")


def test_joint_with_unknown_link_is_refused(build):
    model = Model("bad", links=(Link("a"),), joints=(Joint("j", JointType.FIXED, "a", "b"),))
    with pytest.raises(NotFoundError, match="joint 'j' names it as its child"):
        build.engine(model)


def test_two_engines_give_the_same_hash(build):
    def run():
        engine = build.engine(build.ground(), build.block(pose=Pose((0, 0, 0.3))), build.arm())
        engine.joint("arm::joint").set_velocity_target(2.0, 5.0)
        engine.step(700)
        engine.spawn(build.ball(pose=Pose((0.05, 0, 0.6))))
        engine.step(700)
        return engine.state_hash()

    assert run() == run()


def test_chunks_of_steps_do_not_change_the_state(build):
    engines = [build.engine(build.ground(), build.block(pose=Pose((0, 0, 0.3)))) for _ in range(2)]
    engines[0].step(600)
    for _ in range(600):
        engines[1].step()
    assert engines[0].state_hash() == engines[1].state_hash()


def test_reading_does_not_change_the_state(build):
    engines = [build.engine(build.ground(), build.block(pose=Pose((0, 0, 0.3)))) for _ in range(2)]
    for _ in range(60):
        for engine in engines:
            engine.step(10)
        engines[1].snapshot()
        engines[1].contacts()
        engines[1].link("block::link").velocity_world()
        engines[1].link("block::link").acceleration_world()
    assert engines[0].state_hash() == engines[1].state_hash()


def test_spawn_and_delete_keep_the_state_of_others(build):
    engine = build.engine(build.arm())
    joint = engine.joint("arm::joint")
    joint.set_state(0.7, 0.3)
    engine.step(10)
    before = (joint.position, joint.velocity, engine.time_ns)
    revision = engine.revision
    engine.spawn(build.block(), name="crate", T_world_model=Pose((3, 0, 5)))
    assert (joint.position, joint.velocity, engine.time_ns) == before
    assert engine.revision > revision
    assert engine.world.model("crate") is not None
    assert engine.model_pose("crate").position_m == pytest.approx((3, 0, 5))
    engine.delete("crate")
    assert (joint.position, joint.velocity, engine.time_ns) == before
    assert engine.link_names == ("arm::rod",)


def test_spawned_model_does_not_disturb_the_motion_of_others(build):
    lone, sharing_bits = build.engine(build.arm()), build.engine(build.arm())
    for engine in (lone, sharing_bits):
        engine.joint("arm::joint").set_state(1.0)
        engine.step(100)
    sharing_bits.spawn(build.block(pose=Pose((50, 0, 5))))
    for engine in (lone, sharing_bits):
        engine.step(500)
    assert sharing_bits.joint("arm::joint").position == lone.joint("arm::joint").position


def test_taken_name_is_refused_in_gazebos_words(build):
    engine = build.engine(build.block())
    with pytest.raises(EngineError, match="model name block already exist"):
        engine.spawn(build.block())


def test_deleting_an_unknown_model_names_the_nearest(build):
    engine = build.engine(build.block())
    with pytest.raises(NotFoundError, match="model 'blok' not found; did you mean 'block'"):
        engine.delete("blok")


def test_deleted_models_motor_and_effort_are_gone(build):
    engine = build.engine(build.wheel(), build.block())
    engine.joint("wheel::joint").set_velocity_target(3.0, 1.0)
    engine.joint("wheel::joint").set_effort(0.2)
    engine.step(10)
    engine.delete("wheel")
    engine.step(10)
    engine.spawn(build.wheel())
    engine.step(10)
    assert engine.joint("wheel::joint").velocity == 0.0


def test_saved_state_comes_back_to_the_bit(build):
    engine = build.engine(build.ground(), build.block(pose=Pose((0, 0, 0.3))), build.wheel())
    engine.joint("wheel::joint").set_velocity_target(3.0, 0.01)
    engine.step(200)
    saved = engine.save_state()
    engine.step(500)
    first = engine.state_hash()
    engine.delete("block")
    engine.step(5)
    engine.restore_state(saved)
    assert engine.time_ns == 200_000_000
    engine.step(500)
    assert engine.state_hash() == first


def test_reset_brings_back_poses_joints_and_time(build):
    arm = build.arm(axis=JointAxis((0, 1, 0), position=0.4))
    engine = build.engine(arm, build.block(pose=Pose((0, 0, 2))))
    assert engine.joint("arm::joint").position == 0.4
    engine.joint("arm::joint").set_effort(3.0)
    engine.step(300)
    engine.reset()
    assert engine.time_ns == 0
    assert engine.joint("arm::joint").position == 0.4
    assert engine.joint("arm::joint").effort == 0.0
    assert engine.model_pose("block").position_m == pytest.approx((0, 0, 2))


def test_reset_of_poses_can_leave_time_alone(build):
    engine = build.engine(build.block(pose=Pose((0, 0, 2))))
    engine.step(300)
    engine.reset(time=False)
    assert engine.time_ns == 300_000_000
    assert engine.model_pose("block").position_m[2] == pytest.approx(2.0)


def test_snapshot_shows_poses_of_now(build):
    engine = build.engine(build.block(pose=Pose((0, 0, 10))))
    engine.set_model_velocity("block", (1.0, 0, 0), (0, 0, 0.5))
    engine.step(1000)
    snapshot = engine.snapshot()
    assert snapshot.link_names == ("block::link",)
    assert snapshot.time_ns == 1_000_000_000
    assert snapshot.T.shape == (1, 7)
    assert snapshot.T[0, 0] == pytest.approx(1.0)
    assert snapshot.T[0, 3:] == pytest.approx([0, 0, math.sin(0.25), math.cos(0.25)])
    with pytest.raises(ValueError, match="read-only"):
        snapshot.T[0, 0] = 1.0


def test_wrench_acts_for_its_duration_only(build):
    engine = build.engine(build.block(), gravity_m_s2=(0, 0, 0))
    engine.link("block::link").apply_wrench((4.0, 0, 0), duration_ns=100_000_000)
    engine.step(1000)
    assert engine.model_velocity("block")[0] == pytest.approx([0.2, 0, 0], rel=1e-9)


def test_wrench_at_a_point_turns_the_link(build):
    engine = build.engine(build.block(), gravity_m_s2=(0, 0, 0))
    engine.link("block::link").apply_wrench(
        (1.0, 0, 0), point_link_m=(0, 0.1, 0), duration_ns=10_000_000
    )
    engine.step(100)
    assert engine.model_velocity("block")[1][2] == pytest.approx(-0.1 * 0.01 / (2 * 0.04 / 6))


def test_wrench_without_duration_acts_until_cleared(build):
    engine = build.engine(build.block(), gravity_m_s2=(0, 0, 0))
    link = engine.link("block::link")
    link.apply_wrench((2.0, 0, 0))
    engine.step(500)
    link.clear_wrenches()
    engine.step(500)
    assert engine.model_velocity("block")[0][0] == pytest.approx(0.5)


def test_contact_forces_carry_the_weight_even_asleep(build):
    engine = build.engine(build.ground(), build.block())
    engine.step(3000)
    assert engine.is_asleep(engine.body_id("block::link"))
    (contact,) = engine.contacts()
    names = {contact.collision1, contact.collision2}
    assert names == {"ground::link::collision", "block::link::box"}
    sign = 1.0 if contact.collision1 == "block::link::box" else -1.0
    assert sign * contact.forces_n.sum(axis=0) == pytest.approx([0, 0, 2 * build.G], abs=0.05)
    assert sign * contact.normals[:, 2] == pytest.approx(1.0)
    assert (contact.depths_m > 0).all() and len(contact.points_m) == 4


def test_acceleration_is_zero_at_rest_and_gravity_in_free_fall(build):
    engine = build.engine(build.ground(), build.block(), build.ball(pose=Pose((2, 0, 9))))
    engine.step(500)
    assert engine.link("block::link").acceleration_world().linear_m_s2 == pytest.approx(
        [0, 0, 0], abs=1e-4
    )
    assert engine.link("ball::link").acceleration_world().linear_m_s2 == pytest.approx(
        [0, 0, -build.G]
    )


def test_joint_reaction_carries_the_hanging_weight(build):
    engine = build.engine(build.arm(mass=3.0))
    engine.step(10)
    wrench = engine.joint("arm::joint").reaction_wrench()
    assert wrench.force_n == pytest.approx([0, 0, 3 * build.G], abs=1e-6)
    assert wrench.torque_nm == pytest.approx([0, 0, 0], abs=1e-6)


def test_set_link_pose_moves_the_whole_robot(build):
    tip = Link("tip", Pose((1, 0, 0)), inertial=Inertial(1.0))
    joint = Joint("j", JointType.CONTINUOUS, "base", "tip", Pose((1, 0, 0)), axis=JointAxis())
    robot = Model("robot", Pose((0, 0, 1)), links=(Link("base", inertial=Inertial(1.0)), tip),
                  joints=(joint,))  # fmt: skip
    engine = build.engine(robot)
    engine.link("robot::tip").set_pose(Pose((5, 5, 5)))
    assert engine.link("robot::base").T_world_link().position_m == pytest.approx((4, 5, 5))
    assert engine.model_pose("robot").position_m == pytest.approx((4, 5, 5))


def test_static_model_can_be_moved(build):
    engine = build.engine(build.ground(), build.block())
    engine.set_model_pose("ground", Pose((0, 0, -1)))
    engine.step(1000)
    assert engine.model_pose("ground").position_m == (0, 0, -1)
    assert engine.model_pose("block").position_m[2] == pytest.approx(-0.9, abs=1e-3)


def test_pushing_a_fixed_model_is_refused(build):
    engine = build.engine(build.ground())
    with pytest.raises(EngineError, match="fixed to the world and cannot be pushed"):
        engine.set_model_velocity("ground", (1, 0, 0), (0, 0, 0))


def test_gravity_change_wakes_sleepers(build):
    engine = build.engine(build.ground(), build.block())
    engine.step(2000)
    engine.set_gravity((0.0, 0.0, 2.0))
    engine.step(1000)
    assert engine.model_pose("block").position_m[2] == pytest.approx(1.1, abs=0.01)


def test_step_size_change_keeps_state_and_contacts(build):
    engine = build.engine(build.ground(), build.block())
    engine.step(500)
    engine.set_step_size(2_000_000)
    engine.step(1000)
    assert engine.time_ns == 2_500_000_000
    assert engine.model_pose("block").position_m[2] == pytest.approx(0.1, abs=2e-4)
    with pytest.raises(EngineError, match="longer than 0 ns"):
        engine.set_step_size(0)


def test_handles_survive_spawning(build):
    engine = build.engine(build.arm(name="zeta"))
    handle, link = engine.joint("zeta::joint"), engine.link("zeta::rod")
    engine.spawn(build.wheel(name="alpha"))
    handle.set_state(0.3)
    assert handle.position == 0.3
    assert link.T_world_link().rpy_rad[1] == pytest.approx(0.3)


def test_divergence_names_link_and_place(build, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    feather = Inertial(1e-9, inertia_kg_m2=(1e-14, 0, 0, 1e-14, 0, 1e-14))
    span = SourceSpan("robot.urdf", 12, 3)
    links = (Link("a", inertial=Inertial(1.0)), Link("b", inertial=feather, span=span))
    joint = Joint("j", JointType.PRISMATIC, "a", "b", axis=JointAxis())
    engine = build.engine(Model("bad", links=links, joints=(joint,)))
    engine.joint("bad::j").set_effort(1e6)
    with pytest.raises(SimulationDivergedError, match=r"link 'bad::b' \(robot.urdf:12:3\)"):
        engine.step(1000)
    assert list(tmp_path.iterdir()) == []


def test_kinematic_link_keeps_its_velocity(build):
    from dataclasses import replace

    model = build.block(pose=Pose((0, 0, 0.5)))
    belt = replace(model, links=(replace(model.links[0], kinematic=True),))
    engine = build.engine(build.ground(), belt, build.ball("ball", Pose((0, 0, 0.9))))
    engine.set_model_velocity("block", (0.1, 0, 0), (0, 0, 0))
    engine.step(1000)
    assert engine.model_pose("block").position_m == pytest.approx((0.1, 0, 0.5), abs=1e-4)


def test_links_without_gravity_float(build):
    from dataclasses import replace

    model = build.block(pose=Pose((0, 0, 1)))
    floating = replace(model, links=(replace(model.links[0], gravity=False),))
    engine = build.engine(floating)
    engine.step(1000)
    assert engine.model_pose("block").position_m[2] == pytest.approx(1.0)


def test_velocity_of_a_link_is_that_of_its_origin(build):
    engine = build.engine(build.arm())
    joint = engine.joint("arm::joint")
    joint.set_state(0.0, 2.0)
    link = engine.link("arm::rod")
    assert link.velocity_world().linear_m_s == pytest.approx([0, 0, 0])
    assert link.velocity_world().angular_rad_s == pytest.approx([0, 2, 0])
    assert link.com_velocity_world().linear_m_s == pytest.approx([-2, 0, 0])
    assert np.allclose(link.com_world(), [0, 0, -1])
    assert link.mass_kg == 1.0


def test_warnings_of_the_library_become_findings(build, tmp_path, monkeypatch):
    """MuJoCo would print them and write a file."""
    from gazelle.engine.mujoco_library import mujoco

    monkeypatch.chdir(tmp_path)
    engine = build.engine(build.block())
    mujoco.get_mju_user_warning()("Too many contacts.\nEither the arena memory is full")
    engine.step()
    engine.step()
    (finding,) = engine.diagnostics.by_code("engine.mujoco-warning")
    assert finding.message == ("MuJoCo warns: Too many contacts. Either the arena memory is full")
    assert list(tmp_path.iterdir()) == []


def test_joint_limits_that_meet_lock_the_joint(build):
    engine = build.engine(build.arm(axis=JointAxis((0, 1, 0), lower=0.3, upper=0.3)))
    engine.step(2000)
    assert engine.joint("arm::joint").position == pytest.approx(0.3, abs=1e-5)


def test_two_models_of_one_name_are_one_clear_error(build):
    with pytest.raises(EngineError, match="two models are named 'ball'; names in a world are"):
        build.engine(build.ball(), build.ball())


def test_worlds_of_thousands_of_models_can_be_stepped(build):
    shelves = [
        replace(build.block(f"b{at}", Pose((at % 50, at // 50, 0.5))), static=True)
        for at in range(2000)
    ]
    engine = build.engine(build.ground(), *shelves, build.block(pose=Pose((-2, 0, 0.1))))
    engine.step(2)
    assert engine.time_ns == 2 * engine.step_ns
