"""What xacro says, as diagnostics with a place, the macro stack and a remedy."""

from __future__ import annotations

import re
from dataclasses import replace
from types import ModuleType

from gazelle.description.xacro.error_explanations import Explanation, explain
from gazelle.description.xacro.error_recovery import RerunPatches
from gazelle.description.xacro.failure import Failure, failure_of
from gazelle.description.xacro.xacro_library import LibraryRun
from gazelle.diagnostics import Diagnostics, Severity, SourceSpan, did_you_mean

__all__ = [
    "found_failure",
    "repaired",
    "report_failure",
    "report_left_out",
    "report_printed",
]

_LOCATION = re.compile(
    r"(when instantiating macro|instantiated from|in file|when processing file|included from): "
)
_NEEDS_DEFINITION = frozenset(
    {"xacro.argument-missing", "xacro.undefined-name", "xacro.unknown-macro"}
)
_ABOUT_VALUES = frozenset({"xacro.bad-expression", "xacro.decimal-comma"})
_EVALUATED = ("xacro:property", "xacro:if", "xacro:unless", "xacro:arg")


def report_printed(library_run: LibraryRun, file: str, diagnostics: Diagnostics) -> None:
    """Report the warnings and messages that a run printed.

    Args:
        library_run: the run.
        file: its input file, the place of warnings that name no other.
        diagnostics: receives ``xacro.warning``, ``xacro.message``.
    """
    for line, span in library_run.printed:
        if not line or _LOCATION.match(line):
            continue
        text, warned = re.subn(r"^(warning|error): ", "", line)
        code = "xacro.warning" if warned else "xacro.message"
        diagnostics.report(code, text, span or SourceSpan(file))


def report_left_out(library_run: LibraryRun, file: str, diagnostics: Diagnostics) -> None:
    """Report the includes that were left out because their package is missing."""
    for missing, span in library_run.left_out:
        hint = did_you_mean(missing.name, missing.nearest)
        message = f"package '{missing.name}' not found: this include is left out"
        message += "; the real xacro stops here"
        diagnostics.report("xacro.include-left-out", message, span or SourceSpan(file), fix=hint)


def found_failure(
    error: Exception, library: ModuleType, library_run: LibraryRun, file: str
) -> tuple[Failure, Explanation]:
    """Find out why a run failed.

    Args:
        error: what the library raised.
        library: the xacro module, with its stacks as they were when it failed.
        library_run: the run.
        file: its input file.
    """
    failure = failure_of(error, library, library_run, file)
    return failure, explain(failure)


def report_failure(
    failure: Failure, finding: Explanation, patches: RerunPatches, diagnostics: Diagnostics
) -> None:
    """Report a failure, unless an earlier one explains it."""
    # The same mistake in a file that is read twice, or by another call.
    here = replace(finding.span, via=())
    if any(
        item.span is not None and replace(item.span, via=()) == here for item in diagnostics.errors
    ):
        return
    left_out = failure.library_run.left_out
    message = finding.message
    if finding.code in _NEEDS_DEFINITION:
        if finding.subject in patches.suspects:
            return
        is_certain = finding.fix and finding.code != "xacro.argument-missing"
        is_certain = is_certain and not finding.fix.startswith("did you mean")
        may_follow = patches.is_incomplete or (left_out and diagnostics.errors)
        if may_follow and not is_certain:
            return
        if left_out:
            names = dict.fromkeys(missing.name for missing, _ in left_out)
            message += "; missing packages may define it: " + ", ".join(names)
    diagnostics.report(
        finding.code, message, finding.span, fix=finding.fix, severity=Severity.ERROR
    )


def repaired(failure: Failure, finding: Explanation, patches: RerunPatches) -> bool:
    """Take out what failed, so that a run can go on behind it.

    Returns:
        Whether something was taken out that was still there.
    """
    tag = str(getattr(failure.node, "tagName", ""))
    if finding.code == "xacro.undefined-name" and finding.subject not in ("", *patches.names):
        patches.names.add(finding.subject)
        if tag != "xacro:include":
            return True
    if finding.code == "xacro.argument-missing":
        patches.suspects.add(finding.subject)
    culprit = failure.library_run.properties.get(finding.subject) if finding.subject else None
    if finding.code in _ABOUT_VALUES and culprit is not None:
        # Every expression with this value would fail.
        return patches.replace_part(culprit, "value", "")
    span = failure.element
    if finding.code in {"limits.expansion", "xacro.recursion", "xml.entity"} or span is None:
        return False
    if tag == "xacro:include" or finding.code.startswith("xml."):
        calls = failure.library_run.tracker.calls
        patches.is_incomplete = True
        return patches.remove(calls[-1] if calls and tag != "xacro:include" else span)
    if failure.text and (not tag.startswith("xacro:") or tag in _EVALUATED or failure.attribute):
        return patches.replace_part(span, failure.attribute, failure.part) or _removed(
            failure, patches
        )
    return _removed(failure, patches)


def _removed(failure: Failure, patches: RerunPatches) -> bool:
    """Take an element out, and with it what it would have defined."""
    node, span = failure.node, failure.element
    tag = str(getattr(node, "tagName", ""))
    if span is None or not tag:
        return False
    name = node.getAttribute("name")
    if tag == "xacro:property":
        patches.names.update({name} if name.isidentifier() else ())
    elif tag in {"xacro:macro", "xacro:arg"}:
        patches.suspects.add(name)
    elif tag.startswith("xacro:") and tag not in {"xacro:if", "xacro:unless"}:
        # A macro may define properties for its caller.
        patches.is_incomplete = True
    return patches.remove(span)
