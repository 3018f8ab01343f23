"""The way in: from the words of a command line to a report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.description.errors_as_warnings import strict
from gazelle.diagnostics import Diagnostic
from gazelle.doctor.causes import causes_first
from gazelle.doctor.examine_file import examine_file, kind_name
from gazelle.doctor.examine_package import examine_folder, examine_package
from gazelle.doctor.file_kinds import Kind, kind_of
from gazelle.doctor.merged_findings import condensed
from gazelle.doctor.packages import check_environment
from gazelle.doctor.report import Examination, Options, Report
from gazelle.doctor.robots_and_worlds import without_superseded
from gazelle.doctor.target import Target, find_target, package_at
from gazelle.doctor.works_elsewhere import as_warnings_of_parts_elsewhere
from gazelle.simulator.plugins.user.finder import remembering_folders
from gazelle.workspace import Workspace

__all__ = ["examine"]


def examine(
    argv: Sequence[str],
    *,
    workspace: Workspace | None = None,
    options: Options | None = None,
    progress: Callable[[str], None] | None = None,
    cwd: Path | None = None,
) -> Report:
    """Examine a package, a file, a launch or the workspace around the current folder.

    Nothing is started: no process, no socket, no thread stays behind.

    Args:
        argv: ``PKG``, ``FOLDER``, ``FILE``, ``PKG FILE``, or nothing for what the current
            folder is in; arguments (``name:=value``) are in `options`.
        workspace: finds packages and models; made from the options' environment when None.
        options: choices of the caller.
        progress: told what is being looked at.
        cwd: what relative paths start from; the current folder when None.

    Raises:
        NotFoundError: nothing has the name given.
        GazelleError: there is nothing that can be examined.
    """
    options = options or Options()
    here = Path.cwd() if cwd is None else cwd
    workspace = workspace or Workspace.discover(environ=options.environ, cwd=here)
    target = find_target(argv, workspace, here)
    examination = Examination(workspace, options)
    if progress is not None:
        examination.say = progress
    check_environment(options.environ, diagnostics=examination.diagnostics)
    with remembering_folders():
        kind = _examine(target, examination)
    examination.diagnostics.extend(workspace.diagnostics)
    findings, consequences = causes_first(_findings(examination))
    return Report(
        target=target.name,
        kind=kind,
        findings=findings,
        sections=tuple(examination.sections),
        consequences=consequences,
    )


def _findings(examination: Examination) -> list[Diagnostic]:
    packages = examination.workspace.packages
    own = examination.workspace.user_packages
    known = {*packages, *(name for item in own for name in item.depends)}
    found = _once(without_superseded(tuple(strict(examination.diagnostics))))
    found = as_warnings_of_parts_elsewhere(found, (item.name for item in own))
    return condensed(found, known)


def _once(findings: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Keep one of findings that differ only in the includes that led to them."""
    kept: dict[Diagnostic, Diagnostic] = {}
    for item in findings:
        bare = item if item.span is None else replace(item, span=replace(item.span, via=()))
        kept.setdefault(bare, item)
    return list(kept.values())


def _examine(target: Target, examination: Examination) -> str:
    """Examine everything of a target and return the report's word for what it is."""
    if target.packages:
        for package in target.packages:
            examine_package(package, examination)
        return "package" if len(target.packages) == 1 else "workspace"
    if target.folder is not None:
        examine_folder(target.folder, examination)
        return "folder"
    kind = kind_of(target.files[0], examination.diagnostics)
    if kind is None:
        return "file"
    owner = package_at(target.files[0].parent, examination.workspace)
    if kind is Kind.MANIFEST and owner is not None:
        examine_package(owner, examination)
        return "package"
    examine_file(target.files, kind, examination)
    return kind_name(kind)
