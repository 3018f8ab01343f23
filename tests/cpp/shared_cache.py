"""One cache of compiled C++ for all sessions of tests: to fill it takes minutes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

__all__ = ["shared_cpp_cache"]

_FOLDER = Path(__file__).parents[2] / ".pytest_cache" / "cache_home"


@pytest.fixture(scope="session", autouse=True)
def shared_cpp_cache(own_folders: None) -> Iterator[Path]:
    """The cache lies beside pytest's own, not in the folders that the session throws away."""
    _FOLDER.mkdir(parents=True, exist_ok=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(_FOLDER))
        yield _FOLDER
