"""A robot as motion sees it: joints in order, groups, named states."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from gazelle.description.model import Model
from gazelle.description.moveit import JointLimit, MoveItConfig
from gazelle.description.srdf import Srdf
from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.errors import NotFoundError
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model.joint_groups import JointGroup, groups_of
from gazelle.motion.model.joints import JointKind, RobotJoint, joints_of, root_of

__all__ = ["RobotModel"]


@dataclass(frozen=True, eq=False)
class RobotModel:
    """A robot with its groups.

    Positions of a robot are an array of one number per variable, those of mimicking joints
    included; `positions` makes one of values by name.

    Attributes:
        description: shapes and masses.
        srdf: as it was read.
        joints: in the robot's order; the first one holds the root.
        groups: by name.
    """

    description: Model
    srdf: Srdf
    joints: tuple[RobotJoint, ...]
    groups: Mapping[str, JointGroup] = field(default_factory=dict)

    @classmethod
    def build(
        cls,
        description: Model,
        srdf: Srdf | None = None,
        limits: Mapping[str, JointLimit] | None = None,
        *,
        diagnostics: Diagnostics,
    ) -> RobotModel:
        """Put together what URDF, SRDF and joint_limits.yaml say.

        Args:
            description: the robot.
            srdf: groups and virtual joint; a robot without groups when None.
            limits: of joint_limits.yaml.
            diagnostics: receives what cannot be planned for.
        """
        semantics = srdf or Srdf(description.name)
        joints = joints_of(description, semantics, limits or {}, diagnostics)
        return cls(description, semantics, joints, groups_of(joints, semantics))

    @classmethod
    def from_config(cls, config: MoveItConfig, *, diagnostics: Diagnostics) -> RobotModel:
        """Return the robot of a MoveIt config package or of move_group's parameters."""
        return cls.build(config.robot, config.srdf, config.joint_limits, diagnostics=diagnostics)

    @property
    def name(self) -> str:
        """The URDF's name of the robot."""
        return self.description.name

    @cached_property
    def root_link(self) -> str:
        """The link everything hangs on."""
        return root_of(self.description)

    @cached_property
    def frame(self) -> str:
        """The frame all poses are given in: the virtual joint's parent, else the root link."""
        virtual = {joint.name: joint for joint in self.srdf.virtual_joints}
        held = virtual.get(self.joints[0].name)
        return self.root_link if held is None else held.parent_frame

    @cached_property
    def links(self) -> tuple[str, ...]:
        """Names of all links, each after the one above it."""
        return tuple(joint.child for joint in self.joints)

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """Names of all variables, in the order of positions."""
        return tuple(name for joint in self.joints for name in joint.variables)

    @cached_property
    def joint_above(self) -> Mapping[str, RobotJoint]:
        """The joint that carries a link, by the link's name."""
        return {joint.child: joint for joint in self.joints}

    @cached_property
    def _index(self) -> Mapping[str, int]:
        return {name: index for index, name in enumerate(self.variables)}

    @cached_property
    def _followers(self) -> tuple[tuple[int, int, float, float], ...]:
        """Places of mimicking joint and leader, multiplier, offset; leaders before followers."""
        by_name = {joint.name: joint for joint in self.joints}
        rules: list[tuple[int, int, float, float]] = []
        for joint in self.joints:
            multiplier, offset, leader, seen = 1.0, 0.0, joint, {joint.name}
            while leader.mimic is not None:
                offset += multiplier * leader.mimic.offset
                multiplier *= leader.mimic.multiplier
                leader = by_name[leader.mimic.joint]
                if leader.name in seen:
                    break
                seen.add(leader.name)
            if leader is not joint and leader.is_active:
                rules.append((joint.first, leader.first, multiplier, offset))
        return tuple(rules)

    def group(self, name: str) -> JointGroup:
        """Return a group.

        Raises:
            NotFoundError: there is none of this name; the message lists those there are.
        """
        found = self.groups.get(name)
        if found is None:
            hint = f"planning groups of '{self.name}': {', '.join(self.groups) or 'none'}"
            near = nearest_names(name, self.groups)
            raise NotFoundError("planning group", name, nearest=near, hint=hint)
        return found

    def followers_of(self, variables: Sequence[str]) -> list[tuple[int, int, float, float]]:
        """Return what follows some of the variables.

        Returns:
            for each follower its place in the robot's positions, its leader's place among
            `variables`, multiplier and offset.
        """
        own = {name: place for place, name in enumerate(variables)}
        found = []
        for place, name in enumerate(self.variables):
            leader, factor, offset = self.mimic_of(name)
            if leader != name and leader in own:
                found.append((place, own[leader], factor, offset))
        return found

    def mimic_of(self, variable: str) -> tuple[str, float, float]:
        """Return the leading variable with multiplier and offset; itself for a free variable."""
        place = self._index[variable]
        for follower, leader, multiplier, offset in self._followers:
            if follower == place:
                return self.variables[leader], multiplier, offset
        return variable, 1.0, 0.0

    def default_positions(self) -> FloatArray:
        """Return the positions (v,) MoveIt starts with: 0, or the middle of a range without 0."""
        values = np.zeros(len(self.variables))
        for joint in self.joints:
            for index, limit in enumerate(joint.limits, start=joint.first):
                if not limit.continuous and not limit.lower <= 0.0 <= limit.upper:
                    low, high = limit.lower, limit.upper
                    ends = [end for end in (low, high) if np.isfinite(end)]
                    values[index] = sum(ends) / len(ends)
            if joint.kind is JointKind.FLOATING:
                values[joint.first + 6] = 1.0
        return self.completed(values)

    def positions(self, values: Mapping[str, float], base: FloatArray | None = None) -> FloatArray:
        """Return positions (v,) with some variables set and mimicking joints following.

        Args:
            values: by variable, rad or m.
            base: all other positions; the default ones when None.

        Raises:
            NotFoundError: the robot has no such variable.
        """
        found = self.default_positions() if base is None else np.array(base, dtype=np.float64)
        for name, value in values.items():
            if name not in self._index:
                near = nearest_names(name, self._index)
                hint = f"joints of '{self.name}': {', '.join(self.variables)}"
                raise NotFoundError("joint", name, nearest=near, hint=hint)
            found[self._index[name]] = value
        return self.completed(found)

    def with_group(self, group: JointGroup, q: FloatArray, base: FloatArray) -> FloatArray:
        """Return positions (v,) with a group at `q` (n,) and mimicking joints following."""
        found = np.array(base, dtype=np.float64)
        found[group.indices] = q
        return self.completed(found)

    def completed(self, positions: FloatArray) -> FloatArray:
        """Let mimicking joints follow, in place; returns the array (v,)."""
        for follower, leader, multiplier, offset in self._followers:
            positions[follower] = multiplier * positions[leader] + offset
        return positions

    def named(self, positions: FloatArray) -> dict[str, float]:
        """Return positions (v,) by variable."""
        return dict(zip(self.variables, positions.tolist(), strict=True))
