"""The robot of the parameters, and where it is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.description.loader import load_models
from gazelle.description.srdf import load_srdf
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.geometry import Pose
from gazelle.graph import Node
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import Solver, link_poses
from gazelle.motion.model import JointGroup, RobotModel
from gazelle.nodes.move_group.planning_scene_monitor import CurrentStateMonitor
from gazelle.workspace import Workspace

__all__ = ["RobotInterface"]

_STATE_S = 1.0


class RobotInterface:
    """A robot with the positions that ``joint_states`` tells.

    Attributes:
        model: joints and groups.
        states: listens to joint states.
    """

    def __init__(self, model: RobotModel, states: CurrentStateMonitor) -> None:
        self.model = model
        self.states = states

    @classmethod
    def of_node(cls, node: Node, description: str = "robot_description") -> RobotInterface:
        """Return the robot that a parameter describes.

        Raises:
            GazelleError: there is no such parameter, or it is no robot.
        """
        texts = {part: _text(node, f"{description}{part}") for part in ("", "_semantic")}
        diagnostics = Diagnostics()
        workspace = Workspace.discover()
        models = load_models(texts[""], workspace=workspace, diagnostics=diagnostics, inserts=False)
        if not models:
            diagnostics.raise_if_errors()
            raise GazelleError(f"parameter '{description}' is no robot")
        srdf = load_srdf(
            texts["_semantic"], robot=models[0], workspace=workspace, diagnostics=diagnostics
        )
        model = RobotModel.build(models[0], srdf, diagnostics=diagnostics)
        return cls(model, CurrentStateMonitor(node))

    def group(self, name: str) -> JointGroup:
        """Return a planning group.

        Raises:
            NotFoundError: there is none of this name.
        """
        return self.model.group(name)

    def positions(self) -> FloatArray:
        """Return where all joints are, of shape (variables,) of the robot, rad or m.

        Those nobody tells of are at their defaults.
        """
        self.states.wait(self._driven(), 0, _STATE_S)
        known = set(self.model.variables)
        told = {name: value for name, value in self.states.positions.items() if name in known}
        return self.model.positions(told)

    def link_pose(self, link: str, positions: FloatArray | None = None) -> Pose:
        """Return the pose of a link in the planning frame.

        Args:
            link: its name.
            positions: of all joints, of shape (variables,), rad or m; where the robot is when
                None.
        """
        where = self.positions() if positions is None else positions
        return Pose.from_matrix(link_poses(self.model, where, [link])[link])

    def solver(self, group: str) -> Solver:
        """Return the kinematics of a group where the robot is now."""
        return Solver(self.model, group, positions=self.positions())

    def named_state(self, group: str, name: str) -> Mapping[str, float]:
        """Return a state of the SRDF, positions by joint.

        Raises:
            KeyError: the group has none of this name.
        """
        return self.group(group).states[name]

    def _driven(self) -> tuple[str, ...]:
        return tuple(joint.name for joint in self.model.joints if joint.is_active)


def _text(node: Node, name: str) -> str:
    found = node.parameters.search(name)
    value: Any = node.parameters.get(found) if found else ""
    if not value:
        text = f"there is no parameter '{name}'; start the launch file that sets it"
        raise GazelleError(f"{text} (Robot model parameter not found!)")
    return str(value)
