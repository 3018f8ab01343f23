"""Which packages of a workspace a command is for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from gazelle.diagnostics import did_you_mean
from gazelle.workspace.building.packages import SourcePackage, needed_by

__all__ = ["Selection", "select"]


@dataclass(frozen=True, slots=True)
class Selection:
    """The options of colcon that choose packages; empty ones choose nothing away.

    Attributes:
        only: ``--packages-select``.
        up_to: ``--packages-up-to``: these and what they need.
        above: ``--packages-above``: these and what needs them.
        skip: ``--packages-skip``.
        ignore: ``--packages-ignore``: as if they were not there.
    """

    only: tuple[str, ...] = ()
    up_to: tuple[str, ...] = ()
    above: tuple[str, ...] = ()
    skip: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()


def select(
    packages: Sequence[SourcePackage], selection: Selection
) -> tuple[tuple[SourcePackage, ...], tuple[str, ...]]:
    """Return the packages chosen, in the given order, and what to warn of.

    Args:
        packages: all of the workspace.
        selection: what the command line says.
    """
    here = [item for item in packages if item.name not in selection.ignore]
    names = {item.name for item in here}
    if selection.only:
        names &= set(selection.only)
    if selection.up_to:
        names &= needed_by(selection.up_to, here)
    if selection.above:
        wanted = set(selection.above)
        names &= {item.name for item in here if needed_by([item.name], here) & wanted}
    names -= set(selection.skip)
    return tuple(item for item in here if item.name in names), _unknown(packages, selection)


def _unknown(packages: Sequence[SourcePackage], selection: Selection) -> tuple[str, ...]:
    known = [item.name for item in packages]
    warnings = []
    for option, names in (
        ("--packages-select", selection.only),
        ("--packages-up-to", selection.up_to),
        ("--packages-above", selection.above),
        ("--packages-skip", selection.skip),
        ("--packages-ignore", selection.ignore),
    ):
        for name in names:
            if name not in known:
                hint = did_you_mean(name, known)
                text = f"ignoring unknown package '{name}' in {option}"
                warnings.append(f"{text}; {hint}" if hint else text)
    return tuple(warnings)
