"""MuJoCo: imported here only, not in releases that compute wrong results; and what it warns of."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import EngineError

__all__ = [
    "check_version",
    "compiled",
    "drained_warnings",
    "keep_warnings",
    "mujoco",
    "report_library_warnings",
]


_OLDEST = (4, 0, 1)
_warnings: list[str] = []


def check_version(version: str) -> None:
    """Refuse a MuJoCo release that is too old or known to be wrong.

    MuJoCo 4.0.0 factorises sparse matrices wrongly (its issue 3767, fixed in 4.0.1), which gives
    wrong accelerations with more than 60 degrees of freedom.

    Raises:
        EngineError: the release cannot be used; the message says what to install.
    """
    if version.startswith("4.0.0"):
        raise EngineError(
            "MuJoCo 4.0.0 computes wrong accelerations (a sparse factorisation error, fixed in"
            " 4.0.1); install a correct release: pip install 'mujoco-core>=4.0.1'"
        )
    if _numbers(version) < _OLDEST:
        raise EngineError(
            f"MuJoCo {version} is too old, at least 4.0.1 is needed:"
            " pip uninstall -y mujoco && pip install 'mujoco-core>=4.0.1'"
        )


def drained_warnings() -> tuple[str, ...]:
    """Return what MuJoCo warned of since the last call; it would write a file instead."""
    if not _warnings:
        return ()
    found = tuple(dict.fromkeys(_warnings))
    _warnings.clear()
    return found


@contextmanager
def keep_warnings() -> Iterator[None]:
    """Keep what MuJoCo warns of inside for `drained_warnings`.

    Reading and compiling warn by Python's ``warnings`` and not by the function for warnings.
    """
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        try:
            yield
        finally:
            _warnings.extend(str(item.message) for item in found)


def compiled(spec: Any) -> Any:
    """Return a spec's model; what MuJoCo warns of is kept for `drained_warnings`.

    Raises:
        ValueError: MuJoCo refuses the spec.
    """
    with keep_warnings():
        return spec.compile()


def _numbers(version: str) -> tuple[int, ...]:
    parts = version.split(".")[:3]
    return tuple(int("".join(c for c in part if c.isdigit()) or 0) for part in parts)


def _load() -> Any:
    try:
        import mujoco as library
    except ImportError as error:
        raise EngineError(
            f"MuJoCo cannot be imported ({error}); install it: pip install 'mujoco-core>=4.0.1'"
        ) from error
    check_version(str(library.__version__))
    library.set_mju_user_warning(_warnings.append)
    return library


mujoco: Any = _load()
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
        text = " ".join(warning.split())
        what, span = _subject(text, world, compiled_model)
        diagnostics.report(_CODE, f"MuJoCo warns{what}: {text}", span)


def _subject(text: str, world: World, compiled_model: Any) -> tuple[str, SourceSpan | None]:
    """Return " of …" and the place of the part that some words are about, as far as they say."""
    for name in _names(text, compiled_model):
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


def _names(text: str, compiled_model: Any) -> Iterator[str]:
    yield from _QUOTED.findall(text)
    found = _DOF.search(text)
    if found is None or compiled_model is None or int(found[1]) >= compiled_model.nv:
        return
    dof = int(found[1])
    is_free = compiled_model.jnt_type[compiled_model.dof_jntid[dof]] == mujoco.mjtJoint.mjJNT_FREE
    if not is_free:
        yield compiled_model.joint(int(compiled_model.dof_jntid[dof])).name
    yield compiled_model.body(int(compiled_model.dof_bodyid[dof])).name
