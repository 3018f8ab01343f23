"""What would be missing after installing a package."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path, PurePosixPath

from gazelle.diagnostics import Diagnostics, Severity, SourceSpan, did_you_mean, nearest_names
from gazelle.doctor.packages.source import SourcePackage
from gazelle.documents.files import exists, is_folder
from gazelle.workspace.building.cmake_lists import Step
from gazelle.workspace.building.install_rules import InstallRule

__all__ = ["check_install", "is_needed"]

_NEEDED = frozenset(
    {
        ".dae", ".glb", ".gltf", ".launch", ".material", ".obj", ".pgm", ".rviz", ".sdf", ".srdf",
        ".stl", ".urdf", ".world", ".xacro",
    }
)  # fmt: skip
_PARAMETERS = frozenset({".yaml", ".yml"})
_PARAMETER_FOLDERS = ("cfg", "conf", "config", "map", "maps", "param", "params", "yaml")
_LAUNCH_ENDINGS = (".launch.py", ".launch.xml", ".launch.yaml", ".launch.yml", "_launch.py")
_ELSEWHERE = frozenset({"doc", "docs", "example", "examples", "test", "tests", "tools", ".github"})
_SHOWN = 4


def is_needed(relative: str) -> bool:
    """Tell whether a file is one that nodes and launches look for in the share folder."""
    path = PurePosixPath(relative)
    if len(path.parts) < 2 or _ELSEWHERE & set(path.parts[:-1]):
        return False
    if path.suffix.lower() in _NEEDED or path.name.endswith(_LAUNCH_ENDINGS):
        return True
    if path.name == "model.config":
        return True
    folders = {part.lower() for part in path.parts[:-1]}
    return path.suffix in _PARAMETERS and bool(folders & set(_PARAMETER_FOLDERS))


def check_install(source: SourcePackage, diagnostics: Diagnostics) -> None:
    """Report files that an installed package would lack, and rules that name nothing."""
    if source.lists is not None and source.lists.problem is not None:
        problem, span = source.lists.problem
        text = f"CMake stops here: {problem.text}"
        diagnostics.report("package.cmake-syntax", text, span)
    if source.setup is not None and source.setup.error is not None:
        error = source.setup.error
        span = source.span("setup.py", error.lineno or 0, error.offset or 0)
        diagnostics.report("package.setup-syntax", f"setup.py is not Python 3: {error.msg}", span)
    rules = source.rules
    if rules is None:
        return
    for rule in rules.rules:
        _check_source(source, rule, diagnostics)
        _check_place(source, rule, diagnostics)
    _check_globs(source, diagnostics)
    missing = [name for name in source.files if is_needed(name) and not _is_installed(source, name)]
    if missing and rules.unread:
        text = f"whether {_listed(missing)} is installed cannot be told: this is known only when "
        text += "the package is built"
        diagnostics.report("package.install-unread", text, rules.unread[0])
    elif missing and not rules.rules and not source.is_ros2:
        _report_no_rules(source, missing, diagnostics)
    elif missing:
        _report_missing(source, missing, diagnostics)


def _is_installed(source: SourcePackage, relative: str) -> bool:
    rules = source.rules
    assert rules is not None
    return bool(rules.targets(relative)) or rules.may_install(relative)


def _report_no_rules(source: SourcePackage, missing: Sequence[str], d: Diagnostics) -> None:
    text = "CMakeLists.txt has no install rules: the package works from its workspace (devel), "
    text += f"an installed one would lack {_listed(_tops(missing))}"
    fix = f"install(DIRECTORY {' '.join(_tops(missing))} "
    fix += "DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})"
    span = source.span("CMakeLists.txt")
    d.report("package.not-installed", text, span, fix=fix, severity=Severity.INFO)


def _report_missing(source: SourcePackage, missing: Sequence[str], d: Diagnostics) -> None:
    severity = Severity.WARNING if source.is_ros2 else Severity.INFO
    for folder in dict.fromkeys(str(PurePosixPath(name).parent) for name in missing):
        names = [name for name in missing if str(PurePosixPath(name).parent) == folder]
        example = PurePosixPath(names[0]).name
        text = f"{_listed([PurePosixPath(name).name for name in names])} of folder '{folder}' "
        text += "is not installed" if len(names) == 1 else "are not installed"
        text += f"; found here in the source folder, {_ros_text(source, folder, example)}"
        span, fix = _rule_to_write(source, folder, names)
        d.report("package.not-installed", text, span, fix=fix, severity=severity)


def _ros_text(source: SourcePackage, folder: str, example: str) -> str:
    name = source.package.name
    if source.is_ros2 and example.endswith(_LAUNCH_ENDINGS):
        words = f"file '{example}' was not found in the share directory of package '{name}'"
        return f"ros2 launch says: {words}"
    if example.endswith(".launch"):
        return f"roslaunch says: [{example}] is neither a launch file in package [{name}] nor"
    return f"an installed one has no share/{name}/{folder}/{example}"


def _rule_to_write(
    source: SourcePackage, folder: str, names: Sequence[str]
) -> tuple[SourceSpan, str]:
    top = PurePosixPath(folder).parts[0]
    if source.build_type == "ament_python":
        setup = source.setup
        span = (setup.data_files_span or setup.span) if setup is not None else None
        endings = sorted({_ending(name) for name in names})
        pattern = f"{folder}/*{endings[0]}" if len(endings) == 1 else f"{folder}/*.*"
        row = f"(os.path.join('share', package_name, '{folder}'), glob('{pattern}')),"
        return span or source.span("setup.py"), f"add to data_files: {row}"
    rules = source.rules.rules if source.rules is not None else ()
    near = next((rule for rule in rules if rule.is_folder and rule.source != "."), None)
    of_folder = next((rule for rule in rules if rule.source.startswith(top)), near)
    calls = source.lists.called("install") if source.lists is not None else ()
    span = of_folder.span if of_folder is not None else _place_of(source, calls)
    place = "share/${PROJECT_NAME}" if source.is_ros2 else "${CATKIN_PACKAGE_SHARE_DESTINATION}"
    return span, f"install(DIRECTORY {top} DESTINATION {place})"


def _place_of(source: SourcePackage, calls: Sequence[Step]) -> SourceSpan:
    return calls[-1].span if calls else source.span("CMakeLists.txt")


def _check_source(source: SourcePackage, rule: InstallRule, diagnostics: Diagnostics) -> None:
    path = source.folder / rule.source
    if (
        not rule.is_known
        or rule.is_optional
        or "$<" in rule.source
        or Path(rule.source).is_absolute()
    ):
        return
    severity = Severity.ERROR if source.is_ros2 else Severity.WARNING
    if not exists(path):
        text = f"'{rule.source}' is to be installed and does not exist"
        text += f" ({_failure(source, rule)})"
        hint = did_you_mean(rule.source, _siblings(path, rule.is_folder))
        code = "package.install-missing"
        diagnostics.report(code, text, rule.span, fix=hint, severity=severity)
    elif is_folder(path) and not rule.is_folder:
        text = f"'{rule.source}' is a folder, and only files can stand here"
        text += f" ({_failure(source, rule)})"
        fix = f"name the files: glob('{rule.source}/*.*')"
        if source.build_file.name == "CMakeLists.txt":
            fix = f"install(DIRECTORY {rule.source} …)"
        code = "package.install-missing"
        diagnostics.report(code, text, rule.span, fix=fix, severity=severity)


def _failure(source: SourcePackage, rule: InstallRule) -> str:
    if source.build_file.name == "setup.py":
        return f"error: can't copy '{rule.source}': doesn't exist or not a regular file"
    return f'CMake Error: file INSTALL cannot find "{source.folder / rule.source}"'


def _siblings(path: Path, folders: bool) -> list[str]:
    base = path.parent
    if not is_folder(base):
        return []
    names = [item for item in sorted(base.iterdir()) if item.is_dir() == folders]
    return [item.name for item in names if not item.name.startswith(".")]


def _check_place(source: SourcePackage, rule: InstallRule, diagnostics: Diagnostics) -> None:
    """Report a folder inside one of its own name, and the share folder of another package."""
    if not rule.is_known or not rule.destination.startswith("share/"):
        return
    parts = PurePosixPath(rule.destination).parts
    name = PurePosixPath(rule.source).name
    if rule.keeps_name and len(parts) > 2 and parts[-1] == name:
        text = f"folder '{rule.source}' goes to {rule.destination}/{name}: without a slash at its "
        text += "end a folder goes there itself, not only what is in it"
        fix = f"write {rule.source}/ or DESTINATION {'/'.join(parts[:-1])}"
        diagnostics.report("package.install-place", text, rule.span, fix=fix)
    own = source.package.name
    if len(parts) > 1 and parts[1] != own and nearest_names(parts[1], [own]):
        text = f"'{rule.source}' goes to the share folder of '{parts[1]}', the package is '{own}'"
        diagnostics.report("package.install-place", text, rule.span, fix=f"write share/{own}")


def _check_globs(source: SourcePackage, diagnostics: Diagnostics) -> None:
    setup = source.setup
    if setup is None or source.build_type != "ament_python":
        return
    for item in setup.empty_globs:
        folder = item.pattern.partition("*")[0].rstrip("/")
        path = source.folder / folder
        text = f"glob('{item.pattern}') finds no file, and nothing says so when building"
        hint = ""
        if folder and not is_folder(path):
            text = f"glob('{item.pattern}') finds no file: there is no folder '{folder}'"
            hint = did_you_mean(path.name, _siblings(path, True))
        elif is_folder(path) and any(path.iterdir()):
            names = sorted(entry.name for entry in path.iterdir())
            hint = f"the folder has {_listed(names)}"
        diagnostics.report("package.empty-glob", text, item.span, fix=hint)


def _ending(name: str) -> str:
    found = next((item for item in _LAUNCH_ENDINGS if name.endswith(item)), "")
    return found or PurePosixPath(name).suffix


def _tops(names: Sequence[str]) -> list[str]:
    return list(dict.fromkeys(PurePosixPath(name).parts[0] for name in names))


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(f"'{name}'" for name in names[:_SHOWN])
    return f"{shown} and {len(names) - _SHOWN} more" if len(names) > _SHOWN else shown
