"""Models of gazebo_models with closed loops, screws and nested includes, in a world of theirs."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from typing import Any

import pytest
from stage import Stage

# The node of ROS gives poses and speeds of links.
WORLD = "gzserver -s libgazebo_ros_api_plugin.so h29.world"
GRAVITY = 9.8
FALLING = "pr2_gripper::torso_lift_motor_screw_link"
"""It has neither a joint nor a shape, so that it falls for ever."""


def parts(stage: Stage, name: str) -> tuple[list[str], list[str]]:
    """Return the names of links and the types of joints of a model, as `gz sdf -p` prints it."""
    done = stage.run(f"gz sdf -p gazebo_models/{name}/model.sdf")
    assert done.code == 0, done.output
    model = ET.fromstring(done.stdout).find("model")
    assert model is not None
    return (
        [str(one.get("name")) for one in model.findall("link")],
        [str(one.get("type")) for one in model.findall("joint")],
    )


def energy_j(states: Any) -> float:
    """Return the energy of the pendulum: links of 1 kg and 1 kg m², 0.5 m from their origins."""
    total = 0.0
    for link in ("upper_link", "lower_link"):
        at = states.name.index(f"double_pendulum_with_base::{link}")
        pose, twist = states.pose[at], states.twist[at]
        q = pose.orientation
        # The third column of the rotation: where the link's z points.
        z = (
            2.0 * (q.x * q.z + q.w * q.y),
            2.0 * (q.y * q.z - q.w * q.x),
            1.0 - 2.0 * (q.x**2 + q.y**2),
        )
        arm = tuple(0.5 * one for one in z)
        w = (twist.angular.x, twist.angular.y, twist.angular.z)
        v = (
            twist.linear.x + w[1] * arm[2] - w[2] * arm[1],
            twist.linear.y + w[2] * arm[0] - w[0] * arm[2],
            twist.linear.z + w[0] * arm[1] - w[1] * arm[0],
        )
        total += 0.5 * sum(one * one for one in v)
        total += 0.5 * sum(one * one for one in w) + GRAVITY * (pose.position.z + arm[2])
    return total


@pytest.mark.parametrize(
    ("name", "links", "joints", "kinds"),
    [
        ("pr2_gripper", 10, 13, {"screw": 2}),
        ("pr2", 48, 58, {"screw": 5}),
        ("cart_front_steer", 5, 4, {"universal": 2}),
        ("double_pendulum_with_base", 3, 2, {"revolute": 2}),
        (
            "demo_joint_types", None, 18,
            {"revolute": 3, "gearbox": 1, "revolute2": 1, "prismatic": 1, "ball": 1, "screw": 1,
             "universal": 1, "fixed": 9},
        ),
    ],
)  # fmt: skip
def test_links_and_joints_are_all_there(
    stage: Stage, name: str, links: int | None, joints: int, kinds: dict[str, int]
) -> None:
    there, types = parts(stage, name)
    assert links is None or len(there) == links
    assert len(types) == joints
    assert {kind: types.count(kind) for kind in kinds} == kinds


def test_links_of_nested_models_have_their_models_names(stage: Stage) -> None:
    done = stage.run("gz sdf -p gazebo_models/turtlebot/model.sdf")
    assert "create::base" in done.stdout
    assert "kinect::link" in done.stdout
    done = stage.run("gz sdf -p gazebo_models/simple_arm_gripper/model.sdf")
    assert "simple_arm::arm_wrist_roll" in done.stdout
    assert "simple_gripper::riser" in done.stdout


def test_every_model_is_checked(stage: Stage) -> None:
    names = sorted(one.name for one in (stage.folder / "gazebo_models").iterdir() if one.is_dir())
    assert len(names) == 31
    for name in names:
        if not (stage.folder / f"gazebo_models/{name}/model.sdf").is_file():
            continue
        done = stage.run(f"gz sdf -k gazebo_models/{name}/model.sdf")
        assert done.code == 0, f"{name}: {done.output}"
        assert "Check complete" in done.output, name


def test_the_newest_sun_is_taken(stage: Stage) -> None:
    world = stage.home / "sun.world"
    world.write_text(
        '<sdf version="1.6"><world name="w"><include><uri>model://sun</uri></include></world></sdf>'
    )
    done = stage.run(f"gz sdf -p {world}")
    text = ET.parse(stage.folder / "gazebo_models/sun/model.sdf").getroot()
    newest = text.findtext("light/attenuation/constant")
    assert done.code == 0, done.output
    light = ET.fromstring(done.stdout).find(".//light")
    assert light is not None
    assert float(light.findtext("attenuation/constant", "")) == float(newest or "")


def test_the_world_of_loops_runs_and_stays_finite(stage: Stage) -> None:
    with stage.launch(WORLD) as world:
        states = world.topic("/gazebo/link_states")
        first = states.next()
        begun = energy_j(first)
        energies = [begun]
        lows = []
        end_s = 10.0
        world.wait_until(0.001)
        while world.sim_time_s < end_s:
            message = states.next(30.0)
            energies.append(energy_j(message))
            at = message.name.index("double_pendulum_with_base::lower_link")
            lows.append(message.pose[at].position.y)
            for name, pose in zip(message.name, message.pose, strict=True):
                place = pose.position
                assert math.isfinite(place.x + place.y + place.z), name
                assert abs(place.z) < 20.0 or name == FALLING, (name, place)
        # It swings, and gains nothing.
        assert max(lows) - min(lows) > 0.3
        assert max(energies) <= begun + 0.02 * abs(begun)
        message = states.next(30.0)
        names = set(message.name)
        for link in (
            "pr2_gripper::r_wrist_roll_link", "pr2_gripper::r_gripper_motor_screw_link",
            "simple_arm_gripper::simple_arm::arm_wrist_roll",
            "simple_arm_gripper::simple_gripper::riser",
            "turtlebot::rack", "turtlebot::create::base", "turtlebot::kinect::link",
        ):  # fmt: skip
            assert link in names, sorted(names)
        x, y, z, *_ = stage.place("pioneer2dx")
        assert (x, y) == pytest.approx((3.0, 0.0), abs=0.02)
        assert abs(z) < 0.05
        x, y, z, *_ = stage.place("coke_can")
        assert (x, y) == pytest.approx((-2.0, -2.0), abs=0.05)
        assert abs(z) < 0.05
        # A type of joint that is not simulated is told once.
        for kind in ("gearbox", "screw"):
            assert len(world.said(rf"demo_joint_types.*{kind}")) <= 1, world.said(kind)
        assert world.exit_code is None
