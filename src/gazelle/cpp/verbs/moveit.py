"""Robots for MoveIt's interfaces in C++: joints, groups, and where links are."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.cpp.verbs import verb
from gazelle.cpp.verbs.package import workspace_of
from gazelle.errors import GazelleError
from gazelle.geometry import Pose

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext
    from gazelle.motion.model import JointGroup, RobotModel

__all__ = ["fk", "ik", "model", "random_positions"]

_MODELS = "moveit/models"


@verb("moveit/model")
def model(host: HostContext, request: dict[str, Any]) -> dict[str, Any]:
    """Read a robot and return its joints and groups, and a key by which it is asked for.

    Args:
        host: keeps it.
        request: ``urdf`` and ``srdf``, texts.

    Raises:
        GazelleError: it is no robot.
    """
    from gazelle.description.loader import load_models
    from gazelle.description.srdf import load_srdf
    from gazelle.diagnostics import Diagnostics
    from gazelle.motion.model import RobotModel

    urdf, srdf_text = request["urdf"], request["srdf"]
    key = hashlib.sha256(f"{urdf}\0{srdf_text}".encode()).hexdigest()
    kept = host.state.setdefault(_MODELS, {})
    if key not in kept:
        diagnostics, workspace = Diagnostics(), workspace_of(host)
        models = load_models(urdf, workspace=workspace, diagnostics=diagnostics, inserts=False)
        if not models:
            diagnostics.raise_if_errors()
            raise GazelleError("the description is no robot")
        srdf = load_srdf(srdf_text, robot=models[0], workspace=workspace, diagnostics=diagnostics)
        kept[key] = RobotModel.build(models[0], srdf, diagnostics=diagnostics)
    robot: RobotModel = kept[key]
    return {
        "key": key,
        "name": robot.name,
        "frame": robot.frame,
        "root": robot.root_link,
        "links": list(robot.links),
        "variables": list(robot.variables),
        "defaults": robot.default_positions().tolist(),
        "joints": [
            {
                "name": joint.name,
                "type": joint.kind.value,
                "child": joint.child,
                "variables": list(joint.variables),
                "is_active": joint.is_active,
                "bounds": [[limit.lower, limit.upper, limit.velocity] for limit in joint.limits],
            }
            for joint in robot.joints
        ],
        "groups": [_group(robot, group) for group in robot.groups.values()],
    }


@verb("moveit/fk")
def fk(host: HostContext, request: dict[str, Any]) -> list[list[float]]:
    """Return the 4×4 poses of links, row by row, one after the other.

    Args:
        host: has the robot.
        request: its ``key``, ``positions`` of all variables, ``links``.
    """
    from gazelle.motion.kinematics import link_poses

    robot = _robot(host, request)
    positions = np.array(request["positions"], dtype=np.float64)
    found = link_poses(robot, positions, request["links"])
    return [found[link].ravel().tolist() for link in request["links"]]


@verb("moveit/ik")
def ik(host: HostContext, request: dict[str, Any]) -> list[float] | None:
    """Return positions of a group that bring a link to a pose, null where none are found.

    Args:
        host: has the robot.
        request: its ``key``, ``group``, ``link`` or an empty text, ``pose`` (x y z, quaternion
            x y z w), ``positions`` to start from, ``timeout_s``.
    """
    from gazelle.motion.kinematics import Patience, Solver

    robot = _robot(host, request)
    positions = np.array(request["positions"], dtype=np.float64)
    solver = Solver(robot, request["group"], positions=positions)
    x, y, z, *quat = request["pose"]
    pose = Pose((x, y, z), (quat[0], quat[1], quat[2], quat[3]))
    timeout_s = request["timeout_s"] or None
    found = solver.ik(
        pose.matrix(),
        seed_q=solver.group.take(positions),
        patience=Patience(timeout_s=timeout_s),
        link=request["link"],
    )
    return None if found is None else found.tolist()


@verb("moveit/random")
def random_positions(host: HostContext, request: dict[str, Any]) -> list[float]:
    """Return a random configuration of a group."""
    space = _robot(host, request).group(request["group"]).space
    found: list[float] = space.sample(np.random.default_rng()).tolist()
    return found


def _robot(host: HostContext, request: dict[str, Any]) -> RobotModel:
    found: RobotModel = host.state[_MODELS][request["key"]]
    return found


def _group(robot: RobotModel, group: JointGroup) -> dict[str, Any]:
    effectors = {one.name: one for one in robot.srdf.end_effectors}
    tips = [effectors[name].parent_link for name in group.end_effectors if name in effectors]
    return {
        "name": group.name,
        "joints": list(group.joints),
        "active_joints": list(group.active_joints),
        "links": list(group.links),
        "variables": list(group.variables),
        "indices": group.indices.tolist(),
        "is_chain": group.is_chain,
        "tips": list(group.tip_links),
        "end_effectors": list(group.end_effectors),
        "effector_links": tips,
        "subgroups": list(group.subgroups),
        "states": {name: dict(values) for name, values in group.states.items()},
    }
