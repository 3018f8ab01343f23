"""Kernels of these tests are compiled each time: it is the compiler that is tested."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import gazelle
from gazelle.kernels import dispatch, kept_code

_OWN = str(Path(gazelle.__file__).parent)


@pytest.fixture(scope="session", autouse=True)
def nothing_is_kept() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(kept_code._folders, Path(__file__).parent, None)
        yield


@pytest.fixture(autouse=True)
def nothing_is_left() -> Iterator[None]:
    """What says of itself that it is Gazelle's is not, for tests that come later."""
    yield
    dispatch._all[:] = [
        one for one in dispatch._all if one.source.function.__code__.co_filename.startswith(_OWN)
    ]
