"""Python in packages: modules, entry points, scripts."""

from __future__ import annotations

import ast
import os
from pathlib import Path, PurePosixPath

from gazelle.diagnostics import Diagnostics, Severity, SourceSpan, did_you_mean, nearest_names
from gazelle.doctor.packages.source import SourcePackage
from gazelle.documents.files import is_file, is_folder
from gazelle.workspace.entry_points import console_scripts
from gazelle.workspace.static_python import parse_python

__all__ = ["check_python"]

_SCRIPT_FOLDERS = ("bin", "nodes", "script", "scripts")
_MARKER_PLACE = "share/ament_index/resource_index/packages"


def check_python(source: SourcePackage, diagnostics: Diagnostics) -> None:
    """Report what keeps a package's Python from being found or started."""
    if source.build_type == "ament_python":
        _check_marker(source, diagnostics)
        _check_modules(source, diagnostics)
        _check_scripts_folder(source, diagnostics)
        for name, target in console_scripts(source.folder).items():
            _check_entry_point(source, name, target, diagnostics)
    elif source.rules is not None:
        _check_scripts(source, diagnostics)


def _check_marker(source: SourcePackage, diagnostics: Diagnostics) -> None:
    setup, rules, name = source.setup, source.rules, source.package.name
    if setup is None or rules is None or not setup.has_all_rules:
        return
    words = f"Package '{name}' not found: ros2 run and ros2 launch look it up in the index"
    placed = [rule for rule in rules.rules if rule.destination == _MARKER_PLACE]
    if not any(PurePosixPath(rule.source).name == name for rule in placed):
        other = next(iter(placed), None)
        text = f"data_files put no '{name}' into {_MARKER_PLACE} ({words})"
        hint = f"('{_MARKER_PLACE}', ['resource/{name}']), and an empty file resource/{name}"
        span = other.span if other is not None else setup.span
        diagnostics.report("package.index-marker", text, span, fix=hint)
    if not any(rule.source == "package.xml" for rule in rules.rules):
        text = "data_files do not install package.xml; the package has no dependencies then"
        fix = f"('share/{name}', ['package.xml']),"
        diagnostics.report("package.index-marker", text, setup.span, fix=fix)


def _check_modules(source: SourcePackage, diagnostics: Diagnostics) -> None:
    setup = source.setup
    if setup is None or setup.modules is None:
        return
    base = setup.folders.get("", "")
    for name in setup.modules:
        folder = source.folder / setup.folders.get(name, f"{base}/{name.replace('.', '/')}").strip(
            "/"
        )
        if not is_folder(folder):
            text = f"packages names '{name}', and there is no folder '{folder.name}' (error: "
            text += f"package directory '{folder.name}' does not exist)"
            names = [item.name for item in source.folder.iterdir() if item.is_dir()]
            hint = did_you_mean(name, names)
            diagnostics.report("package.module", text, setup.span, fix=hint)
            continue
        for file in sorted(folder.rglob("__init__.py")):
            inner = file.parent.relative_to(folder).as_posix().replace("/", ".")
            full = name if inner == "." else f"{name}.{inner}"
            if full not in setup.modules:
                text = f"'{full}' is not among the packages of setup.py and is not installed "
                text += f"(ModuleNotFoundError: No module named '{full}')"
                fix = f"packages=[…, '{full}'], or find_packages(exclude=['test'])"
                diagnostics.report("package.module", text, setup.span, fix=fix)


def _check_scripts_folder(source: SourcePackage, diagnostics: Diagnostics) -> None:
    setup, name = source.setup, source.package.name
    if setup is None or not console_scripts(source.folder):
        return
    wanted = f"$base/lib/{name}"
    if setup.scripts_folder.rstrip("/") == wanted:
        return
    text = f"setup.cfg puts executables into '{setup.scripts_folder}'"
    if not setup.scripts_folder:
        text = "setup.cfg does not say where executables go; they would go to bin"
    text += f", ros2 run looks into lib/{name} (No executable found)"
    file = "setup.cfg" if (source.folder / "setup.cfg").is_file() else "setup.py"
    fix = f"setup.cfg: [develop] script_dir={wanted} [install] install_scripts={wanted}"
    diagnostics.report("package.scripts-folder", text, source.span(file), fix=fix)


