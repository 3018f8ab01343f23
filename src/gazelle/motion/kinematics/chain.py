"""Joints between the root and a tip as the arrays the kernels work on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics.kernels import QUATERNION, SLIDE, TURN, tree
from gazelle.motion.model import JointGroup, JointKind, RobotJoint, RobotModel

__all__ = ["Chain", "Goal", "LinkTree", "chain_to", "link_tree"]

IntArray = NDArray[np.int64]
_TREE_KINDS = {
    JointKind.FIXED: 0,
    JointKind.REVOLUTE: 1,
    JointKind.PRISMATIC: 2,
    JointKind.PLANAR: 4,
    JointKind.FLOATING: 5,
}


class LinkTree(NamedTuple):
    """All links of a robot, each after the one above it, as `kernels.tree` takes them.

    Attributes:
        parents: (l,) number of the link above, -1 where there is none.
        A: (l, 3, 3) rotations from the link above to the joint.
        a: (l, 3) translations likewise, m.
        kinds: (l,) of the joints.
        axes: (l, 3) unit vectors.
        places: (l,) of a joint's first variable in the robot's positions.
        B: (l, 3, 3) rotations from the joint to the link.
        b: (l, 3) translations likewise, m.
    """

    parents: IntArray
    A: FloatArray
    a: FloatArray
    kinds: IntArray
    axes: FloatArray
    places: IntArray
    B: FloatArray
    b: FloatArray


class Chain(NamedTuple):
    """Steps from the robot's frame to a tip; arguments of the kernels of chains.

    Attributes:
        A: (s, 3, 3) rotations before each motion.
        a: (s, 3) translations before each motion, m.
        kinds: (s,) elementary motions.
        axes: (s, 3) unit vectors.
        variables: (s,) place of the step's variable in the group's configuration.
        factors: (s,) multipliers of mimicking joints, 1 for others.
        offsets: (s,) offsets of mimicking joints, rad or m.
        dofs: (s,) column of the Jacobian.
        dof_variables: (n,) variable of every column, -1 for those of quaternions.
        tool_rotation: (3, 3) rotation behind the last motion.
        tool_m: (3,) translation behind the last motion, m.
    """

    A: FloatArray
    a: FloatArray
    kinds: IntArray
    axes: FloatArray
    variables: IntArray
    factors: FloatArray
    offsets: FloatArray
    dofs: IntArray
    dof_variables: IntArray
    tool_rotation: FloatArray
    tool_m: FloatArray


class Goal(NamedTuple):
    """Where a chain's tip is to be, and how nearly.

    Attributes:
        rotation: (3, 3) in the robot's frame.
        position_m: (3,) in the robot's frame.
        weight: metres that a radian counts as; 0 where the orientation does not matter.
        near_m: near enough.
        near_rad: likewise.
        steps: most steps from one seed.
    """

    rotation: FloatArray
    position_m: FloatArray
    weight: float
    near_m: float
    near_rad: float
    steps: int


def link_tree(robot: RobotModel) -> LinkTree:
    """Return a robot's links as arrays."""
    place = {link: index for index, link in enumerate(robot.links)}
    before = np.array([joint.T_parent_joint.matrix() for joint in robot.joints])
    behind = np.array([joint.T_joint_child.matrix() for joint in robot.joints])
    return LinkTree(
        np.array([place.get(joint.parent, -1) for joint in robot.joints], dtype=np.int64),
        np.ascontiguousarray(before[:, :3, :3]),
        np.ascontiguousarray(before[:, :3, 3]),
        np.array([_TREE_KINDS[joint.kind] for joint in robot.joints], dtype=np.int64),
        np.array([joint.axis for joint in robot.joints], dtype=np.float64),
        np.array([joint.first for joint in robot.joints], dtype=np.int64),
        np.ascontiguousarray(behind[:, :3, :3]),
        np.ascontiguousarray(behind[:, :3, 3]),
    )


def chain_to(
    robot: RobotModel, group: JointGroup, tip: str, positions: FloatArray, offset: FloatArray
) -> Chain:
    """Return the chain to a tip as a function of a group's configuration.

    Args:
        robot: the robot.
        group: whose variables move the chain; all other joints stand still.
        tip: a link.
        positions: of the whole robot, for the joints that stand still.
        offset: 4×4 pose of what shall be moved, in the tip's frame.
    """
    builder = _Builder(robot, group)
    path: list[RobotJoint] = []
    link = tip
    while link:
        joint = robot.joint_above[link]
        path.append(joint)
        link = joint.parent
    for joint in reversed(path):
        builder.add(joint, positions)
    return builder.finished(offset)


