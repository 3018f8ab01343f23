"""Finds the Python class that a controller's type name means, in the packages of a workspace."""

from __future__ import annotations

import ast
import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from gazelle.control.controllers.controller import Controller
from gazelle.control.errors import ControllerError
from gazelle.control.python_controllers.adapter import adapted, located
from gazelle.extensions import ExtensionGroup, entry_point_text, find_entry_point, folder_of
from gazelle.workspace.python_files import import_python_file

if TYPE_CHECKING:
    from gazelle.workspace import Package, Workspace

__all__ = ["find_installed_controller", "find_python_controller"]

_SKIPPED = frozenset({"build", "devel", "install", "log", "node_modules", "__pycache__"})
_METHODS = frozenset({"init", "starting", "update", "stopping"})
_MAX_BYTES = 1_000_000


class _Found(NamedTuple):
    package: Package
    path: Path
    line: int


def find_python_controller(type_name: str, workspace: Workspace) -> type[Controller] | None:
    """Return a controller class made from a user's class, None when no file has one.

    ``my_pkg/MyController`` and ``my_pkg::MyController`` are looked for in ``my_pkg`` first, then,
    as a bare name is, in every package. Only the file with the class is imported.

    Raises:
        ControllerError: several files have such a class, or its file cannot be imported.
    """
    prefix, _, name = type_name.replace("::", "/").rpartition("/")
    if not name.isidentifier():
        return None
    package = workspace.packages.get(prefix.partition("/")[0])
    places = [] if package is None else list(_places(package, name))
    if not places:
        places = [place for one in workspace.user_packages for place in _places(one, name)]
    if not places:
        return None
    if len(places) > 1:
        listed = ", ".join(f"{place.path}:{place.line}" for place in places)
        raise ControllerError(
            f"controller type '{type_name}': several files have a class '{name}': {listed}; "
            f"write the type as package/{name}, and keep one class of that name in the package"
        )
    return _class_in(places[0], name, type_name)


def find_installed_controller(type_name: str) -> type[Controller] | None:
    """Return the controller that an installed pip package has for a type, None when none has.

    It is named by an entry point of group ``gazelle.controllers``, whose name is the type, and is
    a class like those of a workspace, or one derived from `Controller`.

    Raises:
        ControllerError: it cannot be imported, or is no class.
    """
    point = find_entry_point(ExtensionGroup.CONTROLLERS, type_name.replace("::", "/"))
    if point is None:
        return None
    folder = folder_of(point)
    try:
        found = point.load()
    except Exception as error:
        raise ControllerError(
            f"{entry_point_text(point)} cannot be loaded: {located(error, folder)}"
        ) from error
    if not isinstance(found, type):
        raise ControllerError(f"{entry_point_text(point)} is a {type(found).__name__}, not a class")
    return found if issubclass(found, Controller) else adapted(found, type_name, folder)


def _places(package: Package, name: str) -> Iterator[_Found]:
    for path in _python_files(package.path):
        line = _line_of_class(path, name)
        if line:
            yield _Found(package, path, line)


def _python_files(folder: Path) -> Iterator[Path]:
    for root, folders, files in os.walk(folder):
        folders[:] = sorted(one for one in folders if one not in _SKIPPED and one[0] != ".")
        yield from (Path(root) / file for file in sorted(files) if file.endswith(".py"))


def _line_of_class(path: Path, name: str) -> int:
    """Return the line of a controller class of this name at the top of a file, 0 for none."""
    try:
        if path.stat().st_size > _MAX_BYTES:
            return 0
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        # What cannot be read cannot be the class that somebody wrote for this.
        return 0
    if f"class {name}" not in text:
        return 0
    try:
        tree = ast.parse(text, str(path))
    except SyntaxError as error:
        raise ControllerError(
            f"{path}:{error.lineno or 1}: the file may have controller class '{name}', but is not "
            f"Python 3: {error.msg}"
        ) from error
    classes = (one for one in tree.body if isinstance(one, ast.ClassDef) and one.name == name)
    return next((one.lineno for one in classes if _is_controller(one)), 0)


def _is_controller(found: ast.ClassDef) -> bool:
    methods = {one.name for one in found.body if isinstance(one, ast.FunctionDef)}
    return bool(found.bases) or bool(methods & _METHODS)


def _class_in(place: _Found, name: str, type_name: str) -> type[Controller]:
    package = place.package.path
    module_name = f"gazelle_user_controllers.{package.name}.{place.path.stem}"
    try:
        module = import_python_file(place.path, module_name, folders=(package / "src",))
    except Exception as error:
        text = f"cannot import the controller's file: {located(error, package)}"
        raise ControllerError(text) from error
    return adapted(getattr(module, name), type_name, place.package.path)
