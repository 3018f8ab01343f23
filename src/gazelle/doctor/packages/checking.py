"""All checks of one package, and of the ROS that a shell has sourced."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.report import Section
from gazelle.workspace import Package, Workspace

__all__ = ["check_environment", "check_package"]


def check_package(
    package: Package, *, workspace: Workspace, diagnostics: Diagnostics
) -> tuple[Section, ...]:
    """Check a source package's manifest, install rules, scripts and messages.

    Args:
        package: a package of a source tree; installed and built-in ones have nothing to check.
        workspace: knows which other packages there are.
        diagnostics: receives the findings.

    Returns:
        The section ``generations``: which ROS each part was written for, and why.
    """
    return ()


def check_environment(environ: Mapping[str, str], *, diagnostics: Diagnostics) -> None:
    """Report a sourced ROS that mixes two distributions.

    Args:
        environ: environment variables of the shell.
        diagnostics: receives the findings.
    """
