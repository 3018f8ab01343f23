"""Robots and worlds: what their readers do not say, and the files that texts came from."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from gazelle.description.checks import SUPERSEDED_CODES, check_description
from gazelle.description.checks.source_elements import CheckedSource
from gazelle.description.loader import load_models
from gazelle.description.model import Model, PluginTag, World
from gazelle.description.robot_description import TEXT_FILES_VARIABLE
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostic, Diagnostics
from gazelle.doctor.packages.dependency_checks import is_slip
from gazelle.doctor.report import Examination

__all__ = [
    "examine_models",
    "examine_text",
    "frame_slip",
    "frame_tag",
    "texts_known",
    "without_superseded",
]

_FRAME_KEYS = ("frameName", "frame_name", "frameId", "frame_id")


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
            _check_frame_names(model, examination.diagnostics)


def frame_tag(plugin: PluginTag) -> Tag | None:
    """Return where a plug-in names the frame that it stamps with, None when it does not."""
    found = (plugin.parameters.find(key) for key in _FRAME_KEYS)
    return next((tag for tag in found if tag is not None), None)


def frame_slip(name: str, model: Model) -> str:
    """Return the link of a robot that a frame's name is a slip for, empty when there is none."""
    links = [link.name for link in model.links]
    return "" if name in links else next((one for one in links if is_slip(name, one)), "")


def _check_frame_names(model: Model, diagnostics: Diagnostics) -> None:
    """Report frames of plug-ins that are nearly links; others may come from other nodes."""
    of_sensors = [item for link in model.links for one in link.sensors for item in one.plugins]
    for plugin in (*model.plugins, *of_sensors):
        tag = frame_tag(plugin)
        name = tag.text.strip().lstrip("/") if tag is not None else ""
        slip = frame_slip(name, model) if name else ""
        if tag is not None and slip:
            text = f"plug-in '{plugin.name}' stamps its data with frame '{name}', which is no link "
            text += "of the robot"
            hint = f"did you mean '{slip}'?"
            diagnostics.report("doctor.sensor-frame", text, tag.span, fix=hint)


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
