"""Robots and worlds: what their readers do not say."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.description.checks import SUPERSEDED_CODES, check_description
from gazelle.description.loader import load_models
from gazelle.description.model import World
from gazelle.diagnostics import Diagnostic
from gazelle.doctor.examination import Examination
from gazelle.doctor.text_files import texts_known

__all__ = ["examine_models", "examine_text", "without_superseded"]


def examine_models(world: World, examination: Examination) -> None:
    """Check every model of a world that can move."""
    for model in world.models:
        if not model.static:
            check_description(model, diagnostics=examination.diagnostics)


def examine_text(text: str, files: Sequence[str], examination: Examination) -> None:
    """Read a robot description that no simulator of the launch loads, and check it.

    Args:
        text: of a parameter.
        files: files whose text may be in parameters.
        examination: takes the findings.
    """
    with texts_known(files):
        models = load_models(
            text, workspace=examination.workspace, diagnostics=examination.diagnostics
        )
    examine_models(World(models=models), examination)


def without_superseded(findings: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Leave out what readers say of mass and inertia: the checks say it with a block to paste."""
    return tuple(item for item in findings if item.code not in SUPERSEDED_CODES)
