"""The one place that imports MuJoCo, and refuses releases that compute wrong results."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from gazelle.errors import EngineError

__all__ = ["check_version", "compiled", "drained_warnings", "keep_warnings", "mujoco"]

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
