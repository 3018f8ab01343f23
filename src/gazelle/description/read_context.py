"""What every reader of a description needs to know besides the text."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.documents.files import exists
from gazelle.workspace.file_lookup import Resolved

if TYPE_CHECKING:
    from gazelle.diagnostics import Diagnostics, SourceSpan
    from gazelle.workspace import Workspace

__all__ = ["ReadContext"]


@dataclass(frozen=True, slots=True)
class ReadContext:
    """Where a text comes from, where its references are looked up, who hears of problems.

    Attributes:
        workspace: resolves ``package://`` and ``model://``; None for absolute and relative
            paths only.
        diagnostics: receives every finding.
        file: name for messages, the path as the user knows it or ``<robot_description>``.
        base_dir: folder that relative references start from, None when the text has no file.
        version: SDF version that decides between old and new meanings, ``(major, minor)``.
        include_chain: files being read, outermost first; finds cycles.
        in_world: the text is part of a world, which goes on without a broken model.
        inserts: robots take in the links and joints that stand in ``<gazebo>``; programs that know
            URDF only, such as planners and state publishers, leave them off.
        cache: files read so far, so that a model included a hundred times is read and reported
            once; shared by all contexts made from one.
    """

    workspace: Workspace | None
    diagnostics: Diagnostics
    file: str
    base_dir: Path | None = None
    version: tuple[int, int] = (1, 12)
    include_chain: tuple[Path, ...] = ()
    in_world: bool = False
    inserts: bool = True
    cache: dict[Hashable, Any] = field(default_factory=dict, compare=False, repr=False)

    def resolve(self, uri: str) -> Resolved:
        """Find the file or folder a URI means; without a workspace only plain paths are found."""
        if self.workspace is not None:
            # A building names its chair a hundred times, and a model that is missing as often.
            key = ("resolved", uri, self.base_dir)
            if key not in self.cache:
                self.cache[key] = self.workspace.resolve(uri, base_dir=self.base_dir)
            found: Resolved = self.cache[key]
            return found
        text = uri.strip().removeprefix("file://")
        if "://" in text:
            return Resolved(None, note="there is no workspace to look in")
        path = (self.base_dir or Path()) / text
        return Resolved(path if exists(path) else None, (str(path),))

    def report_note(self, uri: str, found: Resolved, span: SourceSpan, code: str) -> None:
        """Report how a file was found when it was not as written; each way of it once.

        Args:
            uri: as it was written.
            found: what it led to.
            span: where it was written.
            code: of a file that was found under another name.
        """
        if not found.note or not self.first_time("note", found.note):
            return
        if found.is_off_path:
            self.diagnostics.report("load.off-path", f"'{uri}' was {found.note}", span)
        elif found.is_stand_in:
            self.diagnostics.report("load.stand-in", f"'{uri}': {found.note}", span)
        else:
            known = found.right or "the names as the folders have them"
            fix = f"write {known}"
            self.diagnostics.report(code, f"'{uri}': {found.note}", span, fix=fix)

    def first_time(self, *key: Hashable) -> bool:
        """Tell whether this is asked for the first time, to report equal things once."""
        is_first = ("told", *key) not in self.cache
        self.cache["told", *key] = True
        return is_first

    def for_version(self, version: tuple[int, int]) -> ReadContext:
        """Return the same context for a document of this SDF version."""
        return replace(self, version=version)

    def for_file(self, path: Path) -> ReadContext:
        """Return the context of a file that this one includes."""
        chain = (*self.include_chain, path)
        return replace(self, file=str(path), base_dir=path.parent, include_chain=chain)
