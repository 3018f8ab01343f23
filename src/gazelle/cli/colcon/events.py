"""What colcon prints while it works, and the log folder it leaves."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from gazelle.diagnostics import did_you_mean
from gazelle.workspace.building.build import Outcome

__all__ = ["Console", "Log", "duration"]

_ON = frozenset({"console_start_end", "console_stderr", "log", "summary"})
_OFF = frozenset({"console_cohesion", "console_direct", "console_package_list"})
# Handlers of colcon that show or write what there is none of here.
_SILENT = frozenset(
    {"desktop_notification", "compile_commands", "event_log", "log_command", "status",
     "store_result", "terminal_title"}
)  # fmt: skip


class Console:
    """Prints the lines of colcon's event handlers.

    Args:
        handlers: words such as ``console_direct+`` and ``console_stderr-``.
    """

    def __init__(self, handlers: Sequence[str]) -> None:
        self._active = set(_ON)
        self.outcomes: list[Outcome] = []
        for word in handlers:
            self._switch(word)

    @property
    def writes_log(self) -> bool:
        """The handler ``log`` is on."""
        return "log" in self._active

    def listed(self, names: Sequence[str], all_names: Sequence[str]) -> None:
        """Print which packages are meant."""
        if "console_package_list" in self._active:
            print("Topological order\n" + "\n".join(f"- {name}" for name in names))
            left = [name for name in all_names if name not in names]
            print("".join(f"- ({name})\n" for name in left), end="", flush=True)

    def started(self, name: str) -> None:
        """Print that work on a package begins."""
        if "console_start_end" in self._active:
            print(f"Starting >>> {name}", flush=True)

    def ended(self, outcome: Outcome) -> None:
        """Print what came of it."""
        self.outcomes.append(outcome)
        if "console_direct" in self._active:
            _print_lines(outcome.output)
        elif "console_cohesion" in self._active and outcome.output:
            print(f"--- output: {outcome.name}")
            _print_lines(outcome.output)
            print("---", flush=True)
        if "console_stderr" in self._active and outcome.errors:
            text = "\n".join([f"--- stderr: {outcome.name}", *outcome.errors, "---"])
            print(text, file=sys.stderr, flush=True)
        if "console_start_end" in self._active:
            took = duration(outcome.duration_s)
            if outcome.code == 0:
                print(f"Finished <<< {outcome.name} [{took}]", flush=True)
            else:
                line = f"Failed   <<< {outcome.name} [{took}, exited with code {outcome.code}]"
                print(line, file=sys.stderr, flush=True)

    def summary(self, took_s: float, left: Sequence[str]) -> None:
        """Print the last lines."""
        if "summary" not in self._active:
            return
        good = [item.name for item in self.outcomes if item.code == 0]
        failed = sorted(item.name for item in self.outcomes if item.code != 0)
        told = sorted(item.name for item in self.outcomes if item.errors)
        print(f"\nSummary: {_packages(len(good))} finished [{duration(took_s)}]")
        if failed:
            print(f"  {_packages(len(failed))} failed: {' '.join(failed)}")
        if told:
            print(f"  {_packages(len(told))} had stderr output: {' '.join(told)}")
        if left:
            print(f"  {_packages(len(left))} not processed")
        sys.stdout.flush()

    def _switch(self, word: str) -> None:
        name = word.rstrip("+-")
        if name in _ON | _OFF:
            (self._active.discard if word.endswith("-") else self._active.add)(name)
        elif name not in _SILENT:
            hint = did_you_mean(name, sorted(_ON | _OFF))
            print(f"colcon: there is no event handler '{name}'; {hint}", file=sys.stderr)


class Log:
    """The folder ``log/<verb>_<time>`` with one folder per package.

    Args:
        base: ``log``; ``/dev/null`` for none.
        verb: such as ``build``.
    """

    def __init__(self, base: Path, verb: str) -> None:
        self._folder: Path | None = None
        if str(base) == "/dev/null":
            return
        name = f"{verb}_{datetime.now().astimezone():%Y-%m-%d_%H-%M-%S}"
        self._folder = base / name
        self._folder.mkdir(parents=True, exist_ok=True)
        (base / "COLCON_IGNORE").touch()
        _point(base / f"latest_{verb}", name)
        _point(base / "latest", f"latest_{verb}")

    def keep(self, outcome: Outcome) -> None:
        """Write a package's output."""
        if self._folder is None:
            return
        folder = self._folder / outcome.name
        folder.mkdir(exist_ok=True)
        for name, lines in (
            ("stdout.log", outcome.output),
            ("stderr.log", outcome.errors),
            ("stdout_stderr.log", (*outcome.output, *outcome.errors)),
        ):
            text = "".join(f"{line}\n" for line in lines)
            (folder / name).write_text(text, encoding="utf-8")


def duration(seconds: float) -> str:
    """Return a duration with three digits, as colcon writes it: ``0.53s``, ``1min 3s``."""
    minutes, rest = divmod(seconds, 60)
    if minutes >= 60:
        return f"{int(minutes // 60)}h {int(minutes % 60)}min {int(rest)}s"
    if minutes:
        return f"{int(minutes)}min {int(rest)}s"
    return f"{rest:.1f}s" if rest >= 10 else f"{rest:.2f}s"


def _packages(count: int) -> str:
    return f"{count} package" if count == 1 else f"{count} packages"


def _print_lines(lines: Sequence[str]) -> None:
    if lines:
        print("\n".join(lines), flush=True)


def _point(link: Path, target: str) -> None:
    if link.is_symlink():
        link.unlink()
    if not link.exists():
        link.symlink_to(target)
