"""xacro to plain XML, byte for byte what the official program prints."""

from __future__ import annotations

import time
import traceback
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any
from xml.parsers.expat import ExpatError

from gazelle.description.xacro.error_explanations import Explanation
from gazelle.description.xacro.error_recovery import RerunPatches
from gazelle.description.xacro.failure import Failure
from gazelle.description.xacro.failure_reports import (
    found_failure,
    repaired,
    report_failure,
    report_left_out,
    report_printed,
)
from gazelle.description.xacro.lint import report_silent_mistakes
from gazelle.description.xacro.xacro_library import Console, run_library
from gazelle.description.xacro.xml_output import Written, written
from gazelle.description.xml import Tag, parse_xml, with_spans
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.diagnostics.share_links import written_file
from gazelle.workspace import Workspace

__all__ = ["Expanded", "expand_xacro"]

_MAX_ERRORS = 20
_SEARCH_S = 2.0
_TRACEBACK_FROM = 2


@dataclass(frozen=True, slots=True)
class Expanded:
    """An expanded xacro file.

    Attributes:
        text: the result, as ``xacro`` prints it.
        file: the input file, as it was named.
        spans: where each element of `text` was written, in document order, None where that is
            not known; `SourceSpan.via` holds the macro calls and includes that brought it there,
            innermost first.
        lines: the line of `text`, from 1, on which each element starts.
        dependencies: the other files read, in the order they were read.
    """

    text: str
    file: str
    spans: tuple[SourceSpan | None, ...] = field(default=(), repr=False)
    lines: tuple[int, ...] = field(default=(), repr=False)
    dependencies: tuple[str, ...] = ()

    @property
    def source_map(self) -> dict[int, SourceSpan]:
        """Line of `text` → place of the first element that starts on it."""
        found: dict[int, SourceSpan] = {}
        for line, span in zip(self.lines, self.spans, strict=True):
            if span is not None:
                found.setdefault(line, span)
        return found

    def tag(self, diagnostics: Diagnostics) -> Tag | None:
        """Return the result as elements whose places are those of the xacro files."""
        root = parse_xml(self.text, self.file, diagnostics)
        return None if root is None else with_spans(root, self.spans)


@dataclass(frozen=True)
class _Task:
    """One file to be expanded, and how."""

    file: str
    arguments: dict[str, str]
    workspace: Workspace | None
    root_dir: str
    verbosity: int


def expand_xacro(
    path: str | Path,
    *,
    mappings: Mapping[str, str] | None = None,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    root_dir: str = "",
    verbosity: int = 1,
    console: Console | None = None,
) -> Expanded | None:
    """Expand a xacro file in this process with the official library.

    Args:
        path: the file; stands in the result's banner as it is written here.
        mappings: values of ``<xacro:arg>`` by name.
        workspace: finds packages for ``$(find)``.
        diagnostics: receives errors, all that can be found at once, and warnings.
        root_dir: folder that a relative `path` and ``$(cwd)`` start from, empty for the
            current one.
        verbosity: 0 to 4, as the program's ``--verbosity``.
        console: receives what the official program prints to standard error, its warnings and
            the head of an error; they are no diagnostics then.

    Returns:
        The result; None when xacro fails, with the reason reported at its place.
    """
    values = {str(name): str(value) for name, value in (mappings or {}).items()}
    task = _Task(str(path), values, workspace, root_dir, verbosity)
    result = _first_run(task, diagnostics, console)
    if isinstance(result, Expanded):
        return result
    _report_all(task, result, diagnostics)
    return None


def _first_run(
    task: _Task, diagnostics: Diagnostics, console: Console | None
) -> Expanded | tuple[Failure, Explanation]:
    with _session(task, console, None) as (library, library_run):
        try:
            document: Any = library.process_file(
                task.file, mappings=library_run.arguments, verbosity=task.verbosity
            )
            result = written(document)
        # The library evaluates expressions of the file: anything can be raised in there.
        except Exception as error:  # noqa: BLE001
            if console is None:
                report_printed(library_run, task.file, diagnostics)
            else:
                _print_failure(error, library, task.verbosity, console)
            report_left_out(library_run, task.file, diagnostics)
            return found_failure(error, library, library_run, task.file)
        dependencies = tuple(
            dict.fromkeys(str(written_file(item)) for item in library.all_includes)
        )
    if console is None:
        report_printed(library_run, task.file, diagnostics)
    report_left_out(library_run, task.file, diagnostics)
    report_silent_mistakes(result, library_run, task.file, task.arguments, diagnostics)
    return _expanded(result, task.file, dependencies)


def _expanded(result: Written, file: str, dependencies: tuple[str, ...]) -> Expanded:
    return Expanded(result.text, file, tuple(result.spans), tuple(result.lines), dependencies)


def _session(task: _Task, console: Console | None, patches: RerunPatches | None) -> Any:
    return run_library(
        task.workspace,
        arguments=dict(task.arguments),
        root_dir=task.root_dir,
        verbosity=task.verbosity,
        console=console,
        patches=patches,
    )


def _report_all(task: _Task, first: tuple[Failure, Explanation], diagnostics: Diagnostics) -> None:
    """Report a failure, then those that show when it is taken out, and so on."""
    patches = RerunPatches()
    end_s = time.monotonic() + _SEARCH_S
    found: tuple[Failure, Explanation] | None = first
    for _ in range(_MAX_ERRORS):
        if found is None:
            return
        failure, finding = found
        report_failure(failure, finding, patches, diagnostics)
        if not repaired(failure, finding, patches) or time.monotonic() > end_s:
            return
        found = _next_failure(task, patches)


def _next_failure(task: _Task, patches: RerunPatches) -> tuple[Failure, Explanation] | None:
    with _session(task, None, patches) as (library, library_run):
        try:
            library.process_file(task.file, mappings=library_run.arguments)
        # As in the first run.
        except Exception as error:  # noqa: BLE001
            return found_failure(error, library, library_run, task.file)
    return None


def _print_failure(error: Exception, library: ModuleType, verbosity: int, console: Console) -> None:
    """Print what the official program prints when it fails, without its advice."""
    if isinstance(error, ExpatError):
        library.error(f"XML parsing error: {error}", alt_text=None)
    else:
        library.error(str(error) or repr(error))
    if verbosity > 0:
        library.print_location()
    if verbosity >= _TRACEBACK_FROM and not isinstance(error, ExpatError):
        console("\n" + "".join(traceback.format_exception(error)))
