"""A spec as XML with every digit: MuJoCo's writer keeps six unless it is told otherwise."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from gazelle.engine.mujoco_library import mujoco
from gazelle.errors import EngineError

__all__ = ["exact_xml"]

_EXACT_DIGITS = 17
_SETTER = "_mjPRIVATE__set_xml_precision"
_GETTER = "_mjPRIVATE__get_xml_precision"


def exact_xml(spec: Any) -> str:
    """Return the XML of a compiled spec; its numbers are read back as the same.

    Raises:
        EngineError: MuJoCo cannot write the spec.
    """
    with _all_digits():
        try:
            return str(spec.to_xml())
        except ValueError as error:
            raise EngineError(f"MuJoCo cannot write the world: {error}") from error


@contextmanager
def _all_digits() -> Iterator[None]:
    """Set the writer's digits for a while; MuJoCo exports the setting without a header for it.

    A library without it writes six digits, which is a description still, only not an exact one.
    """
    library = _library()
    if library is None:
        yield
        return
    before = getattr(library, _GETTER)()
    getattr(library, _SETTER)(_EXACT_DIGITS)
    try:
        yield
    finally:
        getattr(library, _SETTER)(before)


def _library() -> Any:
    for path in sorted(Path(mujoco.__file__).parent.glob("*mujoco*")):
        if path.name.startswith(("libmujoco", "mujoco.dll")):
            library = ctypes.CDLL(str(path))
            if hasattr(library, _SETTER) and hasattr(library, _GETTER):
                return library
    return None
