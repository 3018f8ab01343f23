"""What ``CMakeLists.txt`` installs, for ament, catkin and plain CMake, with its shell files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from gazelle.diagnostics import Severity, SourceSpan
from gazelle.documents.files import is_file, is_folder
from gazelle.workspace.building.cmake_lists import CMakeLists, Step, read_cmake_lists
from gazelle.workspace.building.install_rules import InstallRule, cmake_rules
from gazelle.workspace.building.packages import SourcePackage
from gazelle.workspace.building.plan import Item, Layout, Plan, add_rules
from gazelle.workspace.building.python_plan import (
    add_python_distribution,
    add_python_folder,
    completed,
)
from gazelle.workspace.building.setup_py import read_setup

__all__ = [
    "add_catkin",
    "add_interfaces",
    "compiled_targets",
    "gives_to_cpp",
    "has_compiled_targets",
    "plan_cmake",
    "read_lists",
]

_FAILURE = 'CMake Error: file INSTALL cannot find "{path}": No such file or directory'
_EXECUTABLES = frozenset(
    {
        "add_executable",
        "ament_auto_add_executable",
        "cs_add_executable",
        "cuda_add_executable",
        "rosbuild_add_executable",
    }
)
_LIBRARIES = frozenset(
    {
        "add_library",
        "ament_auto_add_library",
        "cs_add_library",
        "cuda_add_library",
        "pybind11_add_module",
        "rosbuild_add_library",
    }
)
_MAKES_HEADERS = (
    "catkin_simple",
    "generate_dynamic_reconfigure_options",
    "generate_messages",
    "generate_parameter_library",
    "rosbuild_genmsg",
    "rosbuild_gensrv",
    "rosidl_generate_interfaces",
)
_NOT_COMPILED = frozenset({"ALIAS", "IMPORTED", "INTERFACE"})
_INTERFACE_WORDS = frozenset(
    {"ADD_LINTER_TESTS", "DEPENDENCIES", "LIBRARY_NAME", "SKIP_GROUP_MEMBERSHIP_CHECK",
     "SKIP_INSTALL"}
)  # fmt: skip
_KINDS = (".msg", ".srv", ".action", ".idl")
_CATKIN_INTERFACES = {
    "add_message_files": "msg",
    "add_service_files": "srv",
    "add_action_files": "action",
}
_INDEX = "share/ament_index/resource_index"


def _add_environment_file(
    package: SourcePackage, step: Step, argument: str, folder: str, plan: Plan
) -> None:
    """Plan a shell or ``.dsv`` file that the package has sourced with its own."""
    if "${" in argument:
        # ament's own: the paths of libraries and programs, which are set.
        if not argument.startswith("${ament_cmake_package_templates_"):
            text = f"'{argument}' is known to CMake only; it is left out"
            plan.diagnostics.report("package.install-unread", text, step.span)
        return
    file = package.path / step.folder / argument
    if not is_file(file):
        text = f"{step.name}() names '{argument}', and there is no such file"
        plan.diagnostics.report("package.install-missing", text, step.span)
        return
    name = file.name.removesuffix(".in")
    plan.write(f"{folder}/{name}", _configured(file, package))
    if name.endswith((".sh", ".dsv", ".bash", ".zsh")):
        plan.scripts.append(f"{folder}/{name}")


def add_catkin(package: SourcePackage, lists: CMakeLists, layout: Layout, plan: Plan) -> None:
    """Plan Python modules and environment hooks; they are in devel and install spaces alike."""
    for step in lists.called("catkin_python_setup"):
        setup = read_setup(package.path)
        if setup is None or (setup.error is None and not setup.is_called):
            text = "catkin_python_setup() needs a setup.py with setup()"
            plan.diagnostics.report("package.no-build-file", text, step.span)
        elif setup.error is None:
            add_python_distribution(package, completed(package, setup, plan), layout, plan)
    for step in lists.called("catkin_add_env_hooks"):
        _add_hooks(package, step, "etc/catkin/profile.d", plan)


def read_lists(
    package: SourcePackage, plan: Plan, definitions: Mapping[str, str]
) -> CMakeLists | None:
    """Read a package's ``CMakeLists.txt``; None, and an error in the plan, when that fails."""
    lists = read_cmake_lists(package.path, package.name, definitions)
    if lists is None:
        text = f"package '{package.name}' is {package.build_type} and has no CMakeLists.txt"
        span = SourceSpan(str(package.path / "package.xml"))
        plan.diagnostics.report("package.no-build-file", text, span, severity=Severity.ERROR)
        return None
    if lists.problem is not None:
        problem, span = lists.problem
        plan.diagnostics.report("package.cmake-syntax", f"CMake stops here: {problem.text}", span)
        return None
    return lists


