"""Tests about the sample workspaces skip once for each module where these are not there."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

__all__ = ["SHARED", "needs_shared", "shared_cases", "skip_module_without_shared"]

SHARED = Path(__file__).parents[2] / "shared"
_REASON = f"sample workspaces are not here ({SHARED})"
# In a module's globals: it has a test that skips for all of its tests.
_TOLD = "_told_without_shared"


def skip_module_without_shared() -> None:
    """Skip the module that calls this while it is imported, all of it in one."""
    if not SHARED.is_dir():
        pytest.skip(_REASON, allow_module_level=True)


def needs_shared(test: Callable[..., Any]) -> Callable[..., Any] | None:
    """Decorate a test, above all other decorators, that only the sample workspaces can serve.

    Where they are not there, a module's first such test skips, and pytest sees no others.
    """
    if SHARED.is_dir():
        return test
    if _is_told(test.__globals__):
        return None

    @pytest.mark.skip(reason=f"{_REASON}, as for all tests of this file that are about them")
    def skipped() -> None:
        raise AssertionError("skipped")

    return skipped


def shared_cases(*cases: Any) -> list[Any]:
    """Return parametrized cases over the sample workspaces, to stand beside cases of our own.

    Where the workspaces are not there, it is none: our own cases show the same then.
    """
    return list(cases) if SHARED.is_dir() else []


def _is_told(module: dict[str, Any]) -> bool:
    """Tell whether a module has a skipping test already; from now on it has."""
    told = module.get(_TOLD, False)
    module[_TOLD] = True
    return told
