"""``gazelle bag convert`` and ``export`` as typed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.bag import Storage, create_bag, open_bag, ros1_connection
from gazelle.cli import bag
from gazelle.errors import GazelleError
from gazelle.interfaces import ros1_message_type, to_ros1


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A ROS 1 bag in the current folder."""
    monkeypatch.chdir(tmp_path)
    writer = create_bag(tmp_path / "a.bag", Storage.ROS1)
    kind = ros1_message_type("std_msgs/Float64")
    for topic in ("/a", "/b"):
        one = writer.add(ros1_connection(topic, "std_msgs/Float64"))
        for place in range(5):
            writer.write(one, 10**18 + place, to_ros1(kind(float(place))))
    writer.close()
    return tmp_path / "a.bag"


@pytest.mark.parametrize("target", ["b.mcap", "b.db3", "folder"])
def test_convert_there_and_back(
    source: Path, capsys: pytest.CaptureFixture[str], target: str
) -> None:
    assert bag.main(["convert", "a.bag", target, "--topics", "a"]) == 0
    assert capsys.readouterr().out.startswith(f"{target}: 5 messages (")
    assert bag.main(["convert", target, "c.bag", "--compression", "bz2"]) == 0
    found = open_bag("c.bag")
    assert [one.topic for one in found.connections] == ["/a"]
    assert set(found.summary.packs) == {"bz2"}


def test_export_prints_its_files(source: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert bag.main(["export", "a.bag", "--to", "csv"]) == 0
    assert capsys.readouterr().out == "a_csv/a.csv\na_csv/b.csv\n"
    assert Path("a_csv/b.csv").read_text().splitlines()[5] == "1000000000.0,4.0"


def test_nothing_is_written_over(source: Path, raises_told: Callable) -> None:
    raises_told(["convert", "a.bag", "a.bag"], "a.bag is there already")


@pytest.fixture
def raises_told() -> Callable:
    """Runs words that must fail with these words."""

    def run(words: list[str], text: str) -> None:
        with pytest.raises(GazelleError, match=text):
            bag.main(words)

    return run
