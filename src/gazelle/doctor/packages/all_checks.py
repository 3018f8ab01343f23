"""All checks of one package."""

from __future__ import annotations

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.packages.cpp_checks import check_cpp
from gazelle.doctor.packages.dependency_checks import check_dependencies
from gazelle.doctor.packages.install_checks import check_install
from gazelle.doctor.packages.manifest_checks import check_manifest
from gazelle.doctor.packages.message_checks import check_messages
from gazelle.doctor.packages.python_checks import check_python
from gazelle.doctor.packages.python_source_checks import check_python_sources
from gazelle.doctor.packages.ros_versions import check_ros_versions, ros_versions_section
from gazelle.doctor.packages.source import SourcePackage
from gazelle.doctor.report import Section
from gazelle.workspace import Package, Workspace

__all__ = ["check_package"]


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
    for item in workspace.diagnostics.by_code("workspace.bad-manifest"):
        if item.span is not None and item.span.file.startswith(f"{package.path}/"):
            diagnostics.add(item)
    if package.prefix is not None or package.is_builtin:
        return ()
    source = SourcePackage(package)
    check_manifest(source, diagnostics)
    check_install(source, diagnostics)
    check_python(source, diagnostics)
    check_python_sources(source, workspace, diagnostics)
    check_messages(source, diagnostics)
    check_dependencies(source, workspace, diagnostics)
    check_cpp(source, workspace, diagnostics)
    check_ros_versions(source, diagnostics)
    return (ros_versions_section(source),)
