"""Checks of files, which are the doctor's."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle.cli.roswtf.findings import Findings
from gazelle.diagnostics import Severity
from gazelle.errors import GazelleError
from gazelle.workspace import Workspace

__all__ = ["look_at_files", "look_at_folder"]


def look_at_files(launches: Sequence[str], found: Findings) -> None:
    """Examine launch files."""
    for name in launches:
        _examine([name], found)


def look_at_folder(folder: Path, found: Findings, *, everything: bool) -> None:
    """Examine the package of a folder; the whole workspace with `everything`."""
    workspace = Workspace.discover()
    here = {folder.resolve(), *folder.resolve().parents}
    own = list(workspace.user_packages)
    package = next((item for item in own if item.path.resolve() in here), None)
    if package is None:
        print("No package or stack in the current directory")
    else:
        print(f"Package: {package.name}")
    if everything:
        names = [str(item.path) for item in own]
    else:
        names = [] if package is None else [str(package.path)]
    for name in names:
        _examine([name], found)


def _examine(words: list[str], found: Findings) -> None:
    # The doctor is not needed for a look at the graph alone.
    from gazelle.doctor import examine

    try:
        report = examine(words)
    except GazelleError as error:
        found.errors.append(str(error))
        return
    for item in report.findings:
        place = f"{item.span}: " if item.span else ""
        text = f"{place}{item.message} [{item.code}]" + (f"\n  fix: {item.fix}" if item.fix else "")
        if item.severity is Severity.ERROR:
            found.errors.append(text)
        elif item.severity is Severity.WARNING:
            found.warnings.append(text)