def plan_cmake(
    package: SourcePackage,
    layout: Layout,
    definitions: Mapping[str, str],
    plan: Plan,
    *,
    compiles: bool = False,
) -> None:
    """Plan a package with a ``CMakeLists.txt``.

    Args:
        package: what to build.
        layout: where its modules go.
        definitions: variables for ``CMakeLists.txt``.
        plan: receives items and findings.
        compiles: somebody compiles; otherwise what has to be compiled is reported.
    """
    lists = read_lists(package, plan, definitions)
    if lists is None:
        return
    share = f"share/{package.name}"
    rules = cmake_rules(lists, share)
    by_cmake = compiles and has_compiled_targets(lists)
    found = [rule for rule in rules.rules if not (by_cmake and _is_made(rule))]
    add_rules(plan, package.path, found, _FAILURE, lists.made)
    for span in () if by_cmake else rules.unread:
        text = "what this installs is known only to CMake; it is left out"
        plan.diagnostics.report("package.install-unread", text, span)
    if not compiles:
        compiled_targets(package, lists, plan)
    add_interfaces(package, lists, plan)
    if package.build_type == "catkin":
        add_catkin(package, lists, layout, plan)
    else:
        _add_ament(package, lists, layout, plan)
    plan.add(Item(f"{share}/package.xml", package.path / "package.xml"))


def _is_made(rule: InstallRule) -> bool:
    """Tell whether a rule installs what CMake makes, or where only it knows to."""
    return not rule.is_known or "$<" in rule.source + rule.destination


def has_compiled_targets(lists: CMakeLists) -> bool:
    """Tell whether a ``CMakeLists.txt`` has something to compile, or headers for those who do."""
    return bool(lists.compiling) or any(
        len(step.arguments) > 1 and not {"ALIAS", "IMPORTED"} & set(step.arguments)
        for step in lists.called(*_EXECUTABLES, *_LIBRARIES)
    )


def gives_to_cpp(lists: CMakeLists) -> bool:
    """Tell whether C++ of other packages may need what building this one makes."""
    return has_compiled_targets(lists) or bool(lists.called(*_MAKES_HEADERS))


def compiled_targets(package: SourcePackage, lists: CMakeLists, plan: Plan) -> None:
    """Report executables and libraries that need a compiler, each with its line."""
    for step in lists.called(*_EXECUTABLES, *_LIBRARIES):
        if len(step.arguments) < 2 or _NOT_COMPILED & set(step.arguments):
            continue
        kind = "executable" if step.name in _EXECUTABLES else "library"
        sources = [argument for argument in step.arguments[1:] if PurePosixPath(argument).suffix]
        code = f" ({', '.join(sources[:3])})" if sources else ""
        text = (
            f"{kind} '{step.arguments[0]}'{code} of package '{package.name}' is compiled code; it "
        )
        text += "is not built"
        plan.diagnostics.report("build.compiled-target", text, step.span)
    for step in lists.compiling:
        text = f"{step.name}({' '.join(step.arguments[:2])} …) of package '{package.name}' makes "
        text += "compiled code; it is not built"
        plan.diagnostics.report("build.compiled-target", text, step.span)


def add_interfaces(package: SourcePackage, lists: CMakeLists, plan: Plan) -> None:
    """Install message, service and action files, from where Gazelle reads them itself."""
    names: list[str] = []
    for step in lists.called("rosidl_generate_interfaces"):
        for argument in step.arguments[1:]:
            if argument in _INTERFACE_WORDS:
                break
            names += [argument] if PurePosixPath(argument).suffix in _KINDS else []
        _add_interface_files(package, names, step, plan)
    for step in lists.called(*_CATKIN_INTERFACES):
        folder = "".join(step.after("DIRECTORY", ("FILES",))[:1]) or _CATKIN_INTERFACES[step.name]
        files = step.after("FILES", ("DIRECTORY", "BASE_DIR", "NOINSTALL"))
        listed = [f"{folder}/{name}" for name in files]
        if not files and is_folder(package.path / folder):
            ending = f"*.{_CATKIN_INTERFACES[step.name]}"
            found = sorted((package.path / folder).glob(ending))
            listed = [f"{folder}/{file.name}" for file in found]
        _add_interface_files(package, listed, step, plan)
    if names:
        lines = sorted({f"{PurePosixPath(n).parent.name}/{PurePosixPath(n).name}" for n in names})
        plan.write(f"{_INDEX}/rosidl_interfaces/{package.name}", "\n".join(lines) + "\n")


def _configured(file: Path, package: SourcePackage) -> str:
    text = file.read_text(encoding="utf-8", errors="replace")
    if file.suffix == ".in":
        text = text.replace("@PROJECT_NAME@", package.name)
        text = text.replace("${PROJECT_NAME}", package.name)
    return text


