"""What ``setup.py`` installs: modules, data files, executables, the distribution's metadata."""

from __future__ import annotations

import re
import sys
from pathlib import Path, PurePosixPath

from gazelle.diagnostics import Severity, SourceSpan
from gazelle.documents.files import is_file, is_folder, names_matching
from gazelle.workspace.building.packages import SourcePackage
from gazelle.workspace.building.plan import Item, Layout, Plan, add_rules
from gazelle.workspace.building.setup_py import (
    SetupFile,
    SetupRunError,
    read_setup,
    setup_arguments,
    with_arguments,
)
from gazelle.workspace.entry_points import console_scripts

__all__ = ["add_python_distribution", "add_python_folder", "completed", "plan_python"]

_TARGET = re.compile(r"\s*([^\W\d][\w.]*)\s*:\s*([^\W\d][\w.]*)\s*(?:\[.*\])?\s*")
_FAILURE = "error: can't copy '{path}': doesn't exist or not a regular file"
_WRAPPER = """#!{python}
# Starts {target}, as {name} of package {package}.
import sys

from {module} import {first}

if __name__ == "__main__":
    sys.exit({function}())
"""


def plan_python(package: SourcePackage, layout: Layout, plan: Plan) -> None:
    """Plan an ``ament_python`` package: what its ``setup()`` is called with."""
    setup = _setup_of(package, plan)
    if setup is None:
        return
    add_rules(plan, package.path, setup.rules, _FAILURE)
    add_python_distribution(package, setup, layout, plan)
    _add_executables(package, setup, plan)
    _add_markers(package, setup, plan)


def add_python_distribution(
    package: SourcePackage, setup: SetupFile, layout: Layout, plan: Plan
) -> None:
    """Plan the modules of a ``setup.py`` and the ``egg-info`` that names them."""
    for top, modules in sorted(_by_top(setup.modules or ()).items()):
        folder = _module_folder(package.path, top, setup.folders)
        if layout.symlinks and is_folder(folder):
            plan.add(Item(f"{layout.python}/{top}", folder), setup.span)
            continue
        for module in modules:
            _add_module(package, setup, module, layout, plan)
    for module in setup.py_modules:
        file = _module_folder(package.path, module, setup.folders).with_suffix(".py")
        if is_file(file):
            plan.add(Item(f"{layout.python}/{module.replace('.', '/')}.py", file), setup.span)
        else:
            _report_no_module(module, file, setup, plan)
    _add_egg_info(package, setup, layout, plan)


def add_python_folder(plan: Plan, folder: Path, target: str, layout: Layout) -> None:
    """Plan a folder of modules as a whole, as ``ament_python_install_package`` does."""
    if layout.symlinks:
        plan.add(Item(target, folder))
        return
    for file in sorted(folder.rglob("*")):
        if file.is_file() and "__pycache__" not in file.parts:
            plan.add(Item(f"{target}/{file.relative_to(folder).as_posix()}", file))


def _setup_of(package: SourcePackage, plan: Plan) -> SetupFile | None:
    setup = read_setup(package.path)
    report = plan.diagnostics.report
    manifest = SourceSpan(str(package.path / "package.xml"))
    if setup is None:
        text = f"package '{package.name}' is ament_python and has no setup.py"
        report("package.no-build-file", text, manifest, severity=Severity.ERROR)
        return None
    if setup.error is not None:
        span = SourceSpan(str(setup.file), setup.error.lineno or 0, setup.error.offset or 0)
        report("package.setup-syntax", f"setup.py is not Python 3: {setup.error.msg}", span)
        return None
    if setup.span is None:
        text = "setup() is called nowhere in setup.py: nothing is installed"
        report("package.no-build-file", text, manifest, severity=Severity.ERROR)
        return None
    return completed(package, setup, plan)


def completed(package: SourcePackage, setup: SetupFile, plan: Plan) -> SetupFile:
    """Return a ``setup.py`` with what reading it leaves open; it is run for that."""
    if setup.has_all_rules and setup.modules is not None:
        return setup
    try:
        return with_arguments(setup, setup_arguments(package.path))
    except SetupRunError as error:
        text = f"setup.py computes what it installs, and running it fails: {error}; that is left "
        text += "out"
        severity = Severity.WARNING
        plan.diagnostics.report("package.install-unread", text, setup.span, severity=severity)
        return setup


def _by_top(modules: tuple[str, ...]) -> dict[str, list[str]]:
    tops: dict[str, list[str]] = {}
    for module in modules:
        tops.setdefault(module.partition(".")[0], []).append(module)
    return tops


def _module_folder(root: Path, module: str, folders: dict[str, str]) -> Path:
    """Return a module's folder by ``package_dir``: the longest name in it decides."""
    parts = module.split(".")
    for count in range(len(parts), -1, -1):
        head = ".".join(parts[:count])
        if head in folders:
            return root.joinpath(folders[head], *parts[count:])
    return root.joinpath(*parts)


