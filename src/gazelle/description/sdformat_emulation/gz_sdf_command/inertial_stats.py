"""Mass, centre and moments of a model as a whole, printed as ``--inertial-stats`` does."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.description.sdformat_emulation.gz_sdf_command.checks.frame_semantics import Scope
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.pose_relative_to_graph import (
    pose_in_scope,
    relative_graph,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.scopes import Link, ModelScope
from gazelle.description.sdformat_emulation.gz_sdf_command.console import SdfError
from gazelle.description.sdformat_emulation.gz_sdf_command.values import (
    notation_of,
    number_of,
    pose_of,
)
from gazelle.geometry import Pose

__all__ = ["inertial_stats"]

Matrix = NDArray[np.float64]
_WIDTH = 2


def inertial_stats(model: ModelScope) -> str:
    """Return the report on a model's own links; moments are about the centre of mass."""
    errors: list[SdfError] = []
    scope = relative_graph(model, errors).child(model.name)
    bodies = [_body(link, _pose_of_link(link, scope)) for link in model.links]
    mass = sum(body[0] for body in bodies)
    centre = sum((body[0] * body[1] for body in bodies), np.zeros(3)) / (mass or 1.0)
    moments = sum((_about(body, centre) for body in bodies), np.zeros((3, 3)))
    cells = [f"{round(float(value), 6) + 0.0:g}" for value in moments.flat]
    width = max(map(len, cells))
    rows = [
        "".join(f"{cell:<{width + _WIDTH}}" for cell in cells[row : row + 3]) for row in (0, 3, 6)
    ]
    axes = [f"{axis}: {value:g}" for axis, value in zip("XYZ", centre, strict=True)]
    lines = [
        f"Inertial statistics for model: {model.name}", "---",
        f"Total mass of the model: {mass:g}", "---",
        "Centre of mass in model frame: ", *axes, "---",
        "Moment of inertia matrix: ", *rows, "---",
    ]  # fmt: skip
    warning = (
        "Warning: Inertial properties of links in nested models will not be included.\n"
        if model.models
        else ""
    )
    return warning + "".join(f"{line}\n" for line in lines)


def _pose_of_link(link: Link, scope: Scope) -> Pose:
    number = scope.number(link.name)
    found = None if number is None else pose_in_scope(scope, number, [])
    return found or link.pose


def _body(link: Link, pose: Pose) -> tuple[float, Matrix, Matrix]:
    """Return mass, centre and moments about it, all in the model's frame."""
    values = {"mass": 1.0, "ixx": 1.0, "iyy": 1.0, "izz": 1.0, "ixy": 0.0, "ixz": 0.0, "iyz": 0.0}
    for element in link.inertial.walk() if link.inertial is not None else ():
        if element.name in values and element.text:
            values[element.name] = number_of(element.text)
        elif element.name == "pose":
            pose = pose @ pose_of(element.text, notation_of(element.attributes))
    xy, xz, yz = values["ixy"], values["ixz"], values["iyz"]
    moments = np.array([[values["ixx"], xy, xz], [xy, values["iyy"], yz], [xz, yz, values["izz"]]])
    turn = pose.matrix()[:3, :3]
    return values["mass"], np.array(pose.position_m), turn @ moments @ turn.T


def _about(body: tuple[float, Matrix, Matrix], point: Matrix) -> Matrix:
    mass, centre, moments = body
    arm = centre - point
    return moments + mass * (float(arm @ arm) * np.eye(3) - np.outer(arm, arm))
