"""Archives of numpy that are damaged, or unpack to more than there is room for."""

from __future__ import annotations

import io
import os
import pickle
import struct
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest

from gazelle.documents.npz_files import (
    ArchiveError,
    keep_arrays,
    keeps_arrays,
    kept_arrays,
    read_arrays,
)


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


_RAISE = "if the file means it, set the environment variable GAZELLE_LIMITS=10 for ten times"


def _npy(shape: tuple[int, ...], content: bytes) -> bytes:
    """Return an array's file that says that it is of this shape, whatever it holds."""
    stream = io.BytesIO()
    header = {"descr": "<f8", "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(stream, header)
    return stream.getvalue() + content


def _archive(folder: Path, content: bytes) -> Path:
    path = folder / "a.npz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("x.npy", content)
    return path


def _refused(path: Path) -> str:
    """Return why an archive is not read; it takes little memory to say so."""
    tracemalloc.start()
    with pytest.raises(ArchiveError) as refusal:
        read_arrays(path)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 10_000_000
    return str(refusal.value)


def test_archive_that_unpacks_to_too_much_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "0.015625")
    content = _npy((4 << 20,), bytes(32 << 20))
    path = _archive(tmp_path, content)
    assert path.stat().st_size < 100_000
    assert _refused(path) == f"it holds {len(content)} bytes, at most 16777216 are read; {_RAISE}"


def test_archive_that_lies_about_its_size_ends_there(tmp_path: Path) -> None:
    path = _archive(tmp_path, _npy((4 << 20,), bytes(32 << 20)))
    data = bytearray(path.read_bytes())
    for mark, place in ((b"PK\x03\x04", 22), (b"PK\x01\x02", 24)):
        struct.pack_into("<I", data, data.index(mark) + place, 1000)
    path.write_bytes(data)
    assert _refused(path) == "Bad CRC-32 for file 'x.npy'"


@pytest.mark.parametrize("shape", [(10**6, 10**6), (2**62, 2**62), (3,)])
def test_array_that_claims_more_than_it_holds_is_refused(
    tmp_path: Path, shape: tuple[int, ...]
) -> None:
    path = _archive(tmp_path, _npy(shape, b""))
    if shape == (3,):
        # The header itself is longer than three numbers: numpy finds out.
        assert _refused(path).startswith("EOF: reading array data, expected 24 bytes got 0")
    else:
        assert _refused(path) == f"'x.npy' says that it is {shape}, and holds less"


def test_objects_of_python_are_never_made(tmp_path: Path) -> None:
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        header, {"descr": "|O", "fortran_order": False, "shape": (1,)}
    )
    path = _archive(tmp_path, header.getvalue() + pickle.dumps([print]))
    assert _refused(path) == "Object arrays cannot be loaded when allow_pickle=False"


def test_what_is_no_archive_or_is_cut_short_is_refused(tmp_path: Path) -> None:
    path = _archive(tmp_path, _npy((1000,), bytes(range(250)) * 32))
    data = path.read_bytes()
    for content, reason in (
        (b"", "File is not a zip file"),
        (data[:-30], "File is not a zip file"),
    ):
        path.write_bytes(content)
        assert _refused(path) == reason
    path.write_bytes(data[:60] + bytes(40) + data[100:])
    assert _refused(path)


def test_arrays_come_by_their_names(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    np.savez_compressed(path, x=np.arange(3.0), y=np.zeros((2, 2), dtype=np.uint8))
    found = read_arrays(path)
    assert sorted(found) == ["x", "y"]
    assert found["x"].tolist() == [0.0, 1.0, 2.0]
    assert found["y"].shape == (2, 2)
