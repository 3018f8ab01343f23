"""Test modules that are about the sample workspaces alone skip once where these are not there."""

from __future__ import annotations

from pathlib import Path

import pytest

__all__ = ["SHARED", "skip_module_without_shared"]

SHARED = Path(__file__).parents[2] / "shared"


def skip_module_without_shared() -> None:
    """Skip the module that calls this while it is imported, all of it in one."""
    if not SHARED.is_dir():
        pytest.skip(f"sample workspaces are not here ({SHARED})", allow_module_level=True)
