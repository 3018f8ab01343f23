"""What a MJCF holds besides bodies, joints, shapes and constraints."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.engine.mjcf.mjcf_file import CompiledMjcf

__all__ = ["report_unsaid"]

_ELEMENTS = {
    "actuator": ("nu", "an effort limit is kept where they have one"),
    "sensor": ("nsensor", ""),
    "site": ("nsite", ""),
    "camera": ("ncam", ""),
    "light": ("nlight", ""),
    "tendon": ("ntendon", ""),
    "keyframe": ("nkey", ""),
    "contact pair": ("npair", "the geoms' own friction counts"),
    "contact exclusion": ("nexclude", "URDF and SDF only know it for whole models"),
    "mocap body": ("nmocap", "it stands still"),
    "flexible body": ("nflex", ""),
    "skin": ("nskin", ""),
}


def report_unsaid(mjcf: CompiledMjcf, diagnostics: Diagnostics) -> None:
    """Report what has no place in a `World`, each kind once, with the place of the first."""
    model: Any = mjcf.model
    for word, (counter, note) in _ELEMENTS.items():
        count = int(getattr(model, counter))
        if count:
            plural = word if count == 1 else _plural(word)
            message = f"{count} {plural} of the file {'is' if count == 1 else 'are'} left out"
            message += f"; {note}" if note else ""
            diagnostics.report("convert.left-out", message, mjcf.source.root.span)
    _report_dynamics(mjcf, diagnostics)
    for old, new in mjcf.renamed:
        message = f"joint '{old}' is called '{new}', for a body has its name"
        diagnostics.report("convert.renamed", message, mjcf.source.span("joint", old))


def _report_dynamics(mjcf: CompiledMjcf, diagnostics: Diagnostics) -> None:
    model: Any = mjcf.model
    armatures = [
        mjcf.joints[index]
        for index in range(model.njnt)
        if model.dof_armature[int(model.jnt_dofadr[index])] > 0
    ]
    if armatures:
        shown = ", ".join(f"'{name}'" for name in armatures[:5])
        more = f" and {len(armatures) - 5} more" if len(armatures) > 5 else ""
        message = f"armature of joints {shown}{more} has no word in URDF and SDF"
        span = mjcf.source.span("joint", armatures[0])
        diagnostics.report("convert.left-out", message, span)
    partly = np.flatnonzero((model.body_gravcomp > 0) & (model.body_gravcomp < 1))
    for body in partly:
        name = mjcf.bodies[int(body)]
        message = f"body '{name}' feels a part of gravity only; in URDF and SDF it feels all of it"
        diagnostics.report("convert.left-out", message, mjcf.source.span("body", name))


def _plural(word: str) -> str:
    return f"{word[:-1]}ies" if word.endswith("y") else f"{word}s"
