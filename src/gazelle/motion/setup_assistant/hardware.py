"""Hardware and controllers that a robot suggests: interfaces, controllers, joint limits."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite

from gazelle.description.model import JointType, Model
from gazelle.motion.model import RobotModel
from gazelle.motion.setup_assistant.config import (
    ControllerChoice,
    JointLimitChoice,
    RosVersion,
)
from gazelle.motion.setup_assistant.kinematic_tree import is_named_wheel

__all__ = [
    "COMMAND_INTERFACES",
    "GAINS",
    "TRAJECTORY_PLUGIN",
    "added_joints",
    "command_interfaces",
    "controllers_for",
    "has_manager_plugin",
    "joint_limits_for",
]

COMMAND_INTERFACES = ("position", "velocity", "effort")
TRAJECTORY_PLUGIN = "joint_trajectory_controller/JointTrajectoryController"
GAINS: Mapping[str, float] = {"p": 100.0, "i": 1.0, "d": 1.0, "i_clamp": 1.0}
"""Of a controller that commands efforts; they are a beginning, every robot wants its own."""

_PLUGINS = ("gazebo_ros_control", "ros2_control")
_DRIVEN = (JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC)
_FINGER_GAINS: Mapping[str, float] = {"p": 1000.0, "i": 0.0, "d": 20.0, "i_clamp": 1.0}


def has_manager_plugin(model: Model) -> bool:
    """Return whether the robot's own URDF has Gazebo's plug-in with the controller manager."""
    return any(word in plugin.filename for plugin in model.plugins for word in _PLUGINS)


def added_joints(
    model: Model, interfaces: Mapping[str, object], ros_version: RosVersion
) -> tuple[str, ...]:
    """Return the joints that the URDF gives no motor; none where ``<ros2_control>`` has some.

    Args:
        model: the robot.
        interfaces: joints that are to be driven.
        ros_version: 1 looks at ``<transmission>``, 2 at ``<ros2_control>``.
    """
    if ros_version == 2:
        return () if model.ros2_controls else tuple(interfaces)
    own = _of_transmissions(model)
    return tuple(joint for joint in interfaces if joint not in own)


def command_interfaces(model: Model, ros_version: RosVersion) -> dict[str, tuple[str, ...]]:
    """Return what each joint is commanded by: what the URDF says, else positions.

    Wheels get speeds; those that a URDF with motors leaves out are casters and get nothing.
    """
    said = _of_transmissions(model) if ros_version == 1 else _of_ros2_control(model)
    found: dict[str, tuple[str, ...]] = {}
    for joint in model.joints:
        is_wheel = is_named_wheel(joint.name, joint.child)
        if joint.name in said:
            found[joint.name] = said[joint.name]
        elif joint.type in _DRIVEN and joint.mimic is None and not (said and is_wheel):
            found[joint.name] = ("velocity",) if is_wheel else ("position",)
    return found


def controllers_for(
    robot: RobotModel, interfaces: Mapping[str, tuple[str, ...]], ros_version: RosVersion
) -> tuple[ControllerChoice, ...]:
    """Return a controller for each group that no other group contains.

    Hands with one motor get a gripper's action, all others trajectories.

    Args:
        robot: with its groups.
        interfaces: what joints are commanded by.
        ros_version: whose names plug-ins have.
    """
    hands = {effector.group for effector in robot.srdf.end_effectors}
    taken: set[str] = set()
    found: list[ControllerChoice] = []
    for name, group in robot.groups.items():
        joints = tuple(joint for joint in group.active_joints if joint in interfaces)
        if not joints or group.subgroups or taken & set(joints):
            continue
        taken |= set(joints)
        if name in hands and len(joints) == 1:
            found.append(_gripper(name, joints[0], interfaces[joints[0]][0], ros_version))
        else:
            found.append(_trajectory(name, joints, interfaces, ros_version))
    return tuple(found)


def joint_limits_for(model: Model, driven: Mapping[str, object]) -> dict[str, JointLimitChoice]:
    """Return limits as MoveIt writes them: the URDF's speed, and no acceleration yet.

    Args:
        model: the robot.
        driven: names of the joints that are driven; mimicking ones get limits as well.
    """
    found = {}
    for joint in sorted(model.joints, key=lambda item: item.name):
        if joint.axis is None or not (joint.name in driven or joint.mimic):
            continue
        speed = joint.axis.velocity
        is_limited = isfinite(speed) and speed > 0
        found[joint.name] = JointLimitChoice(is_limited, speed if is_limited else 0.0)
    return found


def _trajectory(
    group: str,
    joints: tuple[str, ...],
    interfaces: Mapping[str, tuple[str, ...]],
    ros_version: RosVersion,
) -> ControllerChoice:
    kinds = sorted({interfaces[joint][0] for joint in joints}, key=COMMAND_INTERFACES.index)
    gains = {joint: dict(GAINS) for joint in joints if interfaces[joint][0] == "effort"}
    with_gains: dict[str, object] = {"gains": gains} if gains else {}
    if ros_version == 1:
        plugin = f"{kinds[0]}_controllers/JointTrajectoryController"
        return ControllerChoice(
            f"{group}_controller", "FollowJointTrajectory", joints, plugin, parameters=with_gains
        )
    parameters = {"command_interfaces": kinds, "state_interfaces": ["position", "velocity"]}
    return ControllerChoice(
        f"{group}_controller",
        "FollowJointTrajectory",
        joints,
        TRAJECTORY_PLUGIN,
        parameters={**parameters, **with_gains},
    )


def _gripper(group: str, joint: str, interface: str, ros_version: RosVersion) -> ControllerChoice:
    kind = "effort" if interface == "effort" else "position"
    gains = dict(_FINGER_GAINS)
    parameters: dict[str, object] = {"goal_tolerance": 0.01, "max_effort": 10.0}
    if ros_version == 2:
        parameters["allow_stalling"] = True
    if kind == "effort":
        parameters["gains"] = {joint: gains}
    return ControllerChoice(
        f"{group}_controller",
        "GripperCommand",
        (joint,),
        f"{kind}_controllers/GripperActionController",
        "gripper_cmd",
        parameters=parameters,
    )


def _of_transmissions(model: Model) -> dict[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = {}
    for transmission in model.transmissions:
        for joint in transmission.joints:
            words = [
                *joint.hardware_interfaces,
                *(
                    word
                    for actuator in transmission.actuators
                    for word in actuator.hardware_interfaces
                ),
            ]
            kinds = [
                kind for kind in COMMAND_INTERFACES
                if any(kind in word.lower() and "state" not in word.lower() for word in words)
            ]  # fmt: skip
            found[joint.name] = tuple(kinds) or ("effort",)
    return found


def _of_ros2_control(model: Model) -> dict[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = {}
    for block in model.ros2_controls:
        for joint in block.element.find_all("joint"):
            kinds = [tag.attributes.get("name", "") for tag in joint.find_all("command_interface")]
            known = tuple(kind for kind in kinds if kind in COMMAND_INTERFACES)
            if known:
                found[joint.attributes.get("name", "")] = known
    return found
