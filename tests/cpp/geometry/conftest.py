"""C++'s geometry, compiled once a session."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.cpp.geometry.geometry_probe import GeometryProbe


@pytest.fixture(scope="session")
def geometry(tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path) -> GeometryProbe:
    """Functions of C++."""
    del shared_cpp_cache
    return GeometryProbe(tmp_path_factory.mktemp("geometry"))
