"""What installing a package puts where."""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from gazelle.diagnostics import SourceSpan
from gazelle.workspace.building.cmake_lists import CMakeLists, Step

__all__ = ["InstallRule", "InstallRules", "cmake_rules"]

_KEYWORDS = frozenset(
    {
        "CODE", "COMPONENT", "CONFIGURATIONS", "DESTINATION", "DIRECTORY", "DIRECTORY_PERMISSIONS",
        "EXCLUDE", "EXCLUDE_FROM_ALL", "FILES", "FILES_MATCHING", "FILE_PERMISSIONS",
        "MESSAGE_NEVER", "OPTIONAL", "PATTERN", "PERMISSIONS", "PROGRAMS", "REGEX", "RENAME",
        "SCRIPT", "TARGETS", "TYPE", "USE_SOURCE_PERMISSIONS",
    }
)  # fmt: skip
_SHARED_BY_AUTO = "INSTALL_TO_SHARE"


@dataclass(frozen=True, slots=True)
class InstallRule:
    """One source that is installed.

    Attributes:
        source: file or folder relative to the package, ``.`` for its own folder; may hold a
            variable that is not known.
        destination: folder below the prefix; may hold a variable that is not known.
        is_folder: everything below the source is meant.
        keeps_name: the folder itself goes there, not only what is in it.
        renamed: new name of a file, empty when it keeps its own.
        is_program: installed with the executable bit.
        matching: patterns of names, one of which a file must match; all when empty.
        excluded: patterns of names that are left out.
        is_optional: a missing source is no mistake.
        is_conditional: the rule stands in an ``if``, which is not decided here.
        span: where the rule stands.
    """

    source: str
    destination: str
    is_folder: bool
    span: SourceSpan
    keeps_name: bool = False
    renamed: str = ""
    is_program: bool = False
    matching: tuple[re.Pattern[str], ...] = ()
    excluded: tuple[re.Pattern[str], ...] = ()
    is_optional: bool = False
    is_conditional: bool = False

    @property
    def is_known(self) -> bool:
        """False when a variable in it has no known value."""
        return "${" not in self.source + self.destination

    def texts(self, made: Mapping[str, str]) -> dict[str, str]:
        """Return the texts that the build file writes and this rule installs, by their targets.

        Args:
            made: those of `CMakeLists.made`.
        """
        below_build = self.source.startswith("${")
        found = {
            self.target(relative): text
            for relative, text in made.items()
            if relative.startswith("${") is below_build
        }
        return {target: text for target, text in found.items() if target is not None}

    def target(self, relative: str) -> str | None:
        """Return where a file of the package goes below the prefix, None when not by this rule."""
        if not self.is_folder:
            name = self.renamed or PurePosixPath(relative).name
            return f"{self.destination}/{name}" if relative == self.source else None
        path = PurePosixPath(relative)
        inside = path if self.source == "." else _below(path, self.source)
        if inside is None or any(p.search(f"/{relative}") for p in self.excluded):
            return None
        if self.matching and not any(p.search(f"/{relative}") for p in self.matching):
            return None
        name = f"{PurePosixPath(self.source).name}/" if self.keeps_name else ""
        return f"{self.destination}/{name}{inside}"


@dataclass(frozen=True, slots=True)
class InstallRules:
    """Everything a package installs.

    Attributes:
        rules: in the order of the files.
        unread: places of commands that may install more than was read.
    """

    rules: tuple[InstallRule, ...] = ()
    unread: tuple[SourceSpan, ...] = ()

    def targets(self, relative: str) -> tuple[str, ...]:
        """Return every place below the prefix that a file of the package goes to."""
        found = (rule.target(relative) for rule in self.rules)
        return tuple(item.lstrip("/") for item in found if item is not None)

    def may_install(self, relative: str) -> bool:
        """Tell whether a rule that could not be read in full may be for this file."""
        top = relative.partition("/")[0]
        open_rules = (rule for rule in self.rules if not rule.is_known)
        return any("${" in rule.source or rule.source.startswith(top) for rule in open_rules)


