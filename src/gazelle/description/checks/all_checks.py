"""All checks of one model that has been read."""

from __future__ import annotations

from gazelle.description.checks.inertia import check_inertia, check_mass_ratios
from gazelle.description.checks.inertia_records import joint_records_of, records_of
from gazelle.description.checks.inertia_source import CheckedSource, links_below
from gazelle.description.model import Model
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics

__all__ = ["check_description"]


def check_description(
    model: Model,
    *,
    diagnostics: Diagnostics,
    root: Tag | None = None,
) -> None:
    """Report everything that is suspicious about a model, none of which a reader says.

    What readers say of links' mass and inertia (`SUPERSEDED_CODES`) is said again here, with the
    place of the number and a block to paste: leave out theirs.

    Args:
        model: as a reader made it.
        diagnostics: receives the findings; what is wrong with mesh files is left to the engine.
        root: the element it was read from, after xacro; the links' files are read again when None.
    """
    unheard = Diagnostics()
    source = CheckedSource((model,), {} if root is None else links_below(root))
    records = records_of((model,), source.find_tag, unheard)
    for finding in check_inertia(records):
        diagnostics.add(finding.diagnostic)
    diagnostics.extend(check_mass_ratios(joint_records_of((model,), source.find_tag)))
