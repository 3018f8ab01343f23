"""``package.xml`` as catkin_pkg checks it before a build."""

from __future__ import annotations

import re

from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, Severity, did_you_mean
from gazelle.doctor.packages.dependency_checks import is_slip
from gazelle.doctor.packages.source import SourcePackage

__all__ = ["check_manifest"]

# REP-127, REP-140 and REP-149; the words are those of catkin_pkg's own verdicts.
_VERSION = re.compile(r"\d+\.\d+\.\d+")
_NAME = re.compile(r"[a-z][a-z0-9_]*|[a-zA-Z0-9][a-zA-Z0-9_-]*")
_REQUIRED = ("name", "version", "description", "maintainer", "license")
_ONLY_FORMAT_1 = ("run_depend",)
_NOT_FORMAT_1 = (
    "build_export_depend",
    "buildtool_export_depend",
    "depend",
    "doc_depend",
    "exec_depend",
)
_KNOWN = frozenset(
    {
        *_REQUIRED, *_ONLY_FORMAT_1, *_NOT_FORMAT_1, "url", "author", "buildtool_depend", "export",
        "build_depend", "conflict", "replace", "test_depend", "group_depend", "member_of_group",
    }
)  # fmt: skip
_ONLY_ROS1 = frozenset(
    {
        "amcl", "dynamic_reconfigure", "gmapping", "message_generation", "message_runtime",
        "move_base", "nodelet", "roscpp", "roslaunch", "rospy", "rostest",
    }
)  # fmt: skip
_BUILD_TYPES = ("ament_cmake", "ament_python", "catkin", "cmake")


def check_manifest(source: SourcePackage, diagnostics: Diagnostics) -> None:
    """Report what the build tools of ROS would refuse in a manifest."""
    root = source.manifest
    if root is None or root.name != "package":
        return
    _check_format(root, diagnostics)
    _check_fields(root, diagnostics)
    _check_build_type(source, root, diagnostics)
    _check_names(source, root, diagnostics)


def _check_format(root: Tag, diagnostics: Diagnostics) -> None:
    written = root.attributes.get("format", "1").strip()
    if written not in {"1", "2", "3"}:
        text = f"the manifest's format is '{written}', there are 1, 2 and 3; it is read as 1"
        fix = 'write <package format="3"> (ROS 1: "2")'
        diagnostics.report("package.manifest", text, root.span, fix=fix)
        return
    banned = _NOT_FORMAT_1 if written == "1" else _ONLY_FORMAT_1
    for tag in root.children:
        if tag.name in banned:
            text = f"<{tag.name}> does not exist in format {written} (The manifest (with format "
            text += f"version {written}) must not contain the following tags: {tag.name})"
            fix = 'write <package format="2">' if written == "1" else "write <exec_depend>"
            diagnostics.report("package.manifest", text, tag.span, fix=fix)
        elif tag.name not in _KNOWN:
            text = f"a manifest has no <{tag.name}>; it has no effect here"
            hint = did_you_mean(tag.name, _KNOWN)
            diagnostics.report("package.manifest", text, tag.span, fix=hint)


def _check_fields(root: Tag, diagnostics: Diagnostics) -> None:
    missing = [name for name in _REQUIRED if root.find(name) is None]
    if missing:
        shown = ", ".join(f"<{name}>" for name in missing)
        text = f"the manifest lacks {shown}; building the package for real stops there"
        fix = "add " + ", ".join(f"<{name}>…</{name}>" for name in missing)
        diagnostics.report("package.manifest", text, root.span, fix=fix)
    version = root.find("version")
    if version is not None and not _VERSION.fullmatch(version.text):
        text = f'Package version "{version.text}" does not follow version conventions: three '
        text += "numbers with dots between them"
        diagnostics.report("package.manifest", text, version.span, fix="write 0.1.0")
    name = root.find("name")
    if name is not None and not _NAME.fullmatch(name.text):
        text = f"the package's name '{name.text}' is not legal: letters, digits and _, beginning "
        text += "with a letter"
        fixed = re.sub(r"\W+", "_", name.text.strip().lower())
        diagnostics.report("package.manifest", text, name.span, fix=f"write {fixed}")


