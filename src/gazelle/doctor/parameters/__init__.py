"""Checks of parameter files, and of the names that they and robot descriptions share."""

from __future__ import annotations

from gazelle.doctor.parameters.all_checks import (
    check_package_parameters,
    check_parameter_file,
)
from gazelle.doctor.parameters.name_checks import check_names
from gazelle.doctor.parameters.robot_descriptions import check_description_text

__all__ = [
    "check_description_text",
    "check_names",
    "check_package_parameters",
    "check_parameter_file",
]
