"""Message, service and action files against the lists in ``CMakeLists.txt``."""

from __future__ import annotations

import re
from pathlib import PurePosixPath

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.doctor.packages.source import SourcePackage
from gazelle.documents.files import is_file
from gazelle.workspace.building.cmake_lists import Step

__all__ = ["check_messages"]

_KINDS = (".msg", ".srv", ".action")
_ROS1_CALLS = {
    ".msg": "add_message_files",
    ".srv": "add_service_files",
    ".action": "add_action_files",
}
_ROS2_CALL = "rosidl_generate_interfaces"
_KEYWORDS = ("ADD_LINTER_TESTS", "DEPENDENCIES", "LIBRARY_NAME", "SKIP_INSTALL", "DIRECTORY")
_GROUP = "rosidl_interface_packages"
# https://design.ros2.org/articles/legacy_interface_definition.html: names of interfaces.
_ROS2_NAME = re.compile(r"[A-Z][A-Za-z0-9]*")


def check_messages(source: SourcePackage, diagnostics: Diagnostics) -> None:
    """Report message files that are not generated, and listed ones that are not there."""
    lists = source.lists
    if lists is None or lists.problem is not None or source.rules is None or lists.hidden:
        return
    own = [
        name
        for name in source.files
        if PurePosixPath(name).suffix in _KINDS
        and PurePosixPath(name).parts[0] == PurePosixPath(name).suffix[1:]
    ]
    if source.is_ros2:
        _check_ros2(source, own, lists.called(_ROS2_CALL), diagnostics)
    else:
        _check_ros1(source, own, diagnostics)


def _check_ros1(source: SourcePackage, own: list[str], diagnostics: Diagnostics) -> None:
    assert source.lists is not None
    for kind, call in _ROS1_CALLS.items():
        files = [name for name in own if name.endswith(kind)]
        steps = source.lists.called(call)
        listed: list[str] = []
        for step in steps:
            folder = "".join(step.after("DIRECTORY", ("FILES", "BASE_DIR"))[:1]) or kind[1:]
            names = step.after("FILES", ("DIRECTORY", "BASE_DIR", "NOINSTALL"))
            # Without FILES the whole folder is meant.
            listed += [f"{folder}/{name}" for name in names] or files
            _check_listed(source, step, [f"{folder}/{name}" for name in names], files, diagnostics)
        for name in files:
            if name not in listed:
                fix = f"{call}(FILES … {PurePosixPath(name).name})"
                _report_unlisted(source, name, steps, fix, diagnostics)
        if steps and not source.lists.called("generate_messages"):
            text = f"{call}() without generate_messages(): nothing is generated"
            fix = "generate_messages(DEPENDENCIES std_msgs)"
            diagnostics.report("package.message-build", text, steps[0].span, fix=fix)


def _check_ros2(
    source: SourcePackage, own: list[str], steps: tuple[Step, ...], diagnostics: Diagnostics
) -> None:
    listed: list[str] = []
    for step in steps:
        words = step.arguments[1:]
        end = next((place for place, word in enumerate(words) if word in _KEYWORDS), len(words))
        root = str(source.folder) + "/"
        names = [word.removeprefix(root) for word in words[:end]]
        names = [name for name in names if PurePosixPath(name).suffix in _KINDS]
        listed += names
        _check_listed(source, step, names, own, diagnostics)
    for name in own:
        if name not in listed:
            fix = f'rosidl_generate_interfaces(${{PROJECT_NAME}} … "{name}")'
            _report_unlisted(source, name, steps, fix, diagnostics)
        if not _ROS2_NAME.fullmatch(PurePosixPath(name).stem):
            text = f"'{name}' is no name of an interface in ROS 2: letters and digits, beginning "
            text += "with a capital letter (rosidl: is an invalid message name)"
            diagnostics.report("package.message-build", text, source.span(name, 1))
    _check_group(source, steps, diagnostics)


def _check_group(source: SourcePackage, steps: tuple[Step, ...], diagnostics: Diagnostics) -> None:
    root = source.manifest
    if not steps or root is None:
        return
    if not any(tag.text == _GROUP for tag in root.find_all("member_of_group")):
        member = f"<member_of_group>{_GROUP}</member_of_group>"
        text = f"Packages installing interfaces must include '{member}' in their package.xml"
        diagnostics.report("package.message-build", text, root.span, fix=member)


def _check_listed(
    source: SourcePackage, step: Step, names: list[str], files: list[str], diagnostics: Diagnostics
) -> None:
    for name in names:
        if "${" in name or is_file(source.folder / step.folder / name):
            continue
        text = f"{step.name}() lists '{name}', and there is no such file; CMake stops there"
        hint = did_you_mean(name, files)
        diagnostics.report("package.message-missing", text, step.span, fix=hint)


def _report_unlisted(
    source: SourcePackage, name: str, steps: tuple[Step, ...], fix: str, diagnostics: Diagnostics
) -> None:
    span = steps[0].span if steps else source.span(name, 1)
    text = f"'{name}' is not listed in CMakeLists.txt: a build generates no code for it; Gazelle "
    text += "reads the file itself"
    diagnostics.report("package.message-unlisted", text, span, fix=fix)