def _check_build_type(source: SourcePackage, root: Tag, diagnostics: Diagnostics) -> None:
    tag = root.find("export", "build_type")
    written = tag.text if tag is not None else ""
    span = tag.span if tag is not None else root.span
    wanted = source.build_type
    tool = root.find("buildtool_depend")
    other = {"catkin": "ament_cmake", "ament_cmake": "catkin"}.get(wanted)
    is_old = _ONLY_ROS1 & {child.text for child in root.children if child.name.endswith("depend")}
    if tool is not None and tool.text == other:
        text = f"<buildtool_depend> is {tool.text}, and {source.build_file.name} is for {wanted}: "
        text += f"it is built without {wanted}"
        fix = f"write <buildtool_depend>{wanted}</buildtool_depend>"
        diagnostics.report("package.build-type", text, tool.span, fix=fix)
    elif tool is not None and not written and wanted == "ament_cmake" and is_old:
        text = f"<buildtool_depend> is {tool.text}, which is ROS 2's, and the package depends on "
        text += f"{', '.join(sorted(is_old))} of ROS 1"
        fix = "write <buildtool_depend>catkin</buildtool_depend>"
        diagnostics.report("package.build-type", text, tool.span, fix=fix)
    elif written and written not in _BUILD_TYPES:
        text = f"the build type '{written}' is not known to colcon; it would leave the package out"
        hint = did_you_mean(written, _BUILD_TYPES)
        diagnostics.report("package.build-type", text, span, fix=hint)
    elif wanted.startswith("ament") and written not in {wanted, "cmake"}:
        file = "setup.py" if wanted == "ament_python" else "CMakeLists.txt"
        text = f"{file} is for {wanted}, "
        text += f"the build type is {written}" if written else "the manifest has no <build_type>"
        text += "" if written else ", so colcon takes the package for catkin's"
        fix = f"add <export><build_type>{wanted}</build_type></export>"
        diagnostics.report("package.build-type", text, span, fix=fix)
    elif not source.build_file.is_file():
        _report_no_build_file(source, root, diagnostics)


def _report_no_build_file(source: SourcePackage, root: Tag, diagnostics: Diagnostics) -> None:
    name, kind = source.build_file.name, source.build_type
    text = f"the package has no {name}: it runs from its source folder here, and on "
    text += f"ROS_PACKAGE_PATH; {'colcon build' if source.is_ros2 else 'catkin_make'} cannot "
    text += f"build it ({kind})"
    fix = f"gazelle new shows what a package of type {kind} needs"
    diagnostics.report("package.no-build-file", text, root.span, fix=fix)


def _check_names(source: SourcePackage, root: Tag, diagnostics: Diagnostics) -> None:
    name, lists, setup = source.package.name, source.lists, source.setup
    tag = root.find("name")
    folder = source.folder.name
    built = lists.project if lists is not None else setup.name if setup is not None else folder
    if (
        tag is not None
        and built == folder != name
        and (source.has_build_file or is_slip(name, folder))
    ):
        and_file = f" and of {source.build_file.name}" if source.has_build_file else ""
        text = f"<name> of the manifest is '{name}'; that of its folder{and_file} is '{built}'"
        hint = f"did you mean '{built}'?"
        diagnostics.report("package.names", text, tag.span, fix=hint, severity=Severity.ERROR)
        return
    if lists is not None and lists.project and lists.project != name and _is_ros(source):
        tool = "ament_package_xml()" if source.is_ros2 else "catkin_package()"
        text = f"project({lists.project}) and the manifest's <name>{name}</name> differ ({tool} "
        text += f"package name '{name}' does not match current PROJECT_NAME '{lists.project}')"
        diagnostics.report("package.names", text, lists.project_span, fix=f"project({name})")
    if setup is None or source.build_type != "ament_python" or setup.name is None:
        return
    if setup.name.replace("-", "_") != name.replace("-", "_"):
        text = f"setup(name='{setup.name}') and the manifest's <name>{name}</name> differ; "
        text += "colcon installs it under one name and looks for it under the other"
        diagnostics.report("package.names", text, setup.span, fix=f"name='{name}'")


def _is_ros(source: SourcePackage) -> bool:
    lists = source.lists
    return lists is not None and bool(lists.called("catkin_package", "ament_package"))
