"""Pieces of bags are decompressed as far as they say, whatever is in them."""

from __future__ import annotations

import bz2
import tracemalloc
from pathlib import Path

import lz4.frame
import pytest

from gazelle.bag import BagError, create_bag, open_bag, ros1_connection
from gazelle.bag.compression_formats import compress_zstd, decompress_file, decompressed
from gazelle.bag.ros1 import Compression
from gazelle.bag.storage import Storage

PACK = {"bz2": bz2.compress, "lz4": lz4.frame.compress, "zstd": compress_zstd}
BOMB = bytes(100 << 20)


@pytest.mark.parametrize("compression", PACK)
def test_a_piece_is_what_was_packed(compression: str) -> None:
    data = bytes(range(256)) * 1000
    packed = PACK[compression](data)
    assert decompressed(packed, compression, len(data)) == data
    assert decompressed(packed, compression) == data
    assert decompressed(packed + packed, compression, 2 * len(data)) == data + data
    assert decompressed(PACK[compression](b""), compression, 0) == b""


@pytest.mark.parametrize("compression", PACK)
@pytest.mark.parametrize("said", [0, 100, len(BOMB) - 1])
def test_a_bomb_is_not_unpacked(compression: str, said: int) -> None:
    packed = PACK[compression](BOMB)
    tracemalloc.start()
    with pytest.raises(BagError, match=f"holds more than {said} bytes, not {said}"):
        decompressed(packed, compression, said)
    _now, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 2 * said + (4 << 20)


def test_what_is_said_to_be_huge_is_not_even_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(BagError, match=r"is said to hold 4000000000 bytes, at most 536870912"):
        decompressed(b"", "bz2", 4_000_000_000)
    monkeypatch.setenv("GAZELLE_LIMITS", "0.001")
    with pytest.raises(BagError, match=r"goes on and on, at most 536870 .*GAZELLE_LIMITS=10"):
        decompressed(compress_zstd(BOMB), "zstd")


@pytest.mark.parametrize("compression", PACK)
def test_damage_is_told(compression: str) -> None:
    packed = PACK[compression](bytes(range(256)) * 1000)
    with pytest.raises(BagError, match=f"a chunk of {compression} is damaged: it ends too early"):
        decompressed(packed[:-8], compression, 256_000)
    with pytest.raises(BagError, match=f"a chunk of {compression} is damaged: "):
        decompressed(b"nonsense" * 10, compression, 256_000)
    with pytest.raises(BagError, match=f"a chunk of {compression} holds 256000 bytes, not 256001"):
        decompressed(packed, compression, 256_001)


def test_a_file_does_not_grow_to_fill_the_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "0.001")
    source = tmp_path / "bag.mcap.zstd"
    source.write_bytes(compress_zstd(BOMB))
    with pytest.raises(BagError, match="the file holds more than 1000 times its own size"):
        decompress_file(source, tmp_path / "bag.mcap")


@pytest.fixture
def bomb(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A bag of a few kB with a message of 8 MiB, where 5 MiB are allowed."""
    path = tmp_path / "a.bag"
    writer = create_bag(path, Storage.ROS1, compression=Compression.BZ2)
    words = writer.add(ros1_connection("/word", "std_msgs/String"))
    writer.write(words, 1, (8 << 20).to_bytes(4, "little") + bytes(8 << 20))
    writer.close()
    assert path.stat().st_size < 8_000
    monkeypatch.setenv("GAZELLE_LIMITS", "0.01")
    tracemalloc.start()
    return path


def test_a_bag_of_a_few_bytes_that_holds_too_much_is_refused(bomb: Path) -> None:
    with pytest.raises(BagError, match=r"is said to hold 838\d+ bytes, at most 5368709"):
        list(open_bag(bomb).messages())
    assert tracemalloc.get_traced_memory()[1] < 1 << 20
    tracemalloc.stop()


def test_a_bag_without_an_index_that_holds_too_much_is_read_until_there(bomb: Path) -> None:
    bomb.write_bytes(bomb.read_bytes()[:-60])
    assert list(open_bag(bomb).messages()) == []
    assert tracemalloc.get_traced_memory()[1] < 1 << 20
    tracemalloc.stop()
