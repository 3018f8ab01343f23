"""All checks of one model that has been read."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from gazelle.description.checks.camera_frames import check_cameras
from gazelle.description.checks.contact_parameters import check_surfaces
from gazelle.description.checks.inertia import check_inertia, check_mass_ratios
from gazelle.description.checks.kinematic_tree import check_joints, check_root
from gazelle.description.checks.lumped_links import check_lumping, check_preserved
from gazelle.description.checks.self_collisions import check_overlaps
from gazelle.description.checks.shape_sizes import check_sizes
from gazelle.description.checks.shape_volumes import Outlines
from gazelle.description.checks.source_elements import CheckedSource, links_below
from gazelle.description.checks.support_plane import check_support_plane
from gazelle.description.checks.wheels import check_wheel_shapes, check_wheels
from gazelle.description.checks.written_inertials import joint_records_of, records_of
from gazelle.description.model import Model
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.documents.files import is_file

__all__ = ["check_description"]


def check_description(
    model: Model,
    *,
    diagnostics: Diagnostics,
    root: Tag | None = None,
    source: CheckedSource | None = None,
    step_s: float = 1e-3,
) -> None:
    """Report everything that is suspicious about a model, none of which a reader says.

    What readers say of links' mass and inertia (`SUPERSEDED_CODES`) is said again here, with the
    place of the number and a block to paste: leave out theirs.

    Args:
        model: as a reader made it.
        diagnostics: receives the findings; what is wrong with mesh files is left to the engine.
        root: the element it was read from, after xacro; the files are read again when None.
        source: finds elements where there is no root; one for all models of a world looks
            through each of their files once.
        step_s: of the physics.
    """
    # Numbers out of this world overflow; comparisons with what comes out are false.
    with np.errstate(all="ignore"):
        if root is not None or source is None:
            source = CheckedSource((model,), {} if root is None else links_below(root))
        _check(model, diagnostics, root, source, step_s)


def _check(
    model: Model, diagnostics: Diagnostics, root: Tag | None, source: CheckedSource, step_s: float
) -> None:
    discarded = Diagnostics()
    records = records_of((model,), source.find_tag, discarded)
    for finding in check_inertia(records):
        item = finding.diagnostic
        harmless = finding.is_placeholder
        diagnostics.add(replace(item, severity=Severity.INFO) if harmless else item)
    diagnostics.extend(check_mass_ratios(joint_records_of((model,), source.find_tag)))
    outlines = Outlines(model)
    check_sizes(model, outlines, diagnostics)
    if model.static:
        return
    check_root(model, diagnostics)
    check_preserved(model, diagnostics)
    check_lumping(model, diagnostics, root=_root_of(model) if root is None else root)
    check_joints(model, diagnostics)
    check_cameras(model, diagnostics)
    check_wheels(model, diagnostics)
    check_wheel_shapes(model, diagnostics)
    check_surfaces(model, outlines, diagnostics, step_s=step_s)
    check_support_plane(model, outlines, diagnostics)
    check_overlaps(model, outlines, diagnostics)


def _root_of(model: Model) -> Tag | None:
    """Return the ``<robot>`` of a model's file; None when xacro makes it."""
    if model.source_format != "urdf" or model.span is None:
        return None
    path = Path(model.span.file)
    root = read_xml(path, Diagnostics()) if is_file(path) else None
    if root is None or root.name != "robot":
        return None
    return None if any(tag.name.startswith("xacro:") for tag in root.walk()) else root
