"""Bags that rosbag2 compressed: whole files, and message by message."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.bag import BagError, Storage, open_bag
from gazelle.bag.compression_formats import compress_zstd
from gazelle.bag.rosbag2 import Rosbag2Writer, reindex

Fill = Callable[..., Path]


def tell(folder: Path, mode: str, form: str = "zstd", names: str = "") -> None:
    """Write into a folder's metadata how it is compressed."""
    path = folder / "metadata.yaml"
    text = path.read_text().replace("compression_mode: ''", f"compression_mode: {mode}")
    text = text.replace("compression_format: ''", f"compression_format: {form}")
    path.write_text(text.replace(names, f"{names}.zstd") if names else text)


def pack(file: Path) -> Path:
    packed = file.with_name(f"{file.name}.zstd")
    packed.write_bytes(compress_zstd(file.read_bytes()))
    file.unlink()
    return packed


@pytest.mark.parametrize("storage", [Storage.MCAP, Storage.SQLITE])
@pytest.mark.parametrize("with_metadata", [True, False])
def test_folders_of_compressed_files_are_read(
    bag_of: Fill, storage: Storage, with_metadata: bool
) -> None:
    folder = bag_of("folder", storage=storage)
    before = [tuple(one) for one in open_bag(folder).messages()]
    (file,) = (one for one in folder.iterdir() if one.suffix != ".yaml")
    pack(file)
    if with_metadata:
        tell(folder, "FILE", names=file.name)
    else:
        (folder / "metadata.yaml").unlink()
    bag = open_bag(folder)
    assert [tuple(one) for one in bag.messages()] == before
    assert bag.summary.messages == 100 and bag.storage is storage
    bag.close()
    reindex(folder)
    assert f"{file.name}.zstd" in (folder / "metadata.yaml").read_text()


@pytest.mark.parametrize("name", ["a.mcap", "a.db3"])
def test_a_compressed_file_is_read_alone_and_its_copy_goes(bag_of: Fill, name: str) -> None:
    bag = open_bag(pack(bag_of(name)))
    copy = Path(bag._folder.name)  # type: ignore[attr-defined]
    assert len(list(bag.messages())) == 100 and copy.is_dir()
    bag.close()
    assert not copy.exists()


@pytest.mark.parametrize("storage", [Storage.MCAP, Storage.SQLITE])
def test_compressed_messages_are_read(bag_of: Fill, tmp_path: Path, storage: Storage) -> None:
    source = open_bag(bag_of("folder", storage=storage))
    writer = Rosbag2Writer(tmp_path / "packed", storage)
    own = {one.id: writer.add(one) for one in source.connections}
    before = list(source.messages())
    for one in before:
        writer.write(own[one.connection.id], one.stamp_ns, compress_zstd(one.data))
    writer.close()
    tell(tmp_path / "packed", "MESSAGE")
    after = open_bag(tmp_path / "packed").messages()
    assert [one[1:] for one in after] == [one[1:] for one in before]


def test_what_cannot_be_read_is_told(bag_of: Fill) -> None:
    folder = bag_of("folder", storage=Storage.MCAP)
    tell(folder, "MESSAGE")
    with pytest.raises(BagError, match=r"message of /point at \d+ ns: a piece of zstd is damaged"):
        list(open_bag(folder).messages())
    tell(folder, "", form="")
    text = (folder / "metadata.yaml").read_text().replace("_format: zstd", "_format: lz4")
    (folder / "metadata.yaml").write_text(text)
    with pytest.raises(BagError, match=r"messages are compressed with lz4.*only zstd is"):
        open_bag(folder)


def test_files_that_are_not_there_are_named(bag_of: Fill) -> None:
    folder = bag_of("folder", storage=Storage.MCAP)
    path, text = folder / "metadata.yaml", (folder / "metadata.yaml").read_text()
    # The second is longer than any file's name can be.
    for name in ("gone.mcap", "g" * 300):
        path.write_text(text.replace("folder_0.mcap", name))
        with pytest.raises(BagError, match=rf"its metadata.yaml names {name}, which is not there"):
            open_bag(folder)


def test_a_compressed_file_that_is_not_whole_is_told(bag_of: Fill) -> None:
    path = pack(bag_of("a.mcap"))
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(BagError, match="the file is damaged or not whole"):
        open_bag(path)


@pytest.mark.reference
@pytest.mark.parametrize("mode", ["FILE", "MESSAGE"])
@pytest.mark.parametrize("storage", ["SQLITE3", "MCAP"])
def test_compressed_bags_of_rosbags_are_read(tmp_path: Path, mode: str, storage: str) -> None:
    rosbag2 = pytest.importorskip("rosbags.rosbag2")
    typesys = pytest.importorskip("rosbags.typesys")
    kind = getattr(rosbag2.StoragePlugin, storage)
    writer = rosbag2.Writer(tmp_path / "theirs", version=9, storage_plugin=kind)
    writer.set_compression(getattr(rosbag2.CompressionMode, mode), rosbag2.CompressionFormat.ZSTD)
    store = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
    with writer:
        one = writer.add_connection("/word", "std_msgs/msg/String", typestore=store)
        for place in range(20):
            writer.write(one, place, b"\0\1\0\0\2\0\0\0%c\0\0\0" % (65 + place))
    bag = open_bag(tmp_path / "theirs")
    found = [(message.stamp_ns, message.data[8:9]) for message in bag.messages()]
    assert found == [(place, b"%c" % (65 + place)) for place in range(20)]
