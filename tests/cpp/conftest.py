"""All tests of C++ share a cache."""

from __future__ import annotations

from tests.cpp.shared_cache import shared_cpp_cache  # noqa: F401 - a fixture
