"""Pain 25: what other tools cannot read is read, or refused with what to do about it.

rosbag2#395: a recorder that was killed leaves files that nobody opens; bags of types whose package
is not here cannot be shown.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.bag import Connection, Encoding, create_bag, storage_of
from gazelle.cli import rosbag, rostopic

Shown = Callable[[str], tuple[int, str, str]]
_START_NS = 1_700_000_000_000_000_000
_TYPE = "nowhere_msgs/Reading"
_DEFINITION = "float64 value\nstring unit\n"
_DATA = b"\0\0\0\0\0\0\xf8\x3f" + b"\x03\0\0\0m/s"
_ECHO = 'value: 1.5\nunit: "m/s"\n---\n'


def _make(path: Path) -> Path:
    """Write three readings of a type whose package nobody has."""
    storage = storage_of(path)
    assert storage is not None
    writer = create_bag(path, storage)
    digest = hashlib.md5(_DEFINITION.strip().encode()).hexdigest()
    readings = writer.add(
        Connection(0, "/reading", _TYPE, Encoding.ROS1, _DEFINITION, digest, "/sensor", False)
    )
    for place in range(3):
        writer.write(readings, _START_NS + place, _DATA)
    writer.close()
    return path


@pytest.fixture
def shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Shown:
    """Runs ``rosbag info`` in the folder of the bags."""
    monkeypatch.chdir(tmp_path)

    def run(name: str) -> tuple[int, str, str]:
        code = rosbag.main(["info", name])
        found = capsys.readouterr()
        return code, found.out, found.err

    return run


@pytest.mark.parametrize(
    ("kept", "name", "code", "printed", "told"),
    [
        (-300, "a.bag", 0, "messages:    3", ("a.bag: warning: ", "bag.unindexed",
         "rosbag reindex a.bag", "bag unindexed")),
        (-300, "a.bag.active", 0, "messages:    3", ("bag.unindexed", "rosbag reindex")),
        (20, "a.bag", 1, "version: 2.0", ("bag.unindexed", "0 messages can be read")),
        (5, "a.bag", 1, "", ("ERROR reading a.bag", "This does not appear to be a bag file")),
        (0, "a.bag", 1, "", ("ERROR reading a.bag", "This does not appear to be a bag file")),
    ],
    ids=["no index", "active", "header only", "torn", "empty"],
)  # fmt: skip
def test_broken_bags_are_read_or_refused_with_a_remedy(
    tmp_path: Path, shown: Shown, kept: int, name: str, code: int, printed: str,
    told: tuple[str, ...],
) -> None:  # fmt: skip
    data = _make(tmp_path / "whole.bag").read_bytes()
    (tmp_path / name).write_bytes(data[:kept])
    found_code, out, err = shown(name)
    assert (found_code, printed in out) == (code, True), (out, err)
    assert not [words for words in told if words not in err], err


def test_whole_bag_is_shown_without_a_word(tmp_path: Path, shown: Shown) -> None:
    _make(tmp_path / "whole.bag")
    code, out, err = shown("whole.bag")
    assert (code, err) == (0, "")
    assert "/reading   3 msgs    : nowhere_msgs/Reading" in out


def test_messages_are_read_without_their_package(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = _make(tmp_path / "whole.bag")
    assert rostopic.main(["echo", "-b", str(path), "/reading"]) == 0
    assert capsys.readouterr().out == 3 * _ECHO
