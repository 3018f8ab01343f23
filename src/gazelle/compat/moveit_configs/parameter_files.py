"""Files that become parameters: text, YAML, xacro."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gazelle.compat.moveit_configs.template import rendered
from gazelle.description.source_maps import remember
from gazelle.description.xacro import expand_xacro
from gazelle.description.xacro.library_run import run_session
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.documents import read_text_limited
from gazelle.documents.yaml import YamlError, problem_of, read_yaml
from gazelle.errors import UserFileError
from gazelle.workspace.ament_index import get_package_share_directory, known_workspace

__all__ = [
    "ParameterBuilderFileNotFoundError",
    "ParameterValueType",
    "get_path",
    "load_file",
    "load_xacro",
    "load_yaml",
    "raise_if_file_not_found",
    "render_template",
]

ParameterValueType = (
    str | int | float | bool | list[str] | list[int] | list[float] | list[bool] | bytes
)


class ParameterBuilderFileNotFoundError(KeyError):
    """A file that shall become a parameter is not there."""

    def __str__(self) -> str:
        return str(self.args[0])


def raise_if_file_not_found(file_path: Path) -> None:
    """Do nothing when a file is there.

    Raises:
        ParameterBuilderFileNotFoundError: it is not; the message has the nearest names.
    """
    path = Path(file_path)
    if path.exists():
        return
    text = f"File {path} doesn't exist"
    if not path.parent.is_dir():
        text += f"; there is no folder {path.parent}"
    else:
        names = [one.name for one in sorted(path.parent.iterdir())]
        text += f"; {did_you_mean(path.name, names)}".rstrip("; ")
    raise ParameterBuilderFileNotFoundError(text)


def render_template(template: Path, mappings: Mapping[str, Any]) -> str:
    """Return a file's text with the expressions in double braces worked out."""
    return rendered(read_text_limited(Path(template)), mappings, str(template))


def load_file(file_path: Path, mappings: Mapping[str, Any] | None = None) -> str | None:
    """Return a file's text, rendered with `mappings` if there are any; None when unreadable.

    Raises:
        ParameterBuilderFileNotFoundError: it is not there.
    """
    raise_if_file_not_found(file_path)
    try:
        text = read_text_limited(Path(file_path))
    except OSError:
        return None
    return text if mappings is None else rendered(text, mappings, str(file_path))


def load_yaml(file_path: Path, mappings: Mapping[str, Any] | None = None) -> Any:
    """Return what a YAML file holds, after its expressions in double braces were worked out.

    Raises:
        ParameterBuilderFileNotFoundError: it is not there.
        UserFileError: it is not YAML; with line and column.
    """
    try:
        text = load_file(file_path, mappings or {})
        return None if text is None else read_yaml(text, str(file_path)).value
    except (UnicodeDecodeError, YamlError) as error:
        diagnostics = Diagnostics()
        problem = problem_of(error, str(file_path))
        diagnostics.report("moveit.bad-yaml", f"not YAML: {problem.what}", problem.span)
        raise UserFileError(tuple(diagnostics)) from error


def load_xacro(file_path: Path, mappings: Mapping[str, Any] | None = None) -> str:
    """Return what a xacro file expands to, byte for byte as ``xacro`` and ``toxml`` have it.

    Raises:
        ParameterBuilderFileNotFoundError: it is not there.
        UserFileError: it cannot be expanded; all that is wrong, with places.
    """
    raise_if_file_not_found(file_path)
    workspace = known_workspace()
    diagnostics = Diagnostics()
    arguments = {str(name): str(value) for name, value in (mappings or {}).items()}
    expanded = expand_xacro(
        file_path, mappings=arguments, workspace=workspace, diagnostics=diagnostics
    )
    if expanded is None:
        raise UserFileError(tuple(diagnostics))
    remember(expanded)
    # What the library says goes where the original lets it: on standard error of the launch.
    with run_session(workspace, arguments=arguments, console=_to_stderr) as (library, session):
        document: Any = library.process_file(str(file_path), mappings=session.arguments)
        return str(document.toxml())


def _to_stderr(piece: str) -> None:
    sys.stderr.write(piece)


def get_path(package_name: str, file_path: str) -> str:
    """Return the path of a file in a package's share folder.

    Raises:
        PackageNotFoundError: there is no such package.
    """
    return str(Path(get_package_share_directory(package_name)) / file_path)
