"""Bags that are gone on in: nothing is lost, whenever the writer ends."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.bag.conftest import START_NS, STEP_NS, fill, point_bytes
from tests.patience import stretched

from gazelle.bag import (
    BagError,
    Encoding,
    Storage,
    create_bag,
    open_bag,
    ros1_connection,
    storage_of,
)
from gazelle.bag.ros1 import Compression, Ros1Writer

Fill = Callable[..., Path]
HAS_ROS1 = Path("/usr/bin/rosbag").exists()


def go_on(path: Path, first: int, count: int, **options: Compression) -> Ros1Writer:
    """Append points and hand them to the system; the writer is not closed."""
    writer = Ros1Writer(path, append=True, **options)  # type: ignore[arg-type]
    (one,) = (one for one in writer.connections if one.topic == "/point")
    for place in range(first, first + count):
        writer.write(one, START_NS + place * STEP_NS, point_bytes(place, Encoding.ROS1))
    writer.flush()
    return writer


def stamps(path: Path) -> list[int]:
    bag = open_bag(path)
    found = [(one.stamp_ns - START_NS) // STEP_NS for one in bag.messages()]
    assert bag.summary.messages == len(found)
    bag.close()
    return found


def test_what_is_appended_follows_what_was_there(bag_of: Fill) -> None:
    path = bag_of("a.bag")
    for first in (100, 110):
        writer = go_on(path, first, 10)
        new = writer.add(ros1_connection("/new", "std_msgs/String"))
        assert new.id not in {0, 1}
        writer.close()
    assert stamps(path) == list(range(120))
    assert open_bag(path).summary.is_indexed


@pytest.mark.reference
@pytest.mark.parametrize("closed", [False, True] if HAS_ROS1 else [True])
@pytest.mark.parametrize("packing", list(Compression) if HAS_ROS1 else [Compression.NONE])
def test_the_real_rosbag_reads_it_at_any_moment(
    bag_of: Fill, packing: Compression, closed: bool
) -> None:
    if not HAS_ROS1:
        pytest.skip("ROS 1 is not installed (Debian: apt-get install python3-rosbag)")
    path = bag_of("a.bag")
    writer = go_on(path, 100, 10, compression=packing)
    if closed:
        writer.close()
    code = f"import rosbag; print(len(list(rosbag.Bag('{path}').read_messages())))"
    environ = {"PATH": "/usr/bin:/bin", "HOME": str(path.parent)}
    done = subprocess.run(
        ["/usr/bin/python3", "-c", code], env=environ, capture_output=True, text=True,
        timeout=stretched(), check=False,
    )  # fmt: skip
    # Until it is closed, the real one sees what was there before.
    assert done.stdout == ("110\n" if closed else "100\n"), done.stderr


def test_a_writer_that_is_killed_has_lost_nothing(bag_of: Fill) -> None:
    path = bag_of("a.bag")
    go_on(path, 100, 10)
    assert stamps(path) == list(range(110))
    assert not open_bag(path).summary.is_indexed
    go_on(path, 110, 5).close()
    assert stamps(path) == list(range(115))
    assert open_bag(path).summary.is_indexed


@pytest.mark.parametrize("torn", [1, 40, 200])
def test_a_torn_piece_at_the_end_goes(bag_of: Fill, torn: int) -> None:
    path = bag_of("a.bag")
    go_on(path, 100, 10)
    whole = path.stat().st_size
    go_on(path, 110, 10)
    with path.open("rb+") as file:
        file.truncate(whole + torn)
    assert stamps(path) == list(range(110))
    go_on(path, 110, 3).close()
    assert stamps(path) == list(range(113))


def test_other_files_are_not_touched(tmp_path: Path) -> None:
    path = tmp_path / "a.bag"
    path.write_text("a letter")
    with pytest.raises(BagError, match=r"this is no bag of version 2\.0; nothing is appended"):
        Ros1Writer(path, append=True)
    assert path.read_text() == "a letter"


@pytest.mark.parametrize("name", ["a.bag", "a.mcap"])
def test_a_folder_that_somebody_removes_takes_nothing_along(name: str, tmp_path: Path) -> None:
    path = tmp_path / "runs" / name
    path.parent.mkdir()
    writer = create_bag(path, storage_of(path))
    fill(writer, 100)
    writer.flush()
    assert writer.restored == 0
    shutil.rmtree(path.parent)
    fill(writer, 10)
    writer.flush()
    assert writer.restored == 1
    shutil.rmtree(path.parent)
    writer.close()
    assert writer.restored == 2
    assert len(list(open_bag(path).messages())) == 110


def test_sqlite_tells_that_somebody_removed_its_file(tmp_path: Path) -> None:
    path = tmp_path / "a.db3"
    writer = create_bag(path, Storage.SQLITE)
    fill(writer, 10)
    path.unlink()
    with pytest.raises(BagError, match=r"Error writing to file: .*a\.db3: somebody has removed it"):
        writer.flush()
