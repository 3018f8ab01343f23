"""Robots and worlds: what their readers do not say, and the files that texts came from."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from gazelle.description.checks import SUPERSEDED_CODES, check_description
from gazelle.description.checks.source_elements import CheckedSource
from gazelle.description.loader import load_models
from gazelle.description.model import World
from gazelle.description.robot_description import TEXT_FILES_VARIABLE
from gazelle.diagnostics import Diagnostic
from gazelle.doctor.report import Examination

__all__ = ["examine_models", "examine_text", "texts_known", "without_superseded"]


@contextmanager
def texts_known(files: Sequence[str]) -> Iterator[None]:
    """Let readers find the files that parameters' texts came from, as a launcher does."""
    before = os.environ.get(TEXT_FILES_VARIABLE)
    os.environ[TEXT_FILES_VARIABLE] = os.pathsep.join(dict.fromkeys(files))
    try:
        yield
    finally:
        if before is None:
            del os.environ[TEXT_FILES_VARIABLE]
        else:
            os.environ[TEXT_FILES_VARIABLE] = before


def examine_models(world: World, examination: Examination) -> None:
    """Check every model of a world that can move."""
    source = CheckedSource()
    for model in world.models:
        if not model.static:
            check_description(model, diagnostics=examination.diagnostics, source=source)


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
