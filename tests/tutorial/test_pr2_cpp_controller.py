"""The document's own controller class in C++, in the document's launch (P5)."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.cpp.compiled_ahead import compile_ahead
from tests.cpp.control.controller_package import init_of_document, write_controller_package
from tests.cpp.shared_cache import shared_cpp_cache  # noqa: F401 - a fixture

pytestmark = pytest.mark.tutorial

LAUNCH = """\
<launch>
  <include file="$(find tutorial_controller)/robot.launch"/>
  <rosparam file="$(find tutorial_controller)/controller.yaml" command="load"/>
  <node pkg="pr2_controller_manager" type="spawner" name="spawn_controller" output="screen"
        args="my_controller_ns"/>
</launch>
"""


@pytest.fixture
def workspace(tmp_path: Path, shared_dir: Path, workspaces_dir: Path) -> Path:
    """The document's robot, as it is, beside a rosbuild package with the document's class."""
    folder = tmp_path / "ros_workspace"
    seed = next((shared_dir / "seeds").glob("003_*.txt")).read_text(encoding="utf-8")
    package = write_controller_package(folder / "src", init_of_document(seed))
    (package / "my_controller.launch").write_text(LAUNCH)
    shutil.copytree(
        workspaces_dir / "catkin_ws/src/tutorial_controller", folder / "src/tutorial_controller"
    )
    compile_ahead(folder, "my_controller_pkg", libraries=["my_controller_lib"], runtime=["control"])
    return folder


def test_the_documents_class_turns_the_wheel_with_gains_that_can_be_changed(
    gazelle: Callable[..., Any], workspace: Path
) -> None:
    robot = gazelle("roslaunch", "my_controller_pkg", "my_controller.launch", cwd=workspace)
    robot.wait_for_line("Started controllers: my_controller_ns")

    def turns() -> bool:
        joint = robot.call(
            "/gazebo/get_joint_properties",
            "gazebo_msgs/srv/GetJointProperties",
            joint_name="joint_w1",
        )
        return bool(joint.success and joint.rate and abs(joint.rate[0] - 0.5) < 0.1)

    robot.eventually(turns)
    answer = robot.call(
        "/my_controller_ns/pid_steer/set_parameters",
        "dynamic_reconfigure/srv/Reconfigure",
        config={"doubles": [{"name": "p", "value": 40.0}]},
    )
    assert {one.name: one.value for one in answer.config.doubles}["p"] == pytest.approx(40.0)
    told = robot.messages({"/my_controller_ns/pid_steer/parameter_updates": 1})
    updates = told["/my_controller_ns/pid_steer/parameter_updates"]
    assert {one.name: one.value for one in updates[-1].doubles}["p"] == pytest.approx(40.0)
    # The class's own subscription: the wheel turns the other way.
    robot.publish("/my_controller_ns/command", "std_msgs/Float64", data=-0.5)

    def turns_back() -> bool:
        joint = robot.call(
            "/gazebo/get_joint_properties",
            "gazebo_msgs/srv/GetJointProperties",
            joint_name="joint_w1",
        )
        return bool(joint.success and joint.rate and abs(joint.rate[0] + 0.5) < 0.1)

    robot.eventually(turns_back)
