"""Kernels of these tests are compiled each time: it is the compiler that is tested."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from gazelle.kernels import kept_code


@pytest.fixture(scope="session", autouse=True)
def nothing_is_kept() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(kept_code._folders, Path(__file__).parent, None)
        yield
