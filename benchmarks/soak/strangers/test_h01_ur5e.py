"""The UR5e's description: a launch of ROS 2 with arguments of fixed choices (Humble)."""

from __future__ import annotations

import pytest
from stage import Stage, robot_parts

VIEW = "ros2 launch ur_description view_ur.launch.py"
XACRO = "xacro ws/src/ur_description/urdf/ur.urdf.xacro ur_type:=ur5e name:=ur"
MOVING = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")


def test_xacro_gives_13_links_of_21_7_kg(stage: Stage) -> None:
    expanded = stage.run(XACRO)
    assert expanded.code == 0, expanded.output
    parts = robot_parts(expanded.stdout)
    assert (len(parts.links), len(parts.joints)) == (13, 12)
    assert parts.kinds == {"revolute": 6, "fixed": 6}
    assert {f"{name}_joint" for name in MOVING} <= set(parts.joints)
    assert parts.root == "world"
    assert parts.mass_kg == pytest.approx(21.70, abs=0.01)


def test_check_urdf_takes_what_xacro_gives(stage: Stage) -> None:
    checked = stage.run("check_urdf /dev/stdin", stdin=stage.run(XACRO).stdout)
    assert checked.code == 0, checked.output
    assert "robot name is: ur\n" in checked.stdout
    assert "root Link: world has 1 child(ren)\n" in checked.stdout


def test_the_launch_gives_the_frames_of_the_arm(stage: Stage) -> None:
    with stage.launch(f"{VIEW} ur_type:=ur5e") as view:
        # joint_state_publisher_gui starts in the middle of the limits, which is 0 for all of them.
        assert sorted(view.joints()) == sorted(f"{name}_joint" for name in MOVING)
        assert view.tf("world", "tool0").position_m == pytest.approx(
            (0.8172, 0.2329, 0.0628), abs=1e-4
        )
        # The default of tf_prefix is two quotes, which a shell would take away.
        view.tf("base_link", "wrist_3_link")
        assert not view.said('""')


def test_a_missing_argument_is_told_by_name(stage: Stage) -> None:
    missing = stage.run(VIEW)
    assert missing.code != 0
    # `ros2 launch` includes the file, so this is how its text begins since Humble.
    assert "Included launch description missing required argument 'ur_type'" in missing.output


def test_a_value_that_is_no_choice_is_told_with_the_choices(stage: Stage) -> None:
    wrong = stage.run(f"{VIEW} ur_type:=foo")
    assert wrong.code != 0
    assert (
        'Argument "ur_type" provided value "foo" is not valid. '
        "Valid options are: ['ur3', 'ur3e', 'ur5'," in wrong.output
    )
