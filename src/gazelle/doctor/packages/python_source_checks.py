"""Python programs of packages, read and not run: syntax, and the messages they import."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import NamedTuple

from gazelle.compat.python2 import translated
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, nearest_names
from gazelle.doctor.packages.dependency_checks import is_slip, known_packages
from gazelle.doctor.packages.python_name_checks import check_names
from gazelle.doctor.packages.source import SourcePackage
from gazelle.interfaces import exists, known_types
from gazelle.workspace import Package, Workspace
from gazelle.workspace.static_python import parse_python, syntax_problem

__all__ = ["check_python_sources"]

_PARTS = frozenset({"action", "msg", "srv"})
# What the generators of ROS 1 and ROS 2 make beside the type itself.
_OF_ACTION = ("Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult",
              "ActionFeedback")  # fmt: skip
_OF_SERVICE = ("Request", "Response")


class _Import(NamedTuple):
    package: str
    part: str
    name: str
    span: SourceSpan


def check_python_sources(
    source: SourcePackage, workspace: Workspace, diagnostics: Diagnostics
) -> None:
    """Report programs that are no Python, and imports of messages that nobody has."""
    for file in source.files:
        if source.is_test(file) or not _is_python(source, file):
            continue
        tree = _tree(source, file, diagnostics)
        if tree is not None:
            check_names(tree, str(source.folder / file), diagnostics)
            for found in _imports(tree, source, file):
                _check_import(found, workspace, diagnostics)


def _is_python(source: SourcePackage, file: str) -> bool:
    if file.endswith(".py"):
        # What launches is read as such, and setup.py by its rules.
        return not file.endswith("launch.py") and file != "setup.py"
    first = source.text(file).partition("\n")[0] if "." not in file else ""
    return first.startswith("#!") and "python" in first


def _tree(source: SourcePackage, file: str, diagnostics: Diagnostics) -> ast.Module | None:
    text = source.text(file)
    try:
        return parse_python(text)
    except SyntaxError as error:
        problem = syntax_problem(text, error)
    try:
        return parse_python(translated(text))
    except (SyntaxError, RecursionError):
        span = source.span(file, problem.line, problem.column)
        message = f"'{file}' is not Python: {problem.message}"
        diagnostics.report("package.python-syntax", message, span, fix=problem.fix)
    return None


def _imports(tree: ast.Module, source: SourcePackage, file: str) -> Iterator[_Import]:
    for node in ast.walk(tree):
        if not isinstance(node, ast.ImportFrom) or node.level or node.module is None:
            continue
        package, _, part = node.module.partition(".")
        if part not in _PARTS:
            continue
        yield _Import(package, part, "", source.span(file, node.lineno, node.col_offset + 1))
        for alias in node.names:
            if alias.name != "*" and not alias.name.startswith("_"):
                span = source.span(file, alias.lineno, alias.col_offset + 1, len(alias.name))
                yield _Import(package, part, alias.name, span)


def _check_import(found: _Import, workspace: Workspace, diagnostics: Diagnostics) -> None:
    package = workspace.packages.get(found.package)
    is_own = package is not None and not package.is_builtin
    if not is_own and not known_types(found.part, found.package):
        _check_package(found, workspace, diagnostics)
    elif found.name and package is not None and is_own:
        _report_missing(found, _names_of(package, found.part), diagnostics)
    elif found.name and not exists(f"{found.package}/{found.part}/{found.name}"):
        types = known_types(found.part, found.package)
        _report_missing(found, [one.rpartition("/")[2] for one in types], diagnostics)


def _check_package(found: _Import, workspace: Workspace, diagnostics: Diagnostics) -> None:
    if found.name or found.package in known_packages() or found.package in workspace.packages:
        return
    near = nearest_names(found.package, [*workspace.packages, *known_packages()], count=1)
    if near and is_slip(found.package, near[0]):
        text = f"there is no package '{found.package}' (ModuleNotFoundError: No module named "
        text += f"'{found.package}')"
        hint = did_you_mean(found.package, near)
        diagnostics.report("package.import-missing", text, found.span, fix=hint)


def _report_missing(found: _Import, names: list[str], diagnostics: Diagnostics) -> None:
    near = nearest_names(found.name, names, count=1)
    # A type that we do not know may be one of another version.
    if found.name not in names and near and is_slip(found.name, near[0]):
        hint = did_you_mean(found.name, near)
        text = f"package '{found.package}' has no {found.part} '{found.name}' (ImportError: cannot "
        text += f"import name '{found.name}' from '{found.package}.{found.part}')"
        diagnostics.report("package.import-missing", text, found.span, fix=hint)


def _names_of(package: Package, part: str) -> list[str]:
    """Return what a package of the workspace has, and what generators make of it."""
    stems = {kind: [path.stem for path in package.path.rglob(f"*.{kind}")] for kind in _PARTS}
    names = list(stems[part])
    if part == "msg":
        names += [f"{stem}{end}" for stem in stems["action"] for end in _OF_ACTION]
    if part == "srv":
        names += [f"{stem}{end}" for stem in stems["srv"] for end in _OF_SERVICE]
    return names
