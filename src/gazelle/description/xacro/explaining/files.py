"""Files and packages that cannot be found, and YAML that cannot be read."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import yaml

from gazelle.description.xacro.explaining.finding import Finding, one_line
from gazelle.description.xacro.failure import Failure
from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.errors import NotFoundError
from gazelle.limits.names import exists, is_folder

__all__ = ["explain_file"]


def explain_file(failure: Failure) -> Finding | None:
    """Explain a missing package or file, or broken YAML; None for other failures."""
    missing = failure.cause(NotFoundError)
    lookup = failure.cause(LookupError)
    if missing is None and lookup is not None and "workspace" in str(lookup):
        missing = lookup
    if missing is not None:
        return Finding("xacro.package-missing", one_line(str(missing)), failure.span)
    broken = failure.cause(yaml.YAMLError)
    if broken is not None:
        return _broken_yaml(broken, failure)
    error = failure.cause(OSError)
    return None if error is None else _unreadable(error, failure)


def _unreadable(error: OSError, failure: Failure) -> Finding:
    name = str(error.filename)
    path = Path(name)
    message = f"cannot read '{os.path.normpath(name)}': {error.strerror}"
    written = str(failure.locals.get("load_yaml", {}).get("filename", ""))
    if not path.is_absolute() and not exists(path):
        message += f"; looked for it at '{path.absolute()}'"
    if failure.element is None:
        return Finding(
            "xacro.file-missing", message, failure.span, _near(path, failure.files), name
        )
    if not written and failure.node is not None and failure.node.hasAttribute("filename"):
        span = failure.attribute_place("filename")
    else:
        span = failure.span
    return Finding("xacro.file-missing", message, span, _near(path, failure.files), name)


def _near(path: Path, files: tuple[str, ...]) -> str:
    folder = path.parent
    readers = [Path(name).name for name in files]
    if not is_folder(folder):
        return f"there is no folder '{folder}'"
    names = (item.name for item in folder.iterdir() if item.suffix == path.suffix)
    return did_you_mean(path.name, (name for name in names if name not in readers))


def _broken_yaml(error: yaml.YAMLError, failure: Failure) -> Finding:
    file = str(failure.locals.get("load_yaml", {}).get("filename", ""))
    problem = getattr(error, "problem", None) or one_line(str(error))
    context = getattr(error, "context", None)
    message = f"not YAML: {f'{context}: ' if context else ''}{problem}"
    mark = getattr(error, "problem_mark", None)
    if not file or mark is None:
        return Finding("xacro.bad-yaml", message, failure.span)
    calls = (replace(failure.span, via=()), *failure.via)
    span = SourceSpan(file, mark.line + 1, mark.column + 1, 1, calls)
    fix = "indent with spaces" if "'\\t'" in message else ""
    return Finding("xacro.bad-yaml", message, span, fix, file)