@dataclass(slots=True)
class _Step:
    before: FloatArray
    kind: int
    axis: tuple[float, float, float]
    variable: int
    factor: float
    offset: float
    dof: int


class _Builder:
    def __init__(self, robot: RobotModel, group: JointGroup) -> None:
        self._robot = robot
        self._places = {name: index for index, name in enumerate(group.variables)}
        self._steps: list[_Step] = []
        self._before = np.eye(4)
        self._dof_variables: list[int] = []
        self._dofs: dict[int, int] = {}
        for joint in robot.joints:
            if joint.name in group.active_joints:
                self._count(joint)

    def _count(self, joint: RobotJoint) -> None:
        """Give a joint its columns: three for a floating joint's quaternion."""
        places = [self._places[name] for name in joint.variables]
        if joint.kind is JointKind.FLOATING:
            for place in places[:3]:
                self._give(place, place)
            for _ in range(3):
                self._give(places[3], -1)
            return
        for place in places:
            self._give(place, place)

    def _give(self, place: int, variable: int) -> None:
        self._dofs.setdefault(place, len(self._dof_variables))
        self._dof_variables.append(variable)

    def add(self, joint: RobotJoint, positions: FloatArray) -> None:
        self._before = self._before @ joint.T_parent_joint.matrix()
        leader, factor, offset = self._leader(joint)
        if joint.kind is JointKind.FIXED or leader[0] not in self._places:
            self._before = self._before @ _motion(joint, positions)
        elif joint.kind is JointKind.REVOLUTE:
            self._step(TURN, joint.axis, leader[0], factor, offset)
        elif joint.kind is JointKind.PRISMATIC:
            self._step(SLIDE, joint.axis, leader[0], factor, offset)
        else:
            count = 2 if joint.kind is JointKind.PLANAR else 3
            for axis, name in zip(np.eye(3)[:count].tolist(), leader, strict=False):
                self._step(SLIDE, (axis[0], axis[1], axis[2]), name)
            kind = TURN if joint.kind is JointKind.PLANAR else QUATERNION
            self._step(kind, (0.0, 0.0, 1.0), leader[count])
        self._before = self._before @ joint.T_joint_child.matrix()

    def _leader(self, joint: RobotJoint) -> tuple[tuple[str, ...], float, float]:
        if joint.mimic is None:
            return joint.variables or ("",), 1.0, 0.0
        name, factor, offset = self._robot.mimic_of(joint.name)
        return (name,), factor, offset

    def _step(
        self,
        kind: int,
        axis: tuple[float, float, float],
        variable: str,
        factor: float = 1.0,
        offset: float = 0.0,
    ) -> None:
        place = self._places[variable]
        step = _Step(self._before, kind, axis, place, factor, offset, self._dofs[place])
        self._steps.append(step)
        self._before = np.eye(4)

    def finished(self, offset: FloatArray) -> Chain:
        tool = self._before @ offset
        steps = self._steps
        before = np.array([step.before for step in steps]).reshape(-1, 4, 4)
        return Chain(
            np.ascontiguousarray(before[:, :3, :3]),
            np.ascontiguousarray(before[:, :3, 3]),
            np.array([step.kind for step in steps], dtype=np.int64),
            np.array([step.axis for step in steps], dtype=np.float64).reshape(-1, 3),
            np.array([step.variable for step in steps], dtype=np.int64),
            np.array([step.factor for step in steps], dtype=np.float64),
            np.array([step.offset for step in steps], dtype=np.float64),
            np.array([step.dof for step in steps], dtype=np.int64),
            np.array(self._dof_variables, dtype=np.int64),
            np.ascontiguousarray(tool[:3, :3]),
            np.ascontiguousarray(tool[:3, 3]),
        )


def _motion(joint: RobotJoint, positions: FloatArray) -> FloatArray:
    """Return the motion of a joint that stands still."""
    if joint.kind is JointKind.FIXED:
        return np.eye(4)
    one = np.eye(3)[None]
    none = np.zeros((1, 3))
    R, p = np.empty((1, 3, 3)), np.empty((1, 3))
    link = LinkTree(
        np.array([-1]), one, none, np.array([_TREE_KINDS[joint.kind]]), np.array([joint.axis]),
        np.array([joint.first]), one, none,
    )  # fmt: skip
    tree(link, positions, R, p)
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = R[0], p[0]
    return found
