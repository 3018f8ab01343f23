"""What MuJoCo warns of, told with the names that the robot's files have."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.engine.mujoco_library import drained_warnings, mujoco

__all__ = ["report_library_warnings"]

_CODE = "engine.mujoco-warning"
_DOF = re.compile(r"\bat DOF (\d+)")
_QUOTED = re.compile(r"'([^'\n]+)'")


def report_library_warnings(
    world: World, diagnostics: Diagnostics, compiled_model: Any = None
) -> None:
    """Report what MuJoCo warned of since the last call.

    Args:
        world: whose models, links and joints MuJoCo's words are about.
        diagnostics: receives the findings.
        compiled_model: what was stepped; says which joint a number in MuJoCo's words means.
    """
    for warning in drained_warnings():
        words = " ".join(warning.split())
        what, span = _subject(words, world, compiled_model)
        diagnostics.report(_CODE, f"MuJoCo warns{what}: {words}", span)


def _subject(words: str, world: World, compiled_model: Any) -> tuple[str, SourceSpan | None]:
    """Return " of …" and the place of the part that some words are about, as far as they say."""
    for name in _names(words, compiled_model):
        model_name, _, rest = name.partition("::")
        model = world.model(model_name)
        if model is None or not rest:
            continue
        # Names of shapes begin with those of their links.
        joint = model.joint(rest)
        if joint is not None:
            return f" of joint '{rest}' of model '{model_name}'", joint.span
        link = model.link(rest) or model.link(rest.partition("::")[0])
        if link is not None:
            return f" of link '{link.name}' of model '{model_name}'", link.span
        return f" of model '{model_name}'", model.span
    return "", None


def _names(words: str, compiled_model: Any) -> Iterator[str]:
    yield from _QUOTED.findall(words)
    found = _DOF.search(words)
    if found is None or compiled_model is None or int(found[1]) >= compiled_model.nv:
        return
    dof = int(found[1])
    is_free = compiled_model.jnt_type[compiled_model.dof_jntid[dof]] == mujoco.mjtJoint.mjJNT_FREE
    if not is_free:
        yield compiled_model.joint(int(compiled_model.dof_jntid[dof])).name
    yield compiled_model.body(int(compiled_model.dof_bodyid[dof])).name
