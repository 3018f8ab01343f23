"""RobotCommander: joints, links and groups of the robot."""

from __future__ import annotations

from typing import Any

from gazelle.compat.moveit.commander.conversions import list_to_pose_stamped
from gazelle.compat.moveit.commander.exception import MoveItCommanderException
from gazelle.compat.moveit.commander.move_group import MoveGroupCommander
from gazelle.compat.moveit.commander.roscpp_initializer import robot_of, ros1
from gazelle.compat.moveit.robot_interface import RobotInterface
from gazelle.diagnostics import did_you_mean
from gazelle.motion.model import JointGroup, JointKind, RobotJoint
from gazelle.nodes.move_group.robot_state_messages import robot_state_message

__all__ = ["RobotCommander"]


class _Joint:
    """A joint: its limits and where it is."""

    def __init__(self, robot: RobotCommander, interface: RobotInterface, joint: RobotJoint) -> None:
        self._robot = robot
        self._interface = interface
        self._joint = joint

    def name(self) -> str:
        """Return its name."""
        return self._joint.name

    def variable_count(self) -> int:
        """Return how many numbers say where it is."""
        return len(self._joint.variables)

    def bounds(self) -> list[Any]:
        """Return the lowest and the highest position, of each variable when there are several."""
        rows: list[Any] = [[limit.lower, limit.upper] for limit in self._joint.limits]
        return rows[0] if len(rows) == 1 else rows

    def min_bound(self) -> Any:
        """Return the lowest position."""
        rows = [limit.lower for limit in self._joint.limits]
        return rows[0] if len(rows) == 1 else rows

    def max_bound(self) -> Any:
        """Return the highest position."""
        rows = [limit.upper for limit in self._joint.limits]
        return rows[0] if len(rows) == 1 else rows

    def value(self) -> Any:
        """Return where it is, rad or m."""
        known = self._interface.model.named(self._interface.positions())
        rows = [known[name] for name in self._joint.variables]
        return rows[0] if len(rows) == 1 else rows

    def move(self, position: float, wait: bool = True) -> bool:
        """Move it, with the smallest group that has it."""
        group = self._robot.get_default_owner_group(self._joint.name)
        if group is None:
            text = f"There is no known group containing joint {self._joint.name}. Cannot move."
            raise MoveItCommanderException(text)
        commander = self._robot.get_group(group)
        commander.set_joint_value_target(commander.get_current_joint_values())
        commander.set_joint_value_target(self._joint.name, position)
        return commander.go(wait)


class _Link:
    """A link and where it is."""

    def __init__(self, interface: RobotInterface, name: str) -> None:
        self._interface = interface
        self._name = name

    def name(self) -> str:
        """Return its name."""
        return self._name

    def pose(self) -> Any:
        """Return its pose in the planning frame."""
        pose = self._interface.link_pose(self._name)
        values = [*pose.position_m, *pose.quat_xyzw]
        return list_to_pose_stamped(values, self._interface.model.frame)


class RobotCommander:
    """What the robot is made of; its groups, joints and links are attributes too.

    Args:
        robot_description: name of the parameter with the URDF.
        ns: namespace of move_group.

    Raises:
        RuntimeError: there is no robot.
    """

    Joint = _Joint
    Link = _Link

    def __init__(self, robot_description: str = "robot_description", ns: str = "") -> None:
        self._description = robot_description
        self._ns = ns
        self._interface = robot_of(robot_description, ns)
        self._groups: dict[str, MoveGroupCommander] = {}

    def get_planning_frame(self) -> str:
        """Return the frame that everything is planned in."""
        return self._interface.model.frame

    def get_root_link(self) -> str:
        """Return the link that carries all others."""
        return self._interface.model.root_link

    def get_group_names(self) -> list[str]:
        """Return the planning groups."""
        return list(self._interface.model.groups)

    def has_group(self, name: str) -> bool:
        """Return whether there is a group of this name."""
        return name in self._interface.model.groups

    def get_active_joint_names(self, group: str | None = None) -> list[str]:
        """Return the joints that can be driven, of the robot or of a group."""
        if group is not None:
            return list(self._group(group).active_joints)
        return [joint.name for joint in self._interface.model.joints if joint.is_active]

    def get_joint_names(self, group: str | None = None) -> list[str]:
        """Return all joints, of the robot or of a group."""
        if group is not None:
            return list(self._group(group).joints)
        return [joint.name for joint in self._interface.model.joints]

    def get_link_names(self, group: str | None = None) -> list[str]:
        """Return all links, of the robot or of a group."""
        return list(self._interface.model.links if group is None else self._group(group).links)

    def get_current_state(self) -> Any:
        """Return the ``RobotState`` of now."""
        model = self._interface.model
        made = robot_state_message(
            model, self._interface.positions(), frame=model.frame, stamp_ns=0
        )
        return ros1(made)

    def get_current_variable_values(self) -> dict[str, float]:
        """Return where all joints are, by variable."""
        return self._interface.model.named(self._interface.positions())

    def get_joint(self, name: str) -> _Joint:
        """Return a joint.

        Raises:
            MoveItCommanderException: there is none of this name.
        """
        joints = {joint.name: joint for joint in self._interface.model.joints}
        if name not in joints:
            raise MoveItCommanderException(_unknown_text("joint", name, tuple(joints)))
        return _Joint(self, self._interface, joints[name])

    def get_link(self, name: str) -> _Link:
        """Return a link.

        Raises:
            MoveItCommanderException: there is none of this name.
        """
        if name not in self._interface.model.links:
            raise MoveItCommanderException(_unknown_text("link", name, self._interface.model.links))
        return _Link(self._interface, name)

    def get_group(self, name: str) -> MoveGroupCommander:
        """Return the commander of a group.

        Raises:
            MoveItCommanderException: there is none of this name.
        """
        self._group(name)
        if name not in self._groups:
            self._groups[name] = MoveGroupCommander(name, self._description, self._ns)
        return self._groups[name]

    def get_default_owner_group(self, joint_name: str) -> str | None:
        """Return the smallest group that drives a joint."""
        groups = self._interface.model.groups.values()
        owners = [group for group in groups if joint_name in group.active_joints]
        found = min(owners, key=lambda group: len(group.active_joints), default=None)
        return None if found is None else found.name

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        model = self._interface.model
        if name in model.groups:
            return self.get_group(name)
        joints = {joint.name for joint in model.joints if joint.kind is not JointKind.FIXED}
        if name in joints:
            return self.get_joint(name)
        if name in model.links:
            return self.get_link(name)
        raise AttributeError(f"RobotCommander has no attribute, group, joint or link '{name}'")

    def _group(self, name: str) -> JointGroup:
        if name not in self._interface.model.groups:
            raise MoveItCommanderException(
                _unknown_text("group", name, tuple(self._interface.model.groups))
            )
        return self._interface.model.groups[name]


def _unknown_text(kind: str, name: str, known: tuple[str, ...]) -> str:
    return f"There is no {kind} named {name}; {did_you_mean(name, known)}"
