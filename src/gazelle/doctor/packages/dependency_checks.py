"""Packages that are used and not declared, and declared names that are nearly others."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

import gazelle.interfaces
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, nearest_names
from gazelle.doctor.packages.source import SourcePackage
from gazelle.node_specs.unavailable_packages import unavailable_packages
from gazelle.workspace import Workspace
from gazelle.workspace.environment_paths import builtin_package_names

__all__ = ["Use", "check_dependencies", "is_ros_package", "is_slip", "known_packages", "uses"]

_FAMILIES = ("ament_", "nav2_", "ros2", "rosidl_", "rqt_", "moveit_", "ros_gz", "ros_ign", "gz_")
_XML = (".launch", ".launch.xml", ".xml", ".xacro", ".urdf", ".world", ".sdf", ".srdf")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_IN_XML = re.compile(
    r"""\bpkg\s*=\s*["']([A-Za-z]\w*)["']|\$\(find(?:-pkg-share)?\s+(\w+)\s*\)
    |package://(\w+)/""",
    re.VERBOSE,
)
_IN_LAUNCH = re.compile(
    r"""(?:get_package_share_directory|get_package_share_path|FindPackageShare|FindPackagePrefix)
        \(\s*(?:package\s*=\s*)?["'](\w+)["']
    |\bpackage\s*=\s*["'](\w+)["']""",
    re.VERBOSE,
)
_IMPORT = re.compile(r"^[ \t]*(?:from\s+(\w+)[\w.]*\s+import|import\s+(\w+))", re.MULTILINE)
_LINE_COMMENT = re.compile(r"#[^\n]*")
_BUILD_ONLY = frozenset({"ament_cmake", "ament_python", "catkin", "gazebo"})
# Whoever starts a launch file has what reads it; Gazebo's own CMake file is of no ROS package.
_ALWAYS_THERE = frozenset(
    {"ament_index_python", "launch", "launch_ros", "launch_xml", "launch_yaml"}
)
_LONG_NAME = 12
_SHORT_WORD = 3
_DIGITS = re.compile(r"\d")


class Use(NamedTuple):
    """A package that a file needs."""

    package: str
    span: SourceSpan


@cache
def known_packages() -> frozenset[str]:
    """Return packages of ROS distributions: those elsewhere, stood in for, and of messages."""
    definitions = Path(gazelle.interfaces.__file__).parent / "definitions"
    messages = {path.stem for path in definitions.rglob("*.txt")}
    return unavailable_packages() | builtin_package_names() | messages


def is_ros_package(name: str) -> bool:
    """Tell whether a package comes with ROS."""
    return name in known_packages() or name.startswith(_FAMILIES)


def uses(source: SourcePackage) -> Iterator[Use]:
    """Yield what a package's launch files, descriptions, Python and ``CMakeLists.txt`` name."""
    for name in source.files:
        if source.is_test(name):
            continue
        if name.endswith(_XML) and name != "package.xml":
            text = _COMMENT.sub(_blanked, source.text(name))
            yield from _found(source, name, text, _IN_XML)
            if name.endswith(".xacro") and "<xacro:" in text:
                yield Use("xacro", source.span(name, 1))
        elif name.endswith(".py") and name != "setup.py":
            text = _LINE_COMMENT.sub("", source.text(name))
            yield from _found(source, name, text, _IN_LAUNCH)
            for use in _found(source, name, text, _IMPORT):
                if use.package not in sys.stdlib_module_names and is_ros_package(use.package):
                    yield use
    yield from _of_cmake(source)


def check_dependencies(
    source: SourcePackage, workspace: Workspace, diagnostics: Diagnostics
) -> None:
    """Report packages that are used and not declared, and declared ones that look mistyped."""
    declared = set(source.package.depends)
    missing: dict[str, SourceSpan] = {}
    for use in uses(source):
        is_own = use.package == source.package.name or use.package in _ALWAYS_THERE
        if use.package not in declared and not is_own and _is_package(use.package, workspace):
            missing.setdefault(use.package, use.span)
    # Declared, these would close a circle, which no build tool can sort.
    above = _depending(source.package.name, workspace)
    missing = {name: span for name, span in missing.items() if name not in above}
    if missing:
        _report_undeclared(source, missing, diagnostics)
    _check_declared(source, workspace, diagnostics)


