"""The way in: from the words of a command line to a report."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.description.errors_as_warnings import strict
from gazelle.description.xml import remembering_documents
from gazelle.diagnostics import Diagnostic, Diagnostics
from gazelle.doctor.causes import causes_first
from gazelle.doctor.examine_file import examine_file, kind_name
from gazelle.doctor.examine_package import examine_folder, examine_package
from gazelle.doctor.file_kinds import Kind, kind_of
from gazelle.doctor.loose_scripts import check_loose_scripts
from gazelle.doctor.merged_findings import condensed
from gazelle.doctor.packages import check_environment
from gazelle.doctor.report import Examination, Options, Report
from gazelle.doctor.robots_and_worlds import without_superseded
from gazelle.doctor.target import Target, find_target, package_at
from gazelle.doctor.works_elsewhere import as_warnings_of_parts_elsewhere
from gazelle.documents.files import is_file, is_folder
from gazelle.simulator.plugins.user.finder import remembering_folders
from gazelle.workspace import Package, Workspace
from gazelle.workspace.environment_paths import BUILTIN

__all__ = ["examine"]

_OWN_FILES = f"{BUILTIN}{os.sep}"


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
        workspace: finds packages and models; made from the options' environment when None, and
            for a path then also from what is around that.
        options: choices of the caller.
        progress: told what is being looked at.
        cwd: what relative paths start from; the current folder when None.

    Raises:
        NotFoundError: nothing has the name given.
        GazelleError: there is nothing that can be examined.
    """
    options = options or Options()
    here = Path.cwd() if cwd is None else cwd
    found = Diagnostics()
    workspace = workspace or _workspace_of(argv, options, here, found)
    target = find_target(argv, workspace, here)
    examination = Examination(workspace, options, found)
    if progress is not None:
        examination.say = progress
    check_environment(options.environ, diagnostics=examination.diagnostics)
    with remembering_documents(), remembering_folders():
        kind = _examine(target, examination)
        for package in target.packages or _owners(target, kind, workspace):
            check_loose_scripts(package, examination.launch_topics, examination.diagnostics)
    examination.diagnostics.extend(workspace.diagnostics)
    findings, consequences = causes_first(_findings(examination))
    return Report(
        target=target.name,
        kind=kind,
        findings=findings,
        sections=tuple(examination.sections),
        consequences=consequences,
    )


def _owners(target: Target, kind: str, workspace: Workspace) -> tuple[Package, ...]:
    """Return the packages whose launch files are examined."""
    files = target.files if kind == "launch" else ()
    found = (package_at(file.parent, workspace) for file in files)
    return tuple(dict.fromkeys(package for package in found if package is not None))


def _workspace_of(
    argv: Sequence[str], options: Options, cwd: Path, diagnostics: Diagnostics
) -> Workspace:
    """Return the workspace of the current folder, or the target's own where that is another."""
    here = Workspace.discover(environ=options.environ, cwd=cwd)
    path = cwd / Path(argv[0]).expanduser() if argv else cwd
    folder = path.parent if is_file(path) else path
    if not is_folder(folder) or package_at(folder, here) is not None:
        return here
    around = Workspace.discover(environ=options.environ, cwd=folder)
    package = package_at(folder, around)
    if package is None:
        return here
    text = f"package '{package.name}' is in a workspace that is not in use in '{cwd}': it is "
    text += "examined as from its own folder"
    diagnostics.report("doctor.other-workspace", text, fix=f"cd {package.path}")
    return around


def _findings(examination: Examination) -> list[Diagnostic]:
    packages = examination.workspace.packages
    own = examination.workspace.user_packages
    known = {*packages, *(name for item in own for name in item.depends)}
    found = _once(map(_at_users_line, without_superseded(tuple(strict(examination.diagnostics)))))
    found = as_warnings_of_parts_elsewhere(found, (item.name for item in own))
    return condensed(found, known)


def _at_users_line(item: Diagnostic) -> Diagnostic:
    """Name the user's line that includes a file of Gazelle, in place of a line of that file."""
    span = item.span
    if span is None or not span.file.startswith(_OWN_FILES):
        return item
    outer = [place for place in span.via if not place.file.startswith(_OWN_FILES)]
    return replace(item, span=replace(outer[0], via=tuple(outer[1:]))) if outer else item


def _once(findings: Iterable[Diagnostic]) -> list[Diagnostic]:
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