def cmake_rules(lists: CMakeLists, share: str) -> InstallRules:
    """Return the rules of a ``CMakeLists.txt``.

    Args:
        lists: the file.
        share: the package's share folder below the prefix, such as ``share/my_robot``.
    """
    root = str(lists.file.parent)
    rules: list[InstallRule] = []
    for step in lists.called("install", "catkin_install_python", "ament_auto_package"):
        if step.name == "ament_auto_package":
            sources = step.after(_SHARED_BY_AUTO, ("INSTALL_TO_PATH",))
            rules += _folders(sources, share, step, root)
        else:
            rules += _rules_of(step, root)
    scripts = [
        step for step in lists.called("install") if step.arguments[:1] in {("CODE",), ("SCRIPT",)}
    ]
    return InstallRules(tuple(rules), tuple(step.span for step in (*lists.hidden, *scripts)))


def _rules_of(step: Step, root: str) -> Iterator[InstallRule]:
    destination = "".join(step.after("DESTINATION", _KEYWORDS)[:1]).strip("/")
    if step.arguments[:1] == ("DIRECTORY",):
        yield from _folders(step.after("DIRECTORY", _KEYWORDS), destination, step, root)
        return
    kind = next((argument for argument in ("PROGRAMS", "FILES") if argument in step.arguments), "")
    if step.name == "install" and step.arguments[:1] != (kind,):
        return
    renamed = "".join(step.after("RENAME", _KEYWORDS)[:1])
    for argument in step.after(kind, _KEYWORDS):
        yield InstallRule(
            _relative(argument, step.folder, root),
            destination,
            False,
            step.span,
            renamed=renamed,
            is_program=kind == "PROGRAMS",
            is_optional="OPTIONAL" in step.arguments,
            is_conditional=step.is_conditional,
        )


def _folders(
    sources: Sequence[str], destination: str, step: Step, root: str
) -> Iterator[InstallRule]:
    matching, excluded = _patterns(step.arguments)
    for argument in sources:
        yield InstallRule(
            _relative(argument, step.folder, root),
            destination,
            True,
            step.span,
            keeps_name=not argument.endswith("/") and _relative(argument, step.folder, root) != ".",
            matching=matching,
            excluded=excluded,
            is_program="USE_SOURCE_PERMISSIONS" in step.arguments,
            is_optional="OPTIONAL" in step.arguments,
            is_conditional=step.is_conditional,
        )


def _patterns(
    arguments: Sequence[str],
) -> tuple[tuple[re.Pattern[str], ...], tuple[re.Pattern[str], ...]]:
    matching: list[re.Pattern[str]] = []
    excluded: list[re.Pattern[str]] = []
    makers: dict[str, Callable[[str], re.Pattern[str] | None]] = {
        "PATTERN": _of_glob,
        "REGEX": _of_regex,
    }
    for index, argument in enumerate(arguments[:-1]):
        made = makers[argument](arguments[index + 1]) if argument in makers else None
        if made is not None:
            is_out = arguments[index + 2 : index + 3] == ("EXCLUDE",)
            (excluded if is_out else matching).append(made)
    return (tuple(matching) if "FILES_MATCHING" in arguments else ()), tuple(excluded)


def _of_glob(text: str) -> re.Pattern[str]:
    body = fnmatch.translate(text).removesuffix(r"\Z").removesuffix(r"\z")
    return re.compile(rf"/(?:{body})(?=/|$)")


def _of_regex(text: str) -> re.Pattern[str] | None:
    try:
        return re.compile(text)
    except re.error:
        return None


def _relative(argument: str, folder: str, root: str) -> str:
    """Return a source relative to the package, without a slash at its end."""
    text = argument.rstrip("/") or "."
    if text.startswith(root):
        return text[len(root) :].lstrip("/") or "."
    if text.startswith(("/", "${")):
        return text
    return (PurePosixPath(folder) / text).as_posix()


def _below(path: PurePosixPath, folder: str) -> PurePosixPath | None:
    try:
        return path.relative_to(folder)
    except ValueError:
        return None
