"""The files of a MoveIt 1 config package."""

from __future__ import annotations

from typing import Any
from xml.sax.saxutils import quoteattr

from gazelle.description.moveit import DEFAULT_CONFIGS
from gazelle.description.srdf.writer import srdf_text
from gazelle.documents.yaml import load_yaml_file
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

__all__ = ["ros1_files"]

_DEPENDS = (
    "controller_manager",
    "gazebo_ros",
    "gazebo_ros_control",
    "joint_state_controller",
    "joint_state_publisher",
    "joint_state_publisher_gui",
    "joint_trajectory_controller",
    "moveit_fake_controller_manager",
    "moveit_kinematics",
    "moveit_planners_ompl",
    "moveit_ros_move_group",
    "moveit_ros_visualization",
    "moveit_setup_assistant",
    "moveit_simple_controller_manager",
    "robot_state_publisher",
    "rviz",
    "tf2_ros",
    "xacro",
)
_LAUNCHES = (
    "demo.launch",
    "demo_gazebo.launch",
    "fake_moveit_controller_manager.launch.xml",
    "gazebo.launch",
    "move_group.launch",
    "moveit_rviz.launch",
    "ompl_planning_pipeline.launch.xml",
    "pilz_industrial_motion_planner_planning_pipeline.launch.xml",
    "planning_context.launch",
    "planning_pipeline.launch.xml",
    "ros_control_moveit_controller_manager.launch.xml",
    "ros_controllers.launch",
    "sensor_manager.launch.xml",
    "setup_assistant.launch",
    "simple_moveit_controller_manager.launch.xml",
    "trajectory_execution.launch.xml",
)
_STATES = "joint_state_controller"
_INTERFACES = {"position": "Position", "velocity": "Velocity", "effort": "Effort"}


def ros1_files(config: SetupAssistantConfig) -> dict[str, str]:
    """Return the package's files by path, all but ``.setup_assistant``."""
    robot, source = config.robot_name, config.source
    words = _words(config)
    found = {
        "package.xml": package_xml(config, "ros1/package.xml", _depends(config)),
        "CMakeLists.txt": filled("ros1/CMakeLists.txt", **words),
        config.srdf_file: srdf_text(config.srdf, config.srdf_others),
        "config/kinematics.yaml": kinematics_yaml(config),
        "config/joint_limits.yaml": joint_limits_yaml(config),
        "config/cartesian_limits.yaml": cartesian_limits_yaml(config),
        "config/ompl_planning.yaml": _ompl(config),
        "config/fake_controllers.yaml": _fake_controllers(config),
        "config/simple_moveit_controllers.yaml": _moveit_controllers(config),
        "config/ros_controllers.yaml": _ros_controllers(config),
        "launch/moveit.rviz": rviz_view(config),
        f"launch/{robot}_moveit_sensor_manager.launch.xml": filled(
            "ros1/moveit_sensor_manager.launch.xml"
        ),
    }
    if config.adds_hardware:
        found[f"config/gazebo_{robot}.urdf.xacro"] = _gazebo_xacro(config)
    if source.copied_text:
        found[source.relative_path] = source.copied_text
    if config.sensors:
        found["config/sensors_3d.yaml"] = sensors_yaml(config)
    for name in _LAUNCHES:
        own = {"load": _gazebo_load(config, words)} if name == "gazebo.launch" else {}
        found[f"launch/{name}"] = filled(f"ros1/{name}", **{**words, **own})
    return found


def _words(config: SetupAssistantConfig) -> dict[str, str]:
    package, source = config.package_name, config.source
    plain = f"$(find {config.robot_package})/{source.relative_path}"
    load = f'textfile="{plain}"'
    if source.is_xacro:
        load = f"command={quoteattr(' '.join(['xacro', plain, source.xacro_args]).strip())}"
    srdf = f"$(find {package})/{config.srdf_file}"
    semantics = f'textfile="{srdf}"'
    if config.srdf_file.endswith(".xacro"):
        semantics = f'command="xacro {srdf}"'
    names = [_STATES, *(item.name for item in config.controllers)]
    sensors = f'  <rosparam command="load" file="$(find {package})/config/sensors_3d.yaml"/>\n'
    return {
        "package": package,
        "robot": config.robot_name,
        "srdf": semantics,
        "sensors": sensors if config.sensors else "",
        "controllers": " ".join(names),
        "positions": " ".join(
            f"-J {name} {value:.6g}" for name, value in config.initial_positions.items()
        ),
        "transforms": _transforms(config),
        "load": load,
    }


