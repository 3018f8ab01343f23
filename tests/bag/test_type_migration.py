"""Bags of older types: what is brought over, what is not and why, as the real ``rosbag fix``."""

from __future__ import annotations

import hashlib
import struct
import subprocess
from pathlib import Path

import pytest
from tests.patience import stretched

from gazelle.bag import BagError, Connection, Encoding, Storage, create_bag, open_bag
from gazelle.bag.type_migration import migration_of
from gazelle.cli import rosbag
from gazelle.interfaces import md5sum

RULE = "=" * 80
TURNED, OTHER = "float64 y\nfloat64 x\nfloat64 z\n", "float64 x\nfloat64 y\nfloat64 w\n"
TWIST, VECTOR = "geometry_msgs/Twist", "geometry_msgs/Vector3"


def digest(text: str) -> str:
    return hashlib.md5(text.strip().encode(), usedforsecurity=False).hexdigest()


def twist_with(vector: str) -> Connection:
    text = f"Vector3 linear\nVector3 angular\n\n{RULE}\nMSG: {VECTOR}\n{vector}"
    total = digest(f"{digest(vector)} linear\n{digest(vector)} angular")
    return Connection(0, "/t", TWIST, Encoding.ROS1, text, total, "/n")


def write(path: Path, one: Connection, data: bytes) -> None:
    writer = create_bag(path, Storage.ROS1)
    writer.write(writer.add(one), 5, data)
    writer.close()


def test_nothing_has_to_happen_to_a_type_that_is_the_same() -> None:
    one = Connection(0, "/v", VECTOR, Encoding.ROS1, "", md5sum(VECTOR))
    assert migration_of(one) is None


def test_fields_in_another_order_are_brought_over() -> None:
    found = migration_of(twist_with(TURNED))
    assert found is not None and found.missing == () and found.convert is not None
    assert [one.type_name for one in found.changes] == [TWIST, VECTOR]
    assert found.convert(struct.pack("<6d", 2, 1, 3, 5, 4, 6)) == struct.pack(
        "<6d", 1, 2, 3, 4, 5, 6
    )


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (OTHER, "field 'z' is not in the bag"),
        ("float64 x\nfloat64 y\nfloat64 z\nint8 w\n", "field 'w' is only in the bag"),
        ("float32 x\nfloat64 y\nfloat64 z\n", "field 'x' was float32 and is float64"),
        ("float64 x\nfloat64 y\nfloat64[3] z\n", "field 'z' was float64[3] and is float64"),
        ("int8 N=1\nfloat64 x\nfloat64 y\nfloat64 z\n", "constant 'N' has changed or gone"),
    ],
)
def test_what_cannot_be_brought_over_says_why(text: str, problem: str) -> None:
    found = migration_of(twist_with(text))
    assert found is not None and found.convert is None
    (missing,) = found.missing
    assert missing.type_name == VECTOR and missing.problems[0] == problem


def test_a_type_that_is_not_known_here_is_named() -> None:
    found = migration_of(Connection(0, "/u", "no_msgs/None", Encoding.ROS1, "int32 a\n", "1" * 32))
    assert found is not None
    assert found.missing[0].problems == ("the type is not known here",)


def test_a_definition_that_is_none_is_an_error() -> None:
    with pytest.raises(BagError, match="the bag's definition of geometry_msgs/Vector3 cannot be"):
        migration_of(Connection(0, "/v", VECTOR, Encoding.ROS1, "float64\n", "1" * 32))


def test_fix_and_check_print_what_the_real_ones_print(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    good, bad = twist_with(TURNED), twist_with(OTHER)
    write(tmp_path / "good.bag", good, struct.pack("<6d", 2, 1, 3, 5, 4, 6))
    write(tmp_path / "bad.bag", bad, bytes(48))
    head = f"The following migrations need to occur:\n * From: {TWIST} [{good.md5sum}]\n"
    assert rosbag.main(["check", "good.bag"]) == 0
    assert capsys.readouterr().out == (
        f"{head}   To:   {TWIST} [{md5sum(TWIST)}]\n\n"
        "All rules defined.  Bag is ready to be migrated\n"
    )
    assert rosbag.main(["fix", "good.bag", "new.bag"]) == 0
    assert capsys.readouterr().out == "Bag migrated successfully.\n"
    (message,) = open_bag("new.bag").messages()
    assert message.data == struct.pack("<6d", 1, 2, 3, 4, 5, 6)
    assert (message.connection.md5sum, message.connection.callerid) == (md5sum(TWIST), "/n")
    assert rosbag.main(["fix", "bad.bag", "new2.bag"]) == 1
    captured = capsys.readouterr()
    assert captured.out.startswith(
        "Bag could not be migrated.  The following migrations could not be performed:\n"
        f" * From: {TWIST} [{bad.md5sum}]\n   To:   {TWIST} [{md5sum(TWIST)}]\n"
        f"    1 rules missing:\n     * From: {VECTOR} [{digest(OTHER)}]\n"
    )
    assert captured.err.startswith(f"{VECTOR}: field 'z' is not in the bag\n")
    assert not Path("new2.bag").exists()
    assert rosbag.main(["fix", "--force", "bad.bag", "new2.bag"]) == 0
    assert next(open_bag("new2.bag").messages()).data == bytes(48)


def test_rule_files_and_other_suffixes_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "a.bag", twist_with(TURNED), bytes(48))
    assert rosbag.main(["check", "a.bag", "mine.bmr"]) == 1
    assert "mine.bmr: rule files (.bmr) are programs for genpy" in capsys.readouterr().err
    assert rosbag.main(["fix", "a.bag", "b.mcap"]) == 2
    assert "Output file must be a bag file." in capsys.readouterr().err


@pytest.mark.reference
def test_the_real_rosbag_writes_the_same_bag(tmp_path: Path) -> None:
    if not Path("/usr/bin/rosbag").exists():
        pytest.skip("ROS 1 is not installed (Debian: apt-get install python3-rosbag)")
    write(tmp_path / "a.bag", twist_with(TURNED), struct.pack("<6d", 2, 1, 3, 5, 4, 6))
    words = ["/usr/bin/rosbag", "fix", "a.bag", "theirs.bag"]
    environ = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path)}
    subprocess.run(words, cwd=tmp_path, env=environ, check=True, timeout=stretched())
    assert rosbag.main(["fix", str(tmp_path / "a.bag"), str(tmp_path / "ours.bag")]) == 0
    ours, theirs = (
        next(open_bag(tmp_path / f"{one}.bag").messages()) for one in ("ours", "theirs")
    )
    assert ours == theirs
