"""The files of a MoveIt 2 config package."""

from __future__ import annotations

from typing import Any
from xml.sax.saxutils import quoteattr

from gazelle.description.srdf.writer import srdf_text
from gazelle.motion.setup_assistant.config import ControllerChoice, SetupAssistantConfig
from gazelle.motion.setup_assistant.texts import (
    cartesian_limits_yaml,
    filled,
    fixed_world_joint,
    joint_limits_yaml,
    kinematics_yaml,
    moveit_controller,
    package_xml,
    rviz_view,
    sensors_yaml,
    yaml_text,
)

__all__ = ["ros2_files"]

_DEPENDS = (
    "controller_manager",
    "gazebo_ros",
    "gazebo_ros2_control",
    "joint_state_broadcaster",
    "moveit_configs_utils",
    "moveit_kinematics",
    "moveit_planners_ompl",
    "moveit_ros_move_group",
    "moveit_ros_visualization",
    "moveit_ros_warehouse",
    "moveit_setup_assistant",
    "moveit_simple_controller_manager",
    "robot_state_publisher",
    "rviz2",
    "tf2_ros",
    "xacro",
)
_LAUNCHES = {
    "demo": "Everything on simulated hardware: transforms, move_group, controllers, RViz",
    "move_group": "move_group with all that this package says of the robot",
    "moveit_rviz": "RViz with the motion planning display",
    "rsp": "The robot's transforms: robot_state_publisher",
    "setup_assistant": "This package in the Setup Assistant",
    "spawn_controllers": "The controllers that move_group sends trajectories to",
    "static_virtual_joint_tfs": "Where the virtual joints hold the robot",
    "warehouse_db": "The data base of scenes and states",
}
_MANAGER = "moveit_simple_controller_manager"
_BROADCASTER = "joint_state_broadcaster"


def ros2_files(config: SetupAssistantConfig) -> dict[str, str]:
    """Return the package's files by path, all but ``.setup_assistant``."""
    robot, package, source = config.robot_name, config.package_name, config.source
    plugins = sorted({item.plugin.split("/")[0] for item in config.controllers})
    found = {
        "package.xml": package_xml(config, "ros2/package.xml", (*_DEPENDS, *_packages(plugins))),
        "CMakeLists.txt": filled("ros2/CMakeLists.txt", package=package),
        config.srdf_file: srdf_text(config.srdf, config.srdf_others),
        "config/kinematics.yaml": kinematics_yaml(config),
        "config/joint_limits.yaml": joint_limits_yaml(config),
        "config/pilz_cartesian_limits.yaml": cartesian_limits_yaml(config),
        "config/initial_positions.yaml": _initial_positions(config),
        "config/moveit_controllers.yaml": _moveit_controllers(config),
        "config/ros2_controllers.yaml": _ros2_controllers(config),
        "config/moveit.rviz": rviz_view(config),
        "launch/gazebo.launch.py": _gazebo(config),
    }
    if config.adds_hardware:
        found[f"config/{robot}.urdf.xacro"] = _urdf_xacro(config)
        found[f"config/{robot}.ros2_control.xacro"] = _control_xacro(config)
    if source.copied_text:
        found[source.relative_path] = source.copied_text
    if config.sensors:
        found["config/sensors_3d.yaml"] = sensors_yaml(config)
    if config.planners:
        found["config/ompl_planning.yaml"] = _ompl(config)
    for name, words in _LAUNCHES.items():
        found[f"launch/{name}.launch.py"] = filled(
            "ros2/usual.launch.py", words=words, name=name, robot=robot, package=package
        )
    return found


def _packages(plugins: list[str]) -> list[str]:
    """Packages of controllers' plug-ins, which are named after them with one exception."""
    grippers = {"position_controllers", "effort_controllers"}
    return ["gripper_controllers" if name in grippers else name for name in plugins]