def _add_hooks(package: SourcePackage, step: Step, folder: str, plan: Plan) -> None:
    """Plan the shell files of a ``catkin_add_env_hooks`` call."""
    keywords = ("SHELLS", "DIRECTORY", "SKIP_INSTALL")
    where = "".join(step.after("DIRECTORY", keywords)[:1]) or "env-hooks"
    for shell in step.after("SHELLS", keywords):
        if shell not in {"sh", "bash", "zsh"} or not step.arguments:
            continue
        names = [f"{where}/{step.arguments[0]}.{shell}{ending}" for ending in ("", ".in")]
        found = [name for name in names if is_file(package.path / step.folder / name)]
        for name in found:
            _add_environment_file(package, step, name, folder, plan)
        if not found:
            text = f"'{names[0]}' is not there as it is sourced (an .em file is made by catkin "
            text += "only); the hook is left out"
            plan.diagnostics.report("package.install-unread", text, step.span)


def _add_interface_files(package: SourcePackage, names: list[str], step: Step, plan: Plan) -> None:
    for name in names:
        file = package.path / step.folder / name
        if "${" in name:
            continue
        if not is_file(file):
            text = f"{step.name}() lists '{name}', and there is no such file; CMake stops there"
            plan.diagnostics.report("package.message-missing", text, step.span)
            continue
        kind = PurePosixPath(name).suffix[1:]
        plan.add(Item(f"share/{package.name}/{kind}/{file.name}", file), step.span)


def _add_ament(package: SourcePackage, lists: CMakeLists, layout: Layout, plan: Plan) -> None:
    for step in lists.called("ament_python_install_package", "ament_python_install_module"):
        _add_ament_python(package, step, layout, plan)
    for step in lists.called("ament_environment_hooks", "ament_package", "ament_auto_package"):
        if step.name == "ament_environment_hooks":
            for argument in step.arguments:
                _add_environment_file(
                    package, step, argument, f"share/{package.name}/environment", plan
                )
    for step in lists.called("ament_index_register_resource"):
        _add_resource(package, step, plan)
    for step in lists.called("pluginlib_export_plugin_description_file"):
        if len(step.arguments) > 1:
            name = f"share/{package.name}/{PurePosixPath(step.arguments[1]).name}"
            file = package.path / step.folder / step.arguments[1]
            if is_file(file):
                plan.add(Item(name, file), step.span)
            marker = f"{_INDEX}/{step.arguments[0]}__pluginlib__plugin/{package.name}"
            plan.write(marker, f"{name}\n")
    _add_ament_markers(package, lists, plan)


def _add_ament_markers(package: SourcePackage, lists: CMakeLists, plan: Plan) -> None:
    if package.build_type == "ament_cmake" and not lists.called(
        "ament_package", "ament_auto_package"
    ):
        text = "ament_package() is not called: a real build leaves the package out of the index of "
        text += "packages (PackageNotFoundError); it is entered all the same"
        span = lists.project_span or SourceSpan(str(lists.file))
        fix = "write ament_package() as the last line"
        code = "package.index-marker"
        plan.diagnostics.report(code, text, span, fix=fix, severity=Severity.WARNING)
    if package.build_type == "cmake":
        return
    needs = sorted(package.depends("run"))
    plan.write(f"{_INDEX}/packages/{package.name}")
    plan.write(f"{_INDEX}/package_run_dependencies/{package.name}", ";".join(needs))


def _add_ament_python(package: SourcePackage, step: Step, layout: Layout, plan: Plan) -> None:
    if not step.arguments:
        return
    name = "".join(step.after("PACKAGE_DIR", ("VERSION", "SETUP_CFG", "DESTINATION"))[:1])
    source = package.path / step.folder / (name or step.arguments[0])
    if step.name == "ament_python_install_module" and is_file(source):
        plan.add(Item(f"{layout.python}/{source.name}", source), step.span)
    elif is_folder(source):
        target = f"{layout.python}/{PurePosixPath(step.arguments[0]).name}"
        add_python_folder(plan, source, target, layout)
    else:
        text = f"{step.name}() wants '{source}', and it does not exist; CMake stops there"
        plan.diagnostics.report("package.module", text, step.span)


def _add_resource(package: SourcePackage, step: Step, plan: Plan) -> None:
    if not step.arguments:
        return
    keywords = ("CONTENT", "CONTENT_FILE", "PACKAGE_NAME", "SKIP_INSTALL")
    name = "".join(step.after("PACKAGE_NAME", keywords)[:1]) or package.name
    text = "".join(step.after("CONTENT", keywords)[:1])
    file = "".join(step.after("CONTENT_FILE", keywords)[:1])
    if file and is_file(package.path / file):
        plan.add(Item(f"{_INDEX}/{step.arguments[0]}/{name}", package.path / file), step.span)
    else:
        plan.write(f"{_INDEX}/{step.arguments[0]}/{name}", text)
