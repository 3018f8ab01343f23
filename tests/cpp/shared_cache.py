"""One cache of compiled C++ for all sessions of tests: to fill it takes minutes."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

__all__ = ["shared_cpp_cache"]


@pytest.fixture(scope="session", autouse=True)
def shared_cpp_cache(own_folders: None) -> Path:
    """Where it lies; variables of the environment name it in every test."""
    del own_folders
    return Path(os.environ["GAZELLE_CPP_CACHE"])
