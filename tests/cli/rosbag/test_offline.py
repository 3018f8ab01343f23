"""``rosbag info, check, filter, compress, reindex``: what the real ones print, and the bags."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from gazelle.bag import open_bag
from gazelle.cli import rosbag

pytestmark = pytest.mark.reference


@pytest.fixture
def live(ros1_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the recorded bags to work in; its sibling holds what the real ones printed."""
    for name in ("t.bag", "tf.bag"):
        shutil.copy(ros1_dir / name, tmp_path / name)
        (tmp_path / name).chmod(0o644)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TZ", "UTC")
    return ros1_dir


def _expected(live: Path, name: str) -> str:
    text = (live / f"{name}.txt").read_bytes().decode()
    return text.split("[stdout]\n")[1].split("[stderr]")[0]


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (["info", "t.bag"], "bag_info"),
        (["info", "tf.bag"], "bag_info_lz4"),
        (["info", "-y", "t.bag"], "bag_info_yaml"),
        (["check", "t.bag"], "bag_check"),
    ],
)
def test_output_is_that_of_the_real_one(
    live: Path, capsys: pytest.CaptureFixture[str], words: list[str], name: str
) -> None:
    assert rosbag.main(words) == 0
    assert capsys.readouterr().out == _expected(live, name)


def test_filter_keeps_what_the_expression_is_true_for(
    live: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    expression = "topic == '/joint_states' and len(m.name) > 0 and t.secs >= 1795226407"
    assert rosbag.main(["filter", "t.bag", "out.bag", expression]) == 0
    messages = list(open_bag("out.bag").messages())
    assert {one.connection.topic for one in messages} == {"/joint_states"}
    assert min(one.stamp_ns for one in messages) >= 1795226407_000_000_000
    assert "100%             24.2 KB 00:00" in capsys.readouterr().out


def test_filter_explains_a_wrong_expression(live: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert rosbag.main(["filter", "t.bag", "out.bag", "topic = '/tf'"]) == 1
    assert "is not a Python expression: invalid syntax; write == to compare" in (
        capsys.readouterr().err
    )


def test_filter_refuses_to_write_over_its_input(
    live: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert rosbag.main(["filter", "t.bag", "t.bag", "True"]) == 3
    assert capsys.readouterr().err == "Cannot use same file as input and output [t.bag]\n"


@pytest.mark.parametrize(("flag", "word"), [("--bz2", "bz2"), ("--lz4", "lz4")])
def test_compress_and_decompress_keep_every_byte(live: Path, flag: str, word: str) -> None:
    before = [one[1:] for one in open_bag("t.bag").messages()]
    assert rosbag.main(["compress", flag, "-q", "t.bag"]) == 0
    assert set(open_bag("t.bag").summary.packs) == {word}
    assert Path("t.orig.bag").is_file()
    assert rosbag.main(["decompress", "-q", "-f", "t.bag"]) == 0
    assert set(open_bag("t.bag").summary.packs) == {"none"}
    assert [one[1:] for one in open_bag("t.bag").messages()] == before


def test_a_bag_that_was_not_closed_is_shown_and_reindexed(
    live: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = Path("t.bag").read_bytes()
    Path("t.bag").write_bytes(data[:-300])
    assert rosbag.main(["info", "t.bag"]) == 0
    shown = capsys.readouterr()
    assert "messages:    77\n" in shown.out
    assert "bag.unindexed" in shown.err and "rosbag reindex t.bag" in shown.err
    assert rosbag.main(["reindex", "-q", "t.bag"]) == 0
    assert open_bag("t.bag").summary.is_indexed


def test_missing_bags_and_wrong_options_are_told(
    live: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert rosbag.main(["info", "none.bag"]) == 1
    assert rosbag.main(["info"]) == 2
    assert rosbag.main(["info", "-k", "duration", "t.bag"]) == 2
    assert rosbag.main(["record"]) == 2
    assert rosbag.main(["record", "-a", "--split"]) == 2
    err = capsys.readouterr().err
    assert "ERROR reading none.bag: Error opening file: none.bag: No such file" in err
    assert "You must specify at least 1 bag file." in err
    assert "You can only specify key when printing in YAML format." in err
    assert "You must specify a topic name or else use the '-a' option." in err
    assert "Split specified without giving a maximum duration or size" in err


def test_check_shows_which_fields_differ(live: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from dataclasses import replace

    from gazelle.bag import Storage, create_bag

    source = open_bag("t.bag")
    writer = create_bag("old.bag", Storage.ROS1)
    (states,) = (one for one in source.connections if one.topic == "/joint_states")
    text = states.definition.replace("float64[] effort", "float64[] torque")
    added = writer.add(replace(states, definition=text, md5sum="0" * 32))
    writer.write(added, 1, b"")
    writer.close()
    assert rosbag.main(["check", "old.bag"]) == 0
    captured = capsys.readouterr()
    assert "From: sensor_msgs/JointState [00000000000000000000000000000000]" in captured.out
    assert "sensor_msgs/JointState: field 'torque' is only in the bag\n" in captured.err
