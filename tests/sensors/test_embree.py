"""Finding and loading the library, and what is said when that fails."""

from __future__ import annotations

import importlib.machinery
import importlib.util

import numpy as np
import pytest

from gazelle.errors import GazelleError
from gazelle.sensors import EmbreeError
from gazelle.sensors.embree import PACKET_BYTES, find_library, library, packet_buffer


@pytest.fixture
def wheel_at(monkeypatch):
    """Pretends that the embreex package lies in a folder, or nowhere."""

    def pretend(folder) -> None:
        spec = None
        if folder is not None:
            origin = folder / "embreex" / "__init__.py"
            origin.parent.mkdir(exist_ok=True)
            spec = importlib.machinery.ModuleSpec("embreex", None, origin=str(origin))
        monkeypatch.setattr(importlib.util, "find_spec", lambda name: spec)

    return pretend


def test_library_of_the_wheel_is_found_and_loads() -> None:
    path, first = find_library()
    assert "embree4" in path.name
    assert all("tbb" in item.name for item in first)
    assert library().path == path


def test_missing_wheel_is_told_with_the_command_that_helps(wheel_at) -> None:
    wheel_at(None)
    with pytest.raises(EmbreeError, match=r"pip install 'embreex>=4\.4'") as raised:
        find_library()
    assert isinstance(raised.value, GazelleError)


def test_wheel_without_a_library_is_told_with_the_places(wheel_at, tmp_path) -> None:
    wheel_at(tmp_path)
    with pytest.raises(EmbreeError, match="carries no Embree 4 library") as raised:
        find_library()
    assert str(tmp_path / "embreex.libs") in str(raised.value)


@pytest.mark.parametrize(
    ("folder", "name"),
    [
        ("embreex.libs", "libembree4-4aef3270.so.4"),
        ("embreex/.dylibs", "libembree4.4.dylib"),
        ("embreex.libs", "embree4-0fb1c6.dll"),
    ],
)
def test_wheels_of_every_platform_are_known(wheel_at, tmp_path, folder, name) -> None:
    wheel_at(tmp_path)
    (tmp_path / folder).mkdir(exist_ok=True)
    (tmp_path / folder / name).touch()
    assert find_library()[0] == tmp_path / folder / name


def test_broken_library_is_told_as_such(wheel_at, tmp_path) -> None:
    wheel_at(tmp_path)
    (tmp_path / "embreex.libs").mkdir()
    (tmp_path / "embreex.libs" / "libembree4.so").write_text("not a library")
    with pytest.raises(EmbreeError, match=r"cannot be loaded from .*libembree4\.so"):
        library.__wrapped__()


def test_packets_are_aligned_for_vector_loads() -> None:
    for count in (1, 3):
        rays = packet_buffer(count)
        assert rays.ctypes.data % 64 == 0
        assert rays.nbytes == count * PACKET_BYTES
        assert rays.dtype == np.float32
