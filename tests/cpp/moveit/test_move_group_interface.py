"""A program of ROS 2 in C++ plans and moves an arm by MoveGroupInterface."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.cpp.compiled_ahead import compile_ahead

MANIFEST = """\
<package format="3"><name>hello_heron</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<buildtool_depend>ament_cmake</buildtool_depend>
<depend>rclcpp</depend><depend>moveit_ros_planning_interface</depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
CMAKE = """\
cmake_minimum_required(VERSION 3.8)
project(hello_heron)
find_package(ament_cmake REQUIRED)
find_package(moveit_ros_planning_interface REQUIRED)
find_package(rclcpp REQUIRED)
add_executable(hello src/hello.cpp)
ament_target_dependencies(hello moveit_ros_planning_interface rclcpp)
install(TARGETS hello DESTINATION lib/${PROJECT_NAME})
ament_package()
"""
PROGRAM = """\
#include <moveit/move_group_interface/move_group_interface.h>
#include <moveit/planning_scene_interface/planning_scene_interface.h>
#include <rclcpp/rclcpp.hpp>

using moveit::planning_interface::MoveGroupInterface;

int main(int argc, char* argv[]) {
  rclcpp::init(argc, argv);
  auto const node = std::make_shared<rclcpp::Node>(
      "hello", rclcpp::NodeOptions().automatically_declare_parameters_from_overrides(true));
  auto const logger = node->get_logger();
  auto arm = MoveGroupInterface(node, "arm");
  RCLCPP_INFO(logger, "frame %s, tip %s, %u variables", arm.getPlanningFrame().c_str(),
              arm.getEndEffectorLink().c_str(), arm.getVariableCount());

  arm.setNamedTarget("ready");
  MoveGroupInterface::Plan plan;
  const bool is_planned = static_cast<bool>(arm.plan(plan));
  const auto& points = plan.trajectory_.joint_trajectory.points;
  RCLCPP_INFO(logger, "planned %d", is_planned && !points.empty());
  RCLCPP_INFO(logger, "executed %d", static_cast<bool>(arm.execute(plan)));
  const std::map<std::string, double> ready = arm.getNamedTargetValues("ready");
  double worst = 0.0;
  const auto state = arm.getCurrentState(10);
  for (const auto& entry : ready) {
    worst = std::max(worst, std::fabs(state->getVariablePosition(entry.first) - entry.second));
  }
  RCLCPP_INFO(logger, "there %d", worst < 0.02);

  geometry_msgs::msg::Pose below = arm.getCurrentPose().pose;
  below.position.z -= 0.05;
  moveit_msgs::msg::RobotTrajectory path;
  RCLCPP_INFO(logger, "straight %.2f", arm.computeCartesianPath({below}, 0.01, 0.0, path));

  moveit::core::RobotState elsewhere(*state);
  RCLCPP_INFO(logger, "reached %d",
              elsewhere.setFromIK(state->getJointModelGroup("arm"), below, 1.0));

  moveit::planning_interface::PlanningSceneInterface scene;
  moveit_msgs::msg::CollisionObject box;
  box.id = "box";
  box.header.frame_id = arm.getPlanningFrame();
  box.primitives.resize(1);
  box.primitives[0].type = box.primitives[0].BOX;
  box.primitives[0].dimensions = {0.1, 0.1, 0.1};
  box.primitive_poses.resize(1);
  box.primitive_poses[0].position.x = 2.0;
  box.primitive_poses[0].orientation.w = 1.0;
  box.operation = box.ADD;
  scene.applyCollisionObject(box);
  RCLCPP_INFO(logger, "known %zu", scene.getObjects({"box"}).size());
  scene.removeCollisionObjects({"box"});

  arm.setPositionTarget(5.0, 0.0, 0.0);
  RCLCPP_INFO(logger, "out of reach %d", !static_cast<bool>(arm.plan(plan)));
  rclcpp::shutdown();
}
"""


@pytest.fixture
def workspace(tmp_path: Path, examples_dir: Path) -> Path:
    """The example's arm, and a package of C++ beside it."""
    shutil.copytree(examples_dir / "arm_ws" / "src", tmp_path / "src")
    package = tmp_path / "src" / "hello_heron"
    (package / "src").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    (package / "CMakeLists.txt").write_text(CMAKE)
    (package / "src" / "hello.cpp").write_text(PROGRAM)
    compile_ahead(tmp_path, "hello_heron", "hello")
    return tmp_path


@pytest.mark.tutorial
def test_it_plans_and_moves_and_knows_the_scene(
    gazelle: Callable[..., Any], workspace: Path
) -> None:
    arm = gazelle("ros2", "launch", "heron_bringup", "heron.launch.py", cwd=workspace)
    arm.wait_for_line("You can start planning now!")
    hello = gazelle("ros2", "run", "hello_heron", "hello", cwd=workspace)
    hello.wait_for_line("frame world, tip tool_link, 6 variables")
    for line in ("planned 1", "executed 1", "there 1", "straight 1.00", "reached 1"):
        hello.wait_for_line(line)
    for line in ("known 1", "out of reach 1"):
        hello.wait_for_line(line)
    assert hello.wait() == 0