def _check_entry_point(
    source: SourcePackage, name: str, target: str, diagnostics: Diagnostics
) -> None:
    module, _, function = (part.strip() for part in target.partition(":"))
    own = module.partition(".")[0]
    span = _span_of(source, target) or _span_of(source, name)
    if not _is_own(source, own):
        return
    file = _module_file(source, module)
    if file is None:
        text = f"'{name}' starts '{target}', and there is no module '{module}' "
        text += f"(ModuleNotFoundError: No module named '{module}')"
        hint = did_you_mean(module, _modules_below(source, own))
        diagnostics.report("package.entry-point", text, span, fix=hint)
        return
    names = _names_in(file)
    if names is None or (function and function.partition(".")[0] in names):
        return
    shown = os.path.relpath(file, source.folder)
    text = f"'{name}' starts '{target}', and {shown} has no '{function}' (AttributeError: module "
    text += f"'{module}' has no attribute '{function}')"
    if not function:
        text = f"'{name}' names the module '{module}' and no function in it"
    hint = did_you_mean(function, names) or f"write def {function or 'main'}(args=None): …"
    diagnostics.report("package.entry-point", text, span, fix=hint)


def _is_own(source: SourcePackage, module: str) -> bool:
    """Tell a module of the package from one of another distribution, which may be started too."""
    folders = {PurePosixPath(name.removeprefix("src/")).parts[0] for name in source.files}
    return module == source.package.name or bool(nearest_names(module, folders))


def _span_of(source: SourcePackage, text: str) -> SourceSpan | None:
    for file in ("setup.py", "setup.cfg", "pyproject.toml"):
        for number, line in enumerate(source.text(file).splitlines(), 1):
            column = line.find(text)
            if column >= 0:
                return source.span(file, number, column + 1, len(text))
    return None


def _module_file(source: SourcePackage, module: str) -> Path | None:
    inside = module.replace(".", "/")
    for base in (source.folder, source.folder / "src"):
        for name in (f"{inside}.py", f"{inside}/__init__.py"):
            if is_file(base / name):
                return base / name
    return None


def _modules_below(source: SourcePackage, own: str) -> list[str]:
    files = [name for name in source.files if name.startswith((f"{own}/", f"src/{own}/"))]
    plain = (
        name.removeprefix("src/").removesuffix(".py") for name in files if name.endswith(".py")
    )
    return [name.removesuffix("/__init__").replace("/", ".") for name in plain]


def _names_in(file: Path) -> set[str] | None:
    """Return the names a module has at its top level; None when that cannot be told."""
    try:
        tree = parse_python(file.read_text(encoding="utf-8", errors="replace"))
    except (SyntaxError, OSError):
        return None
    names: set[str] = set()
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef() | ast.ClassDef() | ast.AsyncFunctionDef():
                names.add(node.name)
            case ast.Name(ctx=ast.Store()):
                names.add(node.id)
            case ast.ImportFrom() | ast.Import():
                if any(alias.name == "*" for alias in node.names):
                    return None
                names |= {(alias.asname or alias.name).partition(".")[0] for alias in node.names}
    return names


def _check_scripts(source: SourcePackage, diagnostics: Diagnostics) -> None:
    rules = source.rules
    assert rules is not None
    for name in source.files:
        if PurePosixPath(name).parts[0] not in _SCRIPT_FOLDERS or not _is_script(source, name):
            continue
        installing = [rule for rule in rules.rules if rule.target(name) is not None]
        made_executable = any(rule.is_program and not rule.is_folder for rule in installing)
        has_bit = os.access(source.folder / name, os.X_OK)
        if installing and not has_bit and not made_executable:
            _report_bit(source, name, installing[0].span, diagnostics)
        elif not installing and not source.is_ros2 and not has_bit:
            _report_bit(source, name, source.span(name, 1), diagnostics)
        if not installing and not rules.unread and not rules.may_install(name) and rules.rules:
            _report_not_installed(source, name, diagnostics)


def _is_script(source: SourcePackage, name: str) -> bool:
    if PurePosixPath(name).suffix not in {".py", ""}:
        return False
    return source.text(name).startswith("#!")


def _report_bit(
    source: SourcePackage, name: str, span: SourceSpan, diagnostics: Diagnostics
) -> None:
    run = "ros2 run" if source.is_ros2 else "rosrun"
    text = f"script '{name}' lacks the executable bit; {run} of a real ROS would not find it "
    text += "(Couldn't find executable)"
    fix = f"chmod +x {name}"
    if source.is_ros2:
        fix += f", or install(PROGRAMS {name} DESTINATION lib/${{PROJECT_NAME}})"
    diagnostics.report("package.script-not-executable", text, span, fix=fix)


def _report_not_installed(source: SourcePackage, name: str, diagnostics: Diagnostics) -> None:
    text = f"script '{name}' is not installed; "
    text += (
        "ros2 run says No executable found" if source.is_ros2 else "an installed package lacks it"
    )
    fix = f"catkin_install_python(PROGRAMS {name} DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}})"
    if source.is_ros2:
        fix = f"install(PROGRAMS {name} DESTINATION lib/${{PROJECT_NAME}})"
    severity = Severity.WARNING if source.is_ros2 else Severity.INFO
    span = source.span("CMakeLists.txt")
    diagnostics.report("package.script-not-installed", text, span, fix=fix, severity=severity)
