"""What the C++ of a package needs to be compiled here: a compiler, headers, packages."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain
from gazelle.cpp.requirements import header_advice, package_advice
from gazelle.cpp.static_needs import MissingHeader, needs_of
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.packages.source import SourcePackage
from gazelle.workspace import Workspace
from gazelle.workspace.building.cmake_plan import has_compiled_targets

__all__ = ["check_cpp"]

_SHOWN = 5
_OF_SYSTEM = {
    "OpenCV": "apt install libopencv-dev",
    "PCL": "apt install libpcl-dev",
    "yaml-cpp": "apt install libyaml-cpp-dev",
}


def check_cpp(source: SourcePackage, workspace: Workspace, diagnostics: Diagnostics) -> None:
    """Report what the C++ of a package lacks, before anybody builds it."""
    if source.lists is None or not has_compiled_targets(source.lists):
        return
    needs = needs_of(source.package, workspace)
    for refused in needs.refused:
        text = f"target '{refused.target}' is left out, for it needs '{refused.package}': "
        diagnostics.report("package.cpp-left-out", text + refused.why, refused.span)
    for package in needs.packages:
        text = f"package '{package.name}', which CMakeLists.txt requires, is not here"
        _, fix = package_advice(package.name, needs.generation)
        fix = _OF_SYSTEM.get(package.name, fix)
        diagnostics.report("package.cpp-package", text, package.span, fix=fix)
    for target, headers in _by_target(needs.headers):
        names = ", ".join(f"'{item.name}'" for item in headers[:_SHOWN])
        more = f" and {len(headers) - _SHOWN} more" if len(headers) > _SHOWN else ""
        text = f"target '{target}' does not compile: there is no {names}{more}"
        _, fix = header_advice(headers[0].name, needs.generation)
        diagnostics.report("package.cpp-header", text, headers[0].span, fix=fix)
    try:
        find_toolchain()
    except NoToolchainError as error:
        why, _, fix = str(error).partition("\n  fix: ")
        span = source.span("CMakeLists.txt")
        diagnostics.report("package.cpp-compiler", f"C++ of the package: {why}", span, fix=fix)


def _by_target(headers: Iterable[MissingHeader]) -> list[tuple[str, list[MissingHeader]]]:
    found: dict[str, list[MissingHeader]] = {}
    for item in headers:
        found.setdefault(item.target, []).append(item)
    return [*found.items()]