def _initial_positions(config: SetupAssistantConfig) -> str:
    return yaml_text(
        {"initial_positions": dict(config.initial_positions)},
        f"Where the simulated joints of {config.robot_name} begin, rad or m.",
    )


def _moveit_controllers(config: SetupAssistantConfig) -> str:
    rows = {item.name: moveit_controller(item) for item in config.controllers}
    tree = {
        "moveit_controller_manager": f"{_MANAGER}/MoveItSimpleControllerManager",
        _MANAGER: {"controller_names": list(rows), **rows},
    }
    return yaml_text(tree, "The controllers that MoveIt sends trajectories to.")


def _ros2_controllers(config: SetupAssistantConfig) -> str:
    types = {item.name: {"type": item.plugin} for item in config.controllers}
    manager: dict[str, Any] = {"update_rate": 100, **types}
    manager[_BROADCASTER] = {"type": f"{_BROADCASTER}/JointStateBroadcaster"}
    tree: dict[str, Any] = {"controller_manager": {"ros__parameters": manager}}
    for item in config.controllers:
        tree[item.name] = {"ros__parameters": _parameters(item)}
    for key, value in config.manager_others.items():
        if key == "controller_manager":
            manager.update(value)
        else:
            tree[key] = value
    return yaml_text(tree, "The controllers that the controller manager runs.")


def _parameters(controller: ControllerChoice) -> dict[str, Any]:
    is_gripper = controller.plugin.endswith("/GripperActionController")
    joints: dict[str, Any] = (
        {"joint": controller.joints[0]} if is_gripper else {"joints": list(controller.joints)}
    )
    return {**joints, **controller.parameters}


def _ompl(config: SetupAssistantConfig) -> str:
    groups = {group: {"default_planner_config": name} for group, name in config.planners.items()}
    return filled("ros2/ompl_planning.yaml") + yaml_text(groups)


def _urdf_xacro(config: SetupAssistantConfig) -> str:
    robot, source = config.robot_name, config.source
    where = f"$(find {config.robot_package})/{source.relative_path}"
    given = "".join(
        f"\n  <xacro:arg name={quoteattr(name)} default={quoteattr(value)}/>"
        for name, value in source.mappings.items()
    )
    return filled(
        "ros2/urdf.xacro",
        robot=robot,
        macro=_macro(robot),
        package=config.package_name,
        include=where,
        arguments=given,
        fixed="".join(f"\n{line}" for line in fixed_world_joint(config, "    ")),
    )


def _control_xacro(config: SetupAssistantConfig) -> str:
    lines: list[str] = []
    for joint in config.added_joints:
        kinds = config.command_interfaces[joint]
        lines.append(f'      <joint name="{joint}">')
        lines += [f'        <command_interface name="{kind}"/>' for kind in kinds]
        for kind in config.state_interfaces:
            if kind == "position" and joint in config.initial_positions:
                lines.append(f'        <state_interface name="{kind}">')
                value = f"${{initial_positions['{joint}']}}"
                lines.append(f'          <param name="initial_value">{value}</param>')
                lines.append("        </state_interface>")
            else:
                lines.append(f'        <state_interface name="{kind}"/>')
        lines.append("      </joint>")
    macro = _macro(config.robot_name)
    return filled("ros2/ros2_control.xacro", macro=macro, joints="\n".join(lines))


def _macro(robot: str) -> str:
    """A name that xacro takes."""
    return "".join(letter if letter.isalnum() else "_" for letter in robot)


def _gazebo(config: SetupAssistantConfig) -> str:
    names = [_BROADCASTER, *(item.name for item in config.controllers)]
    mappings = '.robot_description(mappings={"use_sim": "true"})' if config.adds_hardware else ""
    listed = "[" + ", ".join(f'"{name}"' for name in names) + "]"
    return filled(
        "ros2/gazebo.launch.py",
        robot=config.robot_name,
        package=config.package_name,
        controllers=listed,
        mappings=mappings,
    )