def _gazebo_load(config: SetupAssistantConfig, words: dict[str, str]) -> str:
    if not config.adds_hardware:
        return words["load"]
    file = f"$(find {config.package_name})/config/gazebo_{config.robot_name}.urdf.xacro"
    return f'command="xacro {file}"'


def _depends(config: SetupAssistantConfig) -> tuple[str, ...]:
    kinds = {item.plugin.split("/")[0] for item in config.controllers}
    is_gripping = any(item.type == "GripperCommand" for item in config.controllers)
    return (*_DEPENDS, *kinds, *(["gripper_action_controller"] if is_gripping else []))


def _transforms(config: SetupAssistantConfig) -> str:
    """Nodes that tell where virtual joints hold the robot, for the others in ``demo.launch``."""
    lines = [
        f'  <node pkg="tf2_ros" type="static_transform_publisher" name="virtual_joint_broadcaster_'
        f'{number}"\n        args="0 0 0 0 0 0 {item.parent_frame} {item.child_link}"/>'
        for number, item in enumerate(config.srdf.virtual_joints)
    ]
    return "\n".join(["", *lines, ""]) if lines else ""


def _ompl(config: SetupAssistantConfig) -> str:
    tree: dict[str, Any] = dict(load_yaml_file(DEFAULT_CONFIGS / "ompl_defaults.yaml"))
    planners = list(tree["planner_configs"])
    for group in config.srdf.groups:
        default = config.planners.get(group.name, "")
        first = {"default_planner_config": default} if default else {}
        tree[group.name] = {**first, "planner_configs": planners}
    return yaml_text(tree, "OMPL's planners, and which of them each group may use.")


def _fake_controllers(config: SetupAssistantConfig) -> str:
    rows = [
        {
            "name": f"fake_{item.name}",
            "type": "$(arg fake_execution_type)",
            "joints": list(item.joints),
        }
        for item in config.controllers
    ]
    first = {state.group: state.name for state in reversed(config.srdf.states)}
    initial = [
        {"group": group.name, "pose": first[group.name]}
        for group in config.srdf.groups
        if group.name in first
    ]
    return yaml_text(
        {"controller_list": rows, "initial": initial},
        "Controllers that only tell where the joints would be, and the poses they begin at.",
    )


def _moveit_controllers(config: SetupAssistantConfig) -> str:
    rows = [{"name": item.name, **moveit_controller(item)} for item in config.controllers]
    return yaml_text(
        {"controller_list": rows}, "The controllers that MoveIt sends trajectories to."
    )


def _ros_controllers(config: SetupAssistantConfig) -> str:
    tree: dict[str, Any] = {
        _STATES: {"type": f"{_STATES}/JointStateController", "publish_rate": 50}
    }
    for item in config.controllers:
        tree[item.name] = {"type": item.plugin, **_parameters(item)}
    tree.update(config.manager_others)
    return yaml_text(tree, "The controllers that the controller manager runs.")


def _parameters(controller: ControllerChoice) -> dict[str, Any]:
    is_gripper = controller.plugin.endswith("/GripperActionController")
    joints: dict[str, Any] = (
        {"joint": controller.joints[0]} if is_gripper else {"joints": list(controller.joints)}
    )
    return {**joints, **controller.parameters}


def _gazebo_xacro(config: SetupAssistantConfig) -> str:
    source = config.source
    lines: list[str] = []
    for joint in config.added_joints:
        kinds = config.command_interfaces[joint]
        lines += [
            f'  <transmission name="{joint}_transmission">',
            "    <type>transmission_interface/SimpleTransmission</type>",
            f'    <joint name="{joint}">',
            *(f"      <hardwareInterface>{_interface(kind)}</hardwareInterface>" for kind in kinds),
            "    </joint>",
            f'    <actuator name="{joint}_motor">',
            *(f"      <hardwareInterface>{_interface(kind)}</hardwareInterface>" for kind in kinds),
            "      <mechanicalReduction>1</mechanicalReduction>",
            "    </actuator>",
            "  </transmission>",
        ]
    lines += fixed_world_joint(config, "  ")
    if config.adds_plugin:
        plugin = '<plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so"/>'
        lines += ["  <gazebo>", f"    {plugin}", "  </gazebo>"]
    given = "".join(
        f"\n  <xacro:arg name={quoteattr(name)} default={quoteattr(value)}/>"
        for name, value in source.mappings.items()
    )
    return filled(
        "ros1/gazebo.urdf.xacro",
        robot=config.robot_name,
        arguments=given,
        include=f"$(find {config.robot_package})/{source.relative_path}",
        hardware="\n".join(lines),
    )


def _interface(kind: str) -> str:
    return f"hardware_interface/{_INTERFACES[kind]}JointInterface"
