"""Sources of launch descriptions that are files: Python is run, markup is parsed."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Callable
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType
from typing import Any

from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.documents.files import exists, is_file, is_folder
from gazelle.launch.environment import drop_in_folder
from gazelle.launch.ros2.frontend import Parser
from gazelle.launch.ros2.frontend.xml import Parser as XmlParser
from gazelle.launch.ros2.frontend.yaml import Parser as YamlParser
from gazelle.launch.ros2.invalid_launch_file_error import InvalidLaunchFileError
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_description_source import LaunchDescriptionSource
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.user_spans import keep_span

__all__ = [
    "AnyLaunchDescriptionSource",
    "FrontendLaunchDescriptionSource",
    "InvalidPythonLaunchFileError",
    "PythonLaunchDescriptionSource",
    "XMLLaunchDescriptionSource",
    "YAMLLaunchDescriptionSource",
    "get_launch_description_from_any_launch_file",
    "get_launch_description_from_frontend_launch_file",
    "get_launch_description_from_python_launch_file",
    "load_python_launch_file_as_module",
]

_FUNCTION = "generate_launch_description"


class InvalidPythonLaunchFileError(Exception):
    """A file in Python is no launch file."""


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in Python, XML or YAML."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_any_launch_file(location)


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in Python."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted python launch file")

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_python_launch_file(location)


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in markup."""

    def __init__(
        self,
        launch_file_path: SomeSubstitutionsType,
        *,
        method: str = "interpreted frontend launch file",
        parser: type[Parser] = Parser,
    ) -> None:
        super().__init__(None, launch_file_path, method)
        self._parser = parser

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_frontend_launch_file(location, parser=self._parser)


class XMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    """A launch file in XML."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(launch_file_path, method="interpreted XML launch file", parser=XmlParser)


class YAMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    """A launch file in YAML."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(launch_file_path, method="interpreted YAML launch file", parser=YamlParser)


def load_python_launch_file_as_module(python_launch_file_path: str) -> ModuleType:
    """Return the module that a launch file is; its code runs.

    `launch`, `launch_ros` and their kin are Gazelle's, unless others are on the path already.

    Raises:
        FileNotFoundError: there is no such file.
    """
    path = os.fspath(python_launch_file_path)
    _check_exists(path)
    folder = str(drop_in_folder())
    if folder not in sys.path:
        sys.path.append(folder)
    loader = SourceFileLoader("python_launch_file", path)
    spec = importlib.util.spec_from_loader(loader.name, loader)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    without_bytecode, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        loader.exec_module(module)
    finally:
        sys.dont_write_bytecode = without_bytecode
    return module


def get_launch_description_from_python_launch_file(
    python_launch_file_path: str,
) -> LaunchDescription:
    """Return what a file's ``generate_launch_description()`` returns.

    Raises:
        InvalidPythonLaunchFileError: it has no such function, or that returns something else.
    """
    path = os.fspath(python_launch_file_path)
    module = load_python_launch_file_as_module(path)
    function = getattr(module, _FUNCTION, None)
    if function is None:
        hint = did_you_mean(_FUNCTION, _functions(module))
        message = f"launch file at '{path}' does not contain the required function '{_FUNCTION}()'"
        raise _invalid(f"{message}; {hint}" if hint else message, SourceSpan(path))
    code = getattr(function, "__code__", None)
    span = SourceSpan(path, code.co_firstlineno if code is not None else 0)
    try:
        description: Any = function()
    except TypeError as error:
        # That of a call without arguments is raised here, not in the user's file.
        keep_span(error, span)
        raise
    if not isinstance(description, LaunchDescription):
        kind = type(description).__name__
        hint = " (is a return missing?)" if description is None else ""
        raise _invalid(
            f"'{_FUNCTION}()' of '{path}' returned a {kind}, not a LaunchDescription{hint}", span
        )
    return description


def get_launch_description_from_frontend_launch_file(
    frontend_launch_file_path: str, *, parser: type[Parser] = Parser
) -> LaunchDescription:
    """Return the description of a launch file in markup."""
    _check_exists(frontend_launch_file_path)
    root, instance = parser.load(frontend_launch_file_path)
    return instance.parse_description(root)


def get_launch_description_from_any_launch_file(
    launch_file_path: str, *, parser: type[Parser] = Parser
) -> LaunchDescription:
    """Return the description of a launch file; its extension says which reader goes first.

    Raises:
        InvalidLaunchFileError: no reader can make sense of it.
        FileNotFoundError: there is no such file.
    """
    path = os.fspath(launch_file_path)
    _check_exists(path)
    python = get_launch_description_from_python_launch_file
    markup: Callable[..., Any] = get_launch_description_from_frontend_launch_file
    extension = Path(path).suffix[1:]
    loaders = [python, markup] if extension == "py" else [markup, python]
    if extension != "py" and parser.is_filename_valid(Path(path).name):
        loaders = [markup]
    elif extension != "py":
        extension = ""
    errors: list[Exception] = []
    for loader in loaders:
        try:
            found: LaunchDescription = loader(path)
        except Exception as error:  # noqa: BLE001 - told together when no reader succeeds
            errors.append(error)
        else:
            return found
    raise InvalidLaunchFileError(extension, likely_errors=errors)


def _functions(module: ModuleType) -> list[str]:
    """Return the names of functions that a launch file defines itself."""
    own = {name: getattr(one, "__module__", "") for name, one in vars(module).items()}
    return sorted(name for name, where in own.items() if where == module.__name__)


def _check_exists(path: str) -> None:
    file = Path(path)
    if is_file(file):
        return
    hint = ""
    if is_folder(file.parent):
        hint = did_you_mean(file.name, sorted(one.name for one in file.parent.iterdir()))
    elif not file.is_absolute() or not exists(file.parent):
        existing = next((one for one in file.parents if is_folder(one)), None)
        hint = f"'{file.parent}' is no folder" + (f", '{existing}' is" if existing else "")
    message = f"[Errno 2] No such file or directory: '{path}'"
    raise FileNotFoundError(f"{message}; {hint}" if hint else message)


def _invalid(message: str, span: SourceSpan) -> InvalidPythonLaunchFileError:
    error = InvalidPythonLaunchFileError(message)
    keep_span(error, span)
    return error
