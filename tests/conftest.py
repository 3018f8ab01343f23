"""Fixtures of all tests: where the sample workspaces and recorded outputs are."""

from __future__ import annotations

from pathlib import Path

import pytest

_SHARED = Path(__file__).parents[2] / "shared"


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """The folder with sample workspaces and recorded outputs of real programs."""
    if not _SHARED.is_dir():
        pytest.skip(f"sample workspaces are not here ({_SHARED})")
    return _SHARED


@pytest.fixture(scope="session")
def workspaces_dir(shared_dir: Path) -> Path:
    """The documents' own packages, unmodified."""
    return shared_dir / "workspaces"


@pytest.fixture(scope="session")
def oracles_dir(shared_dir: Path) -> Path:
    """Recorded outputs of real ROS and Gazebo programs."""
    return shared_dir / "oracles"
