from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from gazelle.geometry.array_cache import keep_arrays, keeps_arrays, kept_arrays


def test_arrays_come_back_bit_for_bit(tmp_path: Path) -> None:
    arrays = {
        "points_m": np.random.default_rng(1).normal(size=(7, 3)),
        "counts": np.array([2, 5]),
        "note": np.array("it fills 40 % of its hull"),
    }
    keep_arrays(tmp_path / "a" / "b.npz", arrays)
    found = kept_arrays(tmp_path / "a" / "b.npz")
    assert found is not None and found.keys() == arrays.keys()
    assert all(found[name].tobytes() == one.tobytes() for name, one in arrays.items())
    assert [one.name for one in (tmp_path / "a").iterdir()] == ["b.npz"]


def test_what_is_not_there_or_damaged_is_made_anew(tmp_path: Path) -> None:
    file = tmp_path / "a.npz"
    assert kept_arrays(file) is None
    keep_arrays(file, {"a": np.arange(100.0)})
    data = file.read_bytes()
    for cut in (0, 10, len(data) // 2, len(data) - 10):
        file.write_bytes(data[:cut])
        assert kept_arrays(file) is None


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root writes everywhere")
def test_read_only_home_keeps_nothing_and_says_nothing(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    keep_arrays(tmp_path / "a" / "b.npz", {"a": np.arange(3)})
    assert not keeps_arrays(tmp_path / "a")


def test_folder_below_a_file_keeps_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    keep_arrays(tmp_path / "file" / "b.npz", {"a": np.arange(3)})
    assert not keeps_arrays(tmp_path / "file" / "cache")
    assert keeps_arrays(tmp_path / "new" / "cache")
