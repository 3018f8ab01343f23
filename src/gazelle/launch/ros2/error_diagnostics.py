"""What went wrong in a launch, as diagnostics with the user's lines."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path

from gazelle.diagnostics import Diagnostic, Diagnostics, SourceSpan, did_you_mean
from gazelle.documents.files import is_folder
from gazelle.launch.environment import ROS_COMMANDS
from gazelle.launch.ros2.conditions import InvalidConditionExpressionError
from gazelle.launch.ros2.explaining import Explained, explain
from gazelle.launch.ros2.substitutions.substitution_failure import SubstitutionFailure
from gazelle.launch.ros2.user_spans import kept_place, raising_place

__all__ = ["diagnose", "not_started", "with_diagnostic"]

_ATTRIBUTE = "_gazelle_diagnostic"
_MAX_LETTERS = 3


def with_diagnostic(
    error: Exception,
    code: str,
    message: str,
    place: SourceSpan | None = None,
    *,
    fix: str = "",
) -> Exception:
    """Return an error that brings its own finding along, to be raised."""
    diagnostics = Diagnostics()
    diagnostics.report(code, message, place, fix=fix)
    setattr(error, _ATTRIBUTE, next(iter(diagnostics)))
    return error


def diagnose(error: BaseException) -> list[Diagnostic]:
    """Return what an error means for the user's files: the innermost causes and their lines."""
    found = Diagnostics()
    for cause in _causes(error):
        own: Diagnostic | None = getattr(cause, _ATTRIBUTE, None)
        if own is not None:
            found.add(own)
            continue
        known = explain(cause) or Explained(_code(cause))
        message = known.message or f"{type(cause).__name__}: {cause}"
        found.report(known.code, message, _place(cause, error), fix=known.fix)
    return list(found)


def not_started(
    error: Exception, cmd: Sequence[str], cwd: str | None, place: SourceSpan | None
) -> Diagnostic:
    """Return the finding about a process that cannot be started."""
    program = cmd[0] if cmd else ""
    fix = ""
    if cwd is not None and not is_folder(Path(cwd)):
        message = f"'{program}' cannot be started: its folder '{cwd}' does not exist"
    elif " " in program.strip() and shutil.which(program.split()[0]):
        message = f"'{program}' is no program: cmd is a list of words, and this is one word"
        fix = f"cmd={program.split()!r}, or shell=True"
    elif len(cmd) > _MAX_LETTERS and all(len(word) == 1 for word in cmd):
        message = f"'{''.join(cmd)}' was given as one text, which is taken letter by letter"
        fix = f"cmd={''.join(cmd).split()!r}"
    elif isinstance(error, FileNotFoundError):
        message = f"the program '{program}' is not on the PATH"
        fix = did_you_mean(program, ROS_COMMANDS)
    else:
        message = f"'{program}' cannot be started: {error}"
    found = Diagnostics()
    found.report("ros2_launch.process-not-started", message, place, fix=fix)
    return next(iter(found))


def _causes(error: BaseException) -> Iterator[BaseException]:
    """Yield the errors that readers gave up for, else the error itself."""
    likely = getattr(error, "likely_errors", ())
    if not likely:
        yield error
        return
    # What the reader for the file's own extension says; the others only say that it is not theirs.
    yield from _causes(likely[0])


def _code(error: BaseException) -> str:
    if isinstance(error, SubstitutionFailure):
        return "ros2_launch.substitution"
    if isinstance(error, InvalidConditionExpressionError):
        return "ros2_launch.bad-condition"
    if isinstance(error, FileNotFoundError) and raising_place(error) is None:
        return "ros2_launch.file-missing"
    return "ros2_launch.exception"


def _place(cause: BaseException, error: BaseException) -> SourceSpan | None:
    return raising_place(cause) or kept_place(cause) or kept_place(error)
