"""Files and packages that cannot be found, and YAML that cannot be read."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from gazelle.description.xacro.error_explanations.finding import Finding, one_line
from gazelle.description.xacro.failure import Failure
from gazelle.diagnostics import did_you_mean
from gazelle.documents.files import exists, is_folder
from gazelle.documents.yaml import ProblemKind, PyYamlError, problem_of
from gazelle.errors import NotFoundError

__all__ = ["explain_file"]


def explain_file(failure: Failure) -> Finding | None:
    """Explain a missing package or file, or broken YAML; None for other failures."""
    missing = failure.cause(NotFoundError)
    lookup = failure.cause(LookupError)
    if missing is None and lookup is not None and "workspace" in str(lookup):
        missing = lookup
    if missing is not None:
        return Finding("xacro.package-missing", one_line(str(missing)), failure.span)
    broken = failure.cause(PyYamlError)
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


def _broken_yaml(error: Exception, failure: Failure) -> Finding:
    file = str(failure.locals.get("load_yaml", {}).get("filename", ""))
    problem = problem_of(error, file)
    context = f"{problem.context}: " if problem.context else ""
    message = f"not YAML: {context}{one_line(problem.what)}"
    if not file or not problem.has_place:
        return Finding("xacro.bad-yaml", message, failure.span)
    calls = (replace(failure.span, via=()), *failure.via)
    span = replace(problem.span, length=1, via=calls)
    is_tab = problem.kind in {ProblemKind.TAB, ProblemKind.TAB_INDENT}
    return Finding("xacro.bad-yaml", message, span, problem.fix if is_tab else "", file)
