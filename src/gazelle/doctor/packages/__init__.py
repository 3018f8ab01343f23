"""Checks of a package's own files: manifest, install rules, messages, generations."""

from __future__ import annotations

from gazelle.doctor.packages.all_checks import check_package
from gazelle.doctor.packages.environment import check_environment

__all__ = ["check_environment", "check_package"]
