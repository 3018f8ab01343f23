"""What xacro says, as diagnostics with a place, the macro stack and a remedy."""

from __future__ import annotations

import re
from dataclasses import replace
from types import ModuleType

from gazelle.description.xacro.error_explanations import Finding, explain
from gazelle.description.xacro.failure import Failure, failure_of
from gazelle.description.xacro.library_run import Session
from gazelle.description.xacro.rerun_patches import Repairs
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


def report_printed(session: Session, file: str, diagnostics: Diagnostics) -> None:
    """Report the warnings and messages that a run printed.

    Args:
        session: the run.
        file: its input file, the place of warnings that name no other.
        diagnostics: receives ``xacro.warning``, ``xacro.message``.
    """
    for line, span in session.printed:
        if not line or _LOCATION.match(line):
            continue
        text, warned = re.subn(r"^(warning|error): ", "", line)
        code = "xacro.warning" if warned else "xacro.message"
        diagnostics.report(code, text, span or SourceSpan(file))


def report_left_out(session: Session, file: str, diagnostics: Diagnostics) -> None:
    """Report the includes that were left out because their package is missing."""
    for missing, span in session.left_out:
        hint = did_you_mean(missing.name, missing.nearest)
        message = f"package '{missing.name}' not found: this include is left out"
        message += "; the real xacro stops here"
        diagnostics.report("xacro.include-left-out", message, span or SourceSpan(file), fix=hint)


def found_failure(
    error: Exception, library: ModuleType, session: Session, file: str
) -> tuple[Failure, Finding]:
    """Find out why a run failed.

    Args:
        error: what the library raised.
        library: the xacro module, with its stacks as they were when it failed.
        session: the run.
        file: its input file.
    """
    failure = failure_of(error, library, session, file)
    return failure, explain(failure)


def report_failure(
    failure: Failure, finding: Finding, repairs: Repairs, diagnostics: Diagnostics
) -> None:
    """Report a failure, unless an earlier one explains it."""
    # The same mistake in a file that is read twice, or by another call.
    here = replace(finding.span, via=())
    if any(
        item.span is not None and replace(item.span, via=()) == here for item in diagnostics.errors
    ):
        return
    left_out = failure.session.left_out
    message = finding.message
    if finding.code in _NEEDS_DEFINITION:
        if finding.subject in repairs.suspects:
            return
        is_certain = finding.fix and finding.code != "xacro.argument-missing"
        is_certain = is_certain and not finding.fix.startswith("did you mean")
        may_follow = repairs.is_incomplete or (left_out and diagnostics.errors)
        if may_follow and not is_certain:
            return
        if left_out:
            names = dict.fromkeys(missing.name for missing, _ in left_out)
            message += "; missing packages may define it: " + ", ".join(names)
    diagnostics.report(
        finding.code, message, finding.span, fix=finding.fix, severity=Severity.ERROR
    )


def repaired(failure: Failure, finding: Finding, repairs: Repairs) -> bool:
    """Take out what failed, so that a run can go on behind it.

    Returns:
        Whether something was taken out that was still there.
    """
    tag = str(getattr(failure.node, "tagName", ""))
    if finding.code == "xacro.undefined-name" and finding.subject not in ("", *repairs.names):
        repairs.names.add(finding.subject)
        if tag != "xacro:include":
            return True
    if finding.code == "xacro.argument-missing":
        repairs.suspects.add(finding.subject)
    culprit = failure.session.properties.get(finding.subject) if finding.subject else None
    if finding.code in _ABOUT_VALUES and culprit is not None:
        # Every expression with this value would fail.
        return repairs.replace_part(culprit, "value", "")
    place = failure.element
    if finding.code in {"limits.expansion", "xacro.recursion", "xml.entity"} or place is None:
        return False
    if tag == "xacro:include" or finding.code.startswith("xml."):
        calls = failure.session.tracker.calls
        repairs.is_incomplete = True
        return repairs.remove(calls[-1] if calls and tag != "xacro:include" else place)
    if failure.text and (not tag.startswith("xacro:") or tag in _EVALUATED or failure.attribute):
        return repairs.replace_part(place, failure.attribute, failure.part) or _removed(
            failure, repairs
        )
    return _removed(failure, repairs)


def _removed(failure: Failure, repairs: Repairs) -> bool:
    """Take an element out, and with it what it would have defined."""
    node, place = failure.node, failure.element
    tag = str(getattr(node, "tagName", ""))
    if place is None or not tag:
        return False
    name = node.getAttribute("name")
    if tag == "xacro:property":
        repairs.names.update({name} if name.isidentifier() else ())
    elif tag in {"xacro:macro", "xacro:arg"}:
        repairs.suspects.add(name)
    elif tag.startswith("xacro:") and tag not in {"xacro:if", "xacro:unless"}:
        # A macro may define properties for its caller.
        repairs.is_incomplete = True
    return repairs.remove(place)
