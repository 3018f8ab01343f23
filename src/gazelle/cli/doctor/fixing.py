"""``gazelle doctor --fix``: what can be mended, as a diff first."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, TextIO

from gazelle.cli.doctor.progress import progress
from gazelle.diagnostics import Severity

if TYPE_CHECKING:
    from gazelle.doctor import Options
    from gazelle.doctor.fixes import FixPlan

__all__ = ["fix"]

_STYLES = {"+": "green", "-": "red", "@": "cyan"}
_EXIT_CODES = {None: 0, Severity.WARNING: 1, Severity.ERROR: 2}


def fix(target: Sequence[str], options: Options, *, only_certain: bool, is_agreed: bool) -> int:
    """Show what would be written, write it when that is wanted, and say what is left.

    The diff goes to standard output, everything else to standard error: it can be kept, or piped
    into ``git apply``.

    Args:
        target: as for the examination.
        options: as for the examination.
        only_certain: leave out what is one of several ways, or an estimate.
        is_agreed: write without asking.

    Returns:
        The exit code of a report of what is left, before anything is written where nothing is.

    Raises:
        GazelleError: see `gazelle.doctor.fixes.plan_fixes`.
    """
    from gazelle.doctor.fixes import plan_fixes, write_fixes

    with progress() as say:
        tell = say or _say_nothing
        plan = plan_fixes(target, options=options, only_certain=only_certain, progress=tell)
    if not plan.mended:
        more = "; --fix-all tries more" if only_certain and plan.left else ""
        _say(f"nothing to mend with certainty{more}" if only_certain else "nothing to mend")
        return _exit_code(plan)
    _show(plan.diff, sys.stdout)
    files = len(plan.texts)
    _say(
        f"mends {_counted(len(plan.mended), 'finding')} in {_counted(files, 'file')} of "
        f"'{plan.folder}'; {_counted(len(plan.left), 'finding')} would be left"
    )
    if not is_agreed and not _asked():
        _say("nothing is written")
        return _EXIT_CODES[max(item.finding.severity for item in plan.mended)]
    write_fixes(plan)
    _say(f"written: {', '.join(sorted(plan.texts))}")
    return _exit_code(plan)


def _asked() -> bool:
    if not sys.stdin.isatty() or not sys.stdout.isatty():
        _say("add --yes to write it")
        return False
    print("write it? [y/N] ", end="", flush=True, file=sys.stderr)
    return sys.stdin.readline().strip().lower() in {"y", "yes"}


def _exit_code(plan: FixPlan) -> int:
    worst = max((item.severity for item in plan.left), default=None)
    return _EXIT_CODES[worst]


def _show(diff: str, stream: TextIO) -> None:
    if not stream.isatty():
        stream.write(diff)
        return
    from rich.console import Console
    from rich.text import Text

    console = Console(file=stream, highlight=False)
    for line in diff.splitlines():
        bold = "bold" if line.startswith(("+++", "---")) else _STYLES.get(line[:1], "")
        console.print(Text(line, style=bold), soft_wrap=True)


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'s' * (number != 1)}"


def _say(text: str) -> None:
    print(f"gazelle doctor: {text}", file=sys.stderr)


def _say_nothing(_text: str) -> None:
    """Nobody wants to hear of the progress."""
