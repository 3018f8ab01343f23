"""What `gazelle doctor --fix` would write: tried in a copy, shown before it is done."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from gazelle.diagnostics import Diagnostic, Severity
from gazelle.doctor.command_line import examine
from gazelle.doctor.fixes.mend import Mended, mend
from gazelle.doctor.fixes.trial import Trial
from gazelle.doctor.report import Options
from gazelle.doctor.target import Target, find_target, package_at
from gazelle.errors import GazelleError
from gazelle.workspace import Workspace

__all__ = ["FixPlan", "plan_fixes", "write_fixes"]


@dataclass(frozen=True, slots=True)
class FixPlan:
    """What would be written.

    Attributes:
        mended: findings that go, with what is written for them, in that order.
        left: findings that stay.
        texts: of the files that change, before and after.
        diff: of them, as ``git apply`` takes it in `folder`.
        folder: that the names in `diff` are relative to.
    """

    mended: tuple[Mended, ...]
    left: tuple[Diagnostic, ...]
    texts: Mapping[str, tuple[str, str]]
    diff: str
    folder: Path


def plan_fixes(
    argv: Sequence[str],
    *,
    options: Options | None = None,
    only_certain: bool = True,
    progress: Callable[[str], None] = lambda _text: None,
    cwd: Path | None = None,
) -> FixPlan:
    """Find out which findings can be mended, and how; nothing of the user's is changed.

    Every fix is applied to a copy and the copy examined: it is kept when its finding is gone and
    none has come.

    Args:
        argv: as for `examine`.
        options: as for `examine`.
        only_certain: leave out what is one of several ways, or an estimate.
        progress: told what is tried.
        cwd: what relative paths start from; the current folder when None.

    Raises:
        NotFoundError: nothing has the name given.
        GazelleError: there is nothing that can be examined, or a copy cannot be made.
    """
    options = options or Options()
    here = (Path.cwd() if cwd is None else cwd).resolve()
    workspace = Workspace.discover(environ=options.environ, cwd=here)
    folder = _folder_of(find_target(argv, workspace, here), workspace)

    def look(copy: Path) -> tuple[Diagnostic, ...]:
        moved = _Moved(folder, copy)
        environ = {key: moved.text(value) for key, value in options.environ.items()}
        place = moved.path(here) or (copy.parent if here == folder.parent else copy)
        found = Workspace.discover(environ=environ, cwd=place, extra=[copy])
        report = examine(
            [moved.word(word, here) for word in argv],
            workspace=found,
            options=replace(options, environ=environ),
            cwd=place,
        )
        return report.findings

    with Trial.of(folder, look) as trial:
        progress("reading")
        findings = trial.examine()
        mended = mend(trial, findings, only_certain=only_certain, say=progress)
        left = tuple(trial.examine()) if mended else tuple(findings)
        left = tuple(item for item in left if item.severity > Severity.INFO)
        return FixPlan(tuple(mended), left, trial.texts(), trial.diff(), folder)


def write_fixes(plan: FixPlan) -> None:
    """Write what is planned; each file is whole at every moment.

    Raises:
        GazelleError: a file has changed since, or cannot be written.
    """
    for file, (before, _) in plan.texts.items():
        if Path(file).read_bytes().decode("utf-8") != before:
            raise GazelleError(f"'{file}' has changed since it was looked at; nothing is written")
    for file, (_, after) in plan.texts.items():
        path = Path(file).resolve()
        beside = path.with_name(f".{path.name}.gazelle")
        try:
            beside.write_bytes(after.encode("utf-8"))
            beside.chmod(path.stat().st_mode)
            beside.replace(path)
        except OSError as error:
            beside.unlink(missing_ok=True)
            raise GazelleError(f"'{file}' cannot be written: {error.strerror}") from error


@dataclass(frozen=True, slots=True)
class _Moved:
    """Names of a folder that stands for another."""

    folder: Path
    copy: Path

    def text(self, text: str) -> str:
        return text.replace(str(self.folder), str(self.copy))

    def path(self, path: Path) -> Path | None:
        return (
            self.copy / path.relative_to(self.folder) if path.is_relative_to(self.folder) else None
        )

    def word(self, word: str, here: Path) -> str:
        """Return a word of the command line; paths of the folder are those of the copy."""
        path = here / Path(word).expanduser()
        if not path.exists():
            return word
        moved = self.path(path.resolve())
        ending = "/" if word.endswith("/") else ""
        return word if moved is None else f"{moved}{ending}"


def _folder_of(target: Target, workspace: Workspace) -> Path:
    """Return what a copy is made of: the sources of the target's workspace."""
    places = [package.path for package in target.packages]
    places += [target.folder] if target.folder is not None else []
    for file in target.files:
        owner = package_at(file.parent, workspace)
        places.append(file.parent if owner is None else owner.path)
    around = [_sources_around(place.resolve()) for place in places]
    common = Path(os.path.commonpath(around))
    if common == Path(common.anchor) or common == Path.home():
        raise GazelleError(f"what is to be fixed lies all over '{common}'; name one package")
    return common


def _sources_around(place: Path) -> Path:
    """Return the ``src`` of a workspace that a package lies in, or the package itself."""
    for folder in place.parents:
        if folder.name == "src" and not (folder / "package.xml").exists():
            return folder
    return place
