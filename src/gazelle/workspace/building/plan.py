"""What building a package will put below its install prefix."""

from __future__ import annotations

import os
import posixpath
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.documents.files import exists, is_folder
from gazelle.workspace.building.install_rules import InstallRule

__all__ = ["EnvironmentHook", "Item", "Layout", "Plan", "add_rules", "site_packages"]

_MARKER = "COLCON_IGNORE"
_PRUNED = frozenset({"__pycache__", ".git"})


class Item(NamedTuple):
    """One file of the install tree.

    Attributes:
        target: where, relative to the prefix.
        source: the file or folder copied, or linked to; None for text that is written.
        text: what is written when there is no source.
        is_program: gets the executable bit.
    """

    target: str
    source: Path | None = None
    text: str = ""
    is_program: bool = False


class EnvironmentHook(NamedTuple):
    """A value that sourcing the package puts in front of a variable.

    Attributes:
        name: of the hook's files.
        variable: such as ``PYTHONPATH``.
        value: a path relative to the prefix, empty for the prefix itself.
    """

    name: str
    variable: str
    value: str


class Layout(NamedTuple):
    """Where the parts of a package go.

    Attributes:
        prefix: install prefix.
        python: folder of Python modules, relative to it.
        symlinks: link to the sources in place of copying them.
    """

    prefix: Path
    python: str
    symlinks: bool = False


@dataclass(slots=True)
class Plan:
    """Everything one package installs.

    Attributes:
        items: by target; a later rule for the same target replaces an earlier one.
        scripts: shell files to be sourced, relative to the prefix.
        diagnostics: what was found on the way; an error stops the build of the package.
    """

    items: dict[str, Item] = field(default_factory=dict)
    scripts: list[str] = field(default_factory=list)
    diagnostics: Diagnostics = field(default_factory=Diagnostics)

    def add(self, item: Item, span: SourceSpan | None = None) -> None:
        """Keep an item; one that would leave the prefix is reported and left out."""
        target = posixpath.normpath(item.target.lstrip("/"))
        if target.startswith(".."):
            text = f"'{item.target}' lies outside of the install folder; it is left out"
            self.diagnostics.report("package.install-place", text, span)
            return
        self.items[target] = item._replace(target=target)

    def write(self, target: str, text: str = "", *, is_program: bool = False) -> None:
        """Keep a text that is written to a target."""
        self.add(Item(target, None, text, is_program))

    def has_below(self, folder: str) -> bool:
        """Tell whether something is installed below a folder of the prefix."""
        return any(target.startswith(folder + "/") for target in self.items)


def site_packages() -> str:
    """Return setuptools' folder of modules below a prefix, for the Python that runs."""
    version = sys.version_info
    return f"lib/python{version.major}.{version.minor}/site-packages"


def add_rules(
    plan: Plan,
    folder: Path,
    rules: Iterable[InstallRule],
    failure: str,
    made: Mapping[str, str] | None = None,
) -> None:
    """Put what install rules name into a plan.

    Args:
        plan: receives items and findings.
        folder: of the package.
        rules: of its build file.
        failure: what the real build prints for a file that is not there, with ``{path}``.
        made: texts that the build file writes by itself, by their places.
    """
    for rule in rules:
        texts = {} if made is None else rule.texts(made)
        for target, text in texts.items():
            plan.add(Item(target, None, text, rule.is_program), rule.span)
        if texts and not (rule.is_folder and rule.is_known):
            continue
        if not rule.is_known or "$<" in rule.source + rule.destination:
            text = f"'{rule.source}' is made or placed by the real build only; it is left out"
            plan.diagnostics.report("package.install-unread", text, rule.span)
            continue
        source = folder / rule.source
        if not exists(source) or (is_folder(source) and not rule.is_folder):
            _report_missing(plan, source, rule, failure)
        elif not rule.is_folder:
            name = rule.renamed or source.name
            plan.add(Item(f"{rule.destination}/{name}", source, "", rule.is_program), rule.span)
        else:
            _add_folder(plan, folder, rule)


def _add_folder(plan: Plan, folder: Path, rule: InstallRule) -> None:
    for file in _files_below(folder / rule.source):
        target = rule.target(os.path.relpath(file, folder).replace(os.sep, "/"))
        if target is not None:
            keeps_bit = rule.is_program and os.access(file, os.X_OK)
            plan.add(Item(target, file, "", keeps_bit), rule.span)


def _files_below(top: Path) -> Iterator[Path]:
    """Yield files in order of path; links are followed, each folder once."""
    seen: set[str] = set()
    for root, folders, names in os.walk(top, followlinks=True):
        real = os.path.realpath(root)
        if real in seen or (_MARKER in names and Path(root) != top):
            folders.clear()
            continue
        seen.add(real)
        folders[:] = sorted(name for name in folders if name not in _PRUNED)
        yield from (Path(root, name) for name in sorted(names))


def _report_missing(plan: Plan, source: Path, rule: InstallRule, failure: str) -> None:
    if rule.is_optional:
        return
    state = "is a folder, and a file is wanted" if exists(source) else "does not exist"
    text = f"'{rule.source}' is to be installed and {state} ({failure.format(path=source)})"
    if rule.is_conditional:
        text = f"'{rule.source}' {state}; its rule stands in an if() and is left out"
        plan.diagnostics.report("package.install-unread", text, rule.span)
        return
    beside = [item.name for item in source.parent.iterdir()] if is_folder(source.parent) else []
    fix = did_you_mean(source.name, beside)
    plan.diagnostics.report("package.install-missing", text, rule.span, fix=fix)