def is_slip(name: str, other: str) -> bool:
    """Tell a slip of the finger from two names of one family, as ``a_msgs`` and ``b_msgs`` are."""
    if _is_family(name, other):
        return False
    longest = max(len(name), len(other))
    begin, end = _same_begin(name, other), _same_begin(name[::-1], other[::-1])
    # Two letters that changed places are one slip.
    wrong = 1 if longest < _LONG_NAME and sorted(name) != sorted(other) else 2
    return begin + end >= longest - wrong and abs(len(name) - len(other)) <= wrong


def _is_family(name: str, other: str) -> bool:
    """Tell names of one family by a number or a short word: ``tb3_viz``, ``tb4_viz``, ``tb3_gz``.

    Of three letters one is forgotten or doubled; two different ones are two words.
    """
    if _DIGITS.sub("", name) == _DIGITS.sub("", other):
        return True
    words, others = name.split("_"), other.split("_")
    pairs = [pair for pair in zip(words, others, strict=False) if pair[0] != pair[1]]
    if len(words) != len(others) or len(pairs) != 1:
        return False
    short, long = sorted(pairs[0], key=len)
    is_short = len(long) <= _SHORT_WORD and sorted(short) != sorted(long)
    return is_short and not any(long[:i] + long[i + 1 :] == short for i in range(len(long)))


def _is_package(name: str, workspace: Workspace) -> bool:
    return is_ros_package(name) or name in workspace.packages


def _depending(name: str, workspace: Workspace) -> set[str]:
    """Return the user's packages that depend on one, by way of others too."""
    found, waiting = set[str](), [name]
    while waiting:
        wanted = waiting.pop()
        for package in workspace.user_packages:
            if wanted in package.depends and package.name not in found:
                found.add(package.name)
                waiting.append(package.name)
    return found


def _report_undeclared(
    source: SourcePackage, missing: dict[str, SourceSpan], diagnostics: Diagnostics
) -> None:
    rows = []
    for name, span in sorted(missing.items()):
        file = span.file.removeprefix(f"{source.folder}/")
        rows.append(f"{name} ({file}:{span.line})")
    text = f"the package uses and does not declare {', '.join(rows)}: rosdep installs what is "
    text += "declared, and builds go by it"
    tag = "exec_depend" if source.package.format >= 2 else "run_depend"
    fix = "add " + "".join(f"<{tag}>{name}</{tag}>" for name in sorted(missing))
    diagnostics.report("package.undeclared", text, source.manifest_span, fix=fix)


def _check_declared(source: SourcePackage, workspace: Workspace, diagnostics: Diagnostics) -> None:
    root = source.manifest
    for tag in root.children if root is not None else ():
        name = tag.text
        if not tag.name.endswith("depend") or not name or _is_package(name, workspace):
            continue
        near = nearest_names(name, [*workspace.packages, *known_packages()], count=1)
        if not near or not is_slip(name, near[0]):
            continue
        text = f"<{tag.name}>{name}</{tag.name}>: there is no package '{name}' here nor one that "
        text += f"comes with ROS (Cannot locate rosdep definition for [{name}])"
        hint = did_you_mean(name, near)
        diagnostics.report("package.unknown-dependency", text, tag.span, fix=hint)


def _same_begin(name: str, other: str) -> int:
    pairs = enumerate(zip(name, other, strict=False))
    return next((i for i, (a, b) in pairs if a != b), min(len(name), len(other)))


def _found(source: SourcePackage, name: str, text: str, pattern: re.Pattern[str]) -> Iterator[Use]:
    for found in pattern.finditer(text):
        word = next(item for item in found.groups() if item)
        start = found.start() + found.group().rindex(word)
        line = text.count("\n", 0, start) + 1
        column = start - text.rfind("\n", 0, start)
        yield Use(word, source.span(name, line, column, len(word)))


def _of_cmake(source: SourcePackage) -> Iterator[Use]:
    lists = source.lists
    for step in lists.called("find_package") if lists is not None else ():
        if not step.arguments or step.is_conditional:
            continue
        names = [step.arguments[0]]
        if names == ["catkin"]:
            names = list(step.after("COMPONENTS", ("REQUIRED", "QUIET", "OPTIONAL_COMPONENTS")))
        for name in names:
            if name not in _BUILD_ONLY and is_ros_package(name):
                yield Use(name, step.span)


def _blanked(found: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", found[0])
