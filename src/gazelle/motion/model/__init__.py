"""Robots, joints and planning groups as motion sees them."""

from __future__ import annotations

from gazelle.motion.model.joint_groups import JointGroup
from gazelle.motion.model.joints import JointKind, MimicRule, RobotJoint, VariableLimit
from gazelle.motion.model.robot_model import RobotModel

__all__ = ["JointGroup", "JointKind", "MimicRule", "RobotJoint", "RobotModel", "VariableLimit"]