def _add_module(
    package: SourcePackage, setup: SetupFile, module: str, layout: Layout, plan: Plan
) -> None:
    folder = _module_folder(package.path, module, setup.folders)
    if not is_folder(folder):
        _report_no_module(module, folder, setup, plan)
        return
    base = f"{layout.python}/{module.replace('.', '/')}"
    for file in sorted(folder.glob("*.py")):
        plan.add(Item(f"{base}/{file.name}", file), setup.span)
    for pattern in (*setup.package_data.get(module, ()), *setup.package_data.get("", ())):
        for name in names_matching(pattern.lstrip("/"), folder):
            if (file := folder / name).is_file():
                plan.add(Item(f"{base}/{Path(name).as_posix()}", file), setup.span)


def _report_no_module(module: str, path: Path, setup: SetupFile, plan: Plan) -> None:
    text = f"module '{module}' is not there: '{path}' does not exist (error: package directory "
    text += "does not exist)"
    plan.diagnostics.report("package.module", text, setup.span)


def _add_egg_info(package: SourcePackage, setup: SetupFile, layout: Layout, plan: Plan) -> None:
    name = (setup.name or package.name).replace("-", "_")
    version = setup.version or package.manifest.version or "0.0.0"
    python = f"py{sys.version_info.major}.{sys.version_info.minor}"
    base = f"{layout.python}/{name}-{version}-{python}.egg-info"
    summary = f"Summary: {package.manifest.description}\n" if package.manifest.description else ""
    head = f"Metadata-Version: 2.1\nName: {setup.name or package.name}\nVersion: {version}\n"
    plan.write(f"{base}/PKG-INFO", head + summary)
    tops = sorted({module.partition(".")[0] for module in setup.modules or ()})
    plan.write(f"{base}/top_level.txt", "".join(f"{top}\n" for top in tops))
    plan.write(f"{base}/requires.txt", "".join(f"{item}\n" for item in setup.requires))
    groups = dict(setup.entry_points)
    scripts = console_scripts(package.path)
    if scripts:
        groups["console_scripts"] = tuple(f"{key} = {value}" for key, value in scripts.items())
    if any(groups.values()):
        blocks = ("\n".join([f"[{key}]", *lines]) for key, lines in groups.items() if lines)
        plan.write(f"{base}/entry_points.txt", "\n\n".join(blocks) + "\n")


def _add_executables(package: SourcePackage, setup: SetupFile, plan: Plan) -> None:
    folder = setup.scripts_folder.removeprefix("$base").strip("/") or "bin"
    if not setup.scripts_folder and console_scripts(package.path):
        text = "no setup.cfg says where executables go: they go to bin, where 'ros2 run' does not "
        text += f"look (No executable found); write install_scripts=$base/lib/{package.name}"
        plan.diagnostics.report("package.scripts-folder", text, setup.span)
    for name, target in console_scripts(package.path).items():
        found = _TARGET.fullmatch(target)
        if found is None or "/" in name:
            text = f"'{name} = {target}' is not 'name = package.module:function'; no executable is "
            text += "made of it"
            plan.diagnostics.report("package.entry-point", text, setup.span)
            continue
        module, function = found[1], found[2]
        text = _WRAPPER.format(
            python=sys.executable, target=target, name=name, package=package.name,
            module=module, function=function, first=function.partition(".")[0],
        )  # fmt: skip
        plan.write(f"{folder}/{name}", text, is_program=True)
    for script in setup.scripts:
        file = package.path / script
        if is_file(file):
            plan.add(Item(f"{folder}/{PurePosixPath(script).name}", file, "", True), setup.span)
        else:
            text = f"'{script}' is to be installed and does not exist"
            text += f" ({_FAILURE.format(path=file)})"
            plan.diagnostics.report("package.install-missing", text, setup.span)


def _add_markers(package: SourcePackage, setup: SetupFile, plan: Plan) -> None:
    """Add what colcon adds when ``data_files`` forget it, and say so as colcon does."""
    marker = f"share/ament_index/resource_index/packages/{package.name}"
    manifest = f"share/{package.name}/package.xml"
    for target, what in ((marker, "a marker in the package index"), (manifest, "'package.xml'")):
        if target not in plan.items:
            text = f"Package '{package.name}' doesn't explicitly install {what}; it is installed "
            text += "all the same, as colcon does at present"
            fix = f"add to data_files: ('{PurePosixPath(target).parent}', [...])"
            plan.diagnostics.report(
                "package.index-marker", text, setup.span, fix=fix, severity=Severity.WARNING
            )
    if marker not in plan.items:
        plan.write(marker)
    if manifest not in plan.items:
        plan.add(Item(manifest, package.path / "package.xml"))
