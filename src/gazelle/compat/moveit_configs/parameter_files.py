"""Files that become parameters: text, YAML, xacro, with expressions in double braces."""

from __future__ import annotations

import ast
import math
import operator
import re
import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

from gazelle.description.source_maps import remember
from gazelle.description.xacro import expand_xacro
from gazelle.description.xacro.xacro_library import run_library
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.documents import read_text_limited
from gazelle.documents.yaml import YamlError, problem_of, read_yaml
from gazelle.errors import LaunchError, UserFileError
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
    "rendered",
]

_EXPRESSION = re.compile(r"\{\{(.*?)\}\}", re.DOTALL)
_OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
_ERRORS: tuple[type[Exception], ...]
_ERRORS = (ValueError, KeyError, TypeError, SyntaxError, ArithmeticError)
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    "radians": math.radians,
    "degrees": math.degrees,
}
ParameterValueType = (
    str | int | float | bool | list[str] | list[int] | list[float] | list[bool] | bytes
)

_ERRORS += (RecursionError, MemoryError)


def rendered(text: str, mappings: Mapping[str, Any], file: str) -> str:
    """Return a text with its expressions worked out.

    Jinja2 does the work where it is installed. Without it, names, numbers, arithmetic and
    ``radians()`` and ``degrees()`` are understood, which is what parameter files have.

    Args:
        text: the template.
        mappings: values of names.
        file: for messages.

    Raises:
        LaunchError: an expression needs Jinja2, or cannot be worked out.
    """
    if not any(mark in text for mark in ("{{", "{%", "{#")):
        return text
    try:
        jinja2: Any = import_module("jinja2")
    except ImportError:
        return _rendered_without_jinja(text, mappings, file)
    try:
        template = jinja2.Template(text)
        template.globals.update(_FUNCTIONS)
        return str(template.render(mappings))
    except RecursionError as error:
        raise LaunchError(
            f"{file}: what stands in double braces cannot be worked out: it is nested too deeply"
        ) from error


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
    with run_library(workspace, arguments=arguments, console=_to_stderr) as (library, session):
        document: Any = library.process_file(str(file_path), mappings=session.arguments)
        return str(document.toxml())


def get_path(package_name: str, file_path: str) -> str:
    """Return the path of a file in a package's share folder.

    Raises:
        PackageNotFoundError: there is no such package.
    """
    return str(Path(get_package_share_directory(package_name)) / file_path)


def _rendered_without_jinja(text: str, mappings: Mapping[str, Any], file: str) -> str:
    def value(match: re.Match[str]) -> str:
        try:
            return str(_evaluated(ast.parse(match[1].strip(), mode="eval").body, mappings))
        except _ERRORS as error:
            line = text.count("\n", 0, match.start()) + 1
            reason = f"'{match[0]}' cannot be worked out ({error!r})"
            raise LaunchError(f"{file}:{line}: {reason}; pip install jinja2 may help") from error

    if "{%" in text or "{#" in text:
        raise LaunchError(f"{file}: it has statements of Jinja2: pip install jinja2")
    # Behind the last end there is none to be looked for, again and again.
    end = text.rfind("}}") + len("}}") if "}}" in text else 0
    return _EXPRESSION.sub(value, text[:end]) + text[end:]


def _evaluated(node: ast.expr, mappings: Mapping[str, Any]) -> Any:
    match node:
        case ast.Constant(value=value):
            return value
        case ast.Name(id=name):
            return mappings[name]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_evaluated(left, mappings), _evaluated(right, mappings))
        case ast.UnaryOp(op=op, operand=operand) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_evaluated(operand, mappings))
        case ast.Call(func=ast.Name(id=name), args=[argument]) if name in _FUNCTIONS:
            return _FUNCTIONS[name](_evaluated(argument, mappings))
        case ast.Subscript(value=inner, slice=key):
            return _evaluated(inner, mappings)[_evaluated(key, mappings)]
        case ast.Attribute(value=inner, attr=key):
            return _evaluated(inner, mappings)[key]
    raise ValueError(f"'{ast.unparse(node)}' is not understood")


def _to_stderr(piece: str) -> None:
    sys.stderr.write(piece)
