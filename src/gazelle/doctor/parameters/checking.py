"""The front functions: one file, one description's text, one robot with its files, one package."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.report import Section
from gazelle.workspace import Package, Workspace

__all__ = [
    "check_description_text",
    "check_names",
    "check_package_parameters",
    "check_parameter_file",
]


def check_parameter_file(
    path: Path,
    *,
    diagnostics: Diagnostics,
    generation: int | None = None,
    joints: Collection[str] = (),
) -> None:
    """Check the layout, the values and the keys of a YAML file with parameters.

    Args:
        path: the file.
        diagnostics: receives the findings.
        generation: 1 when roslaunch loads it, 2 when a ROS 2 node does; None takes the file's own
            layout at its word.
        joints: names of the robot's joints, for words that YAML takes for something else.
    """


def check_description_text(text: str, *, file: str, diagnostics: Diagnostics) -> None:
    """Report what keeps a robot description from being passed to a ROS 2 node as a parameter.

    Args:
        text: URDF text as it becomes the parameter.
        file: name for the places.
        diagnostics: receives the findings.
    """


def check_names(model: Model, files: Sequence[Path], *, diagnostics: Diagnostics) -> Section | None:
    """Compare the names of a robot with those of its controllers' and MoveIt's files.

    Args:
        model: the robot, read from its URDF.
        files: parameter files and SRDFs that are for this robot.
        diagnostics: receives the findings.

    Returns:
        The section ``names``: one row per joint or controller; None when no file names any.
    """
    return None


def check_package_parameters(
    package: Package, *, workspace: Workspace, diagnostics: Diagnostics
) -> tuple[Section, ...]:
    """Check every parameter file of a package, and its names against the robots they are for.

    Args:
        package: a source package.
        workspace: finds the packages whose robots this one configures.
        diagnostics: receives the findings.
    """
    return ()
