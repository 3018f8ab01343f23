"""Formats of bags that a pip package adds."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from tests.bag.conftest import START_NS, fill
from tests.installed_packages import code_of_page, installed

from gazelle.bag import BagError, create_bag, open_bag, storage_of
from gazelle.bag.formats import OWN_FORMATS, format_of_name, problems_of_added, storage_names
from gazelle.bag.playing import Controls, Player, PlayOptions
from gazelle.bag.recording import Recorder, Selection
from gazelle.bag.rosbag2 import Rosbag2Writer, reindex
from gazelle.cli import ros2
from gazelle.cli.bag import main as bag_command
from gazelle.graph import Graph

FOLDER_FORMATS = [one for one in OWN_FORMATS if one.in_folder]
LISTED = "".join(f"{one.name}\n" for one in FOLDER_FORMATS)
TAPE = {"gazelle.bag_storage": {"tape": "tapes:TAPE"}}


@pytest.fixture
def tapes(tmp_path: Path) -> Iterator[None]:
    """The package of the documentation's page is installed."""
    with installed(tmp_path / "site", "tapes", code_of_page("A bag storage"), TAPE):
        yield


def test_names_suffixes_and_first_bytes_differ() -> None:
    for part in ("name", "suffix", "magic"):
        assert len({getattr(one, part) for one in OWN_FORMATS}) == len(OWN_FORMATS)


@pytest.mark.parametrize("form", OWN_FORMATS, ids=lambda form: form.name)
def test_every_format_of_the_table_opens_what_it_creates(
    form: object, bag_of: Callable[..., Path]
) -> None:
    path = bag_of(f"a{form.suffix}")  # type: ignore[attr-defined]
    assert path.read_bytes().startswith(form.magic)  # type: ignore[attr-defined]
    bag = open_bag(path)
    assert bag.storage == form.name == storage_of(path)  # type: ignore[attr-defined]
    assert bag.summary.messages == 100


@pytest.mark.usefixtures("tapes")
def test_an_added_storage_is_written_and_read_as_file_and_as_folder(tmp_path: Path) -> None:
    assert "tape" in storage_names() and "tapes" not in sys.modules
    for name in ("a.tape", "folder"):
        writer = create_bag(tmp_path / name, "tape")
        fill(writer)
        writer.close()
        bag = open_bag(tmp_path / name)
        assert (bag.storage, bag.summary.messages) == ("tape", 100)
        assert next(bag.messages()).stamp_ns == START_NS
    assert storage_of("a.tape") == "tape"
    assert (tmp_path / "folder" / "folder_0.tape").is_file()
    (tmp_path / "folder" / "metadata.yaml").unlink()
    reindex(tmp_path / "folder")
    assert "storage_identifier: tape" in (tmp_path / "folder" / "metadata.yaml").read_text()


@pytest.mark.usefixtures("tapes")
def test_topics_are_recorded_into_an_added_storage(
    bag_of: Callable[..., Path], tmp_path: Path, free_port: int
) -> None:
    import threading

    from tests.patience import eventually

    quiet = (lambda *_args: None, lambda *_args: None)
    with Graph.open(port=free_port) as graph:
        node, stop = graph.create_node("recorder"), threading.Event()
        sink = Rosbag2Writer(tmp_path / "recorded", "tape")
        recorder, chosen = Recorder(graph, node, sink), Selection(("/point", "/word"))
        recorder.begin(chosen)
        thread = threading.Thread(target=recorder.run, args=(chosen, stop))
        thread.start()
        player_node = graph.create_node("player")
        source = open_bag(bag_of("a.mcap"))
        player = Player(player_node, [source], PlayOptions(immediate=True), Controls(), *quiet)
        player.play()
        eventually(lambda: recorder.written == 100)
        stop.set()
        thread.join()
    assert open_bag(tmp_path / "recorded").summary.messages == 100


@pytest.mark.usefixtures("tapes")
def test_the_commands_know_an_added_storage(
    bag_of: Callable[..., Path],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    target = tmp_path / "b.tape"
    assert bag_command(["convert", str(bag_of("a.bag")), str(target)]) == 0
    assert capsys.readouterr().out == f"{target}: 100 messages (tape)\n"
    assert ros2.main(["bag", "info", str(target)]) == 0
    shown = capsys.readouterr().out
    assert "Storage id:" in shown and "tape" in shown and "100" in shown
    assert ros2.main(["bag", "list", "storage"]) == 0
    assert capsys.readouterr().out == f"{LISTED}tape\n"


def test_a_storage_that_cannot_be_loaded_is_told_and_the_others_go_on(
    bag_of: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    points = {"gazelle.bag_storage": {"torn": "torn_tapes:TORN"}}
    with installed(tmp_path / "site", "torn_tapes", "raise OSError('torn')", points):
        why = (
            "entry point 'torn = torn_tapes:TORN' of torn_tapes 1.2 (gazelle.bag_storage) cannot "
            "be loaded: OSError: torn"
        )
        assert open_bag(bag_of("a.mcap")).summary.messages == 100
        assert "torn_tapes" not in sys.modules
        with pytest.raises(BagError, match="there is no storage 'torn' of bags") as raised:
            format_of_name("torn")
        assert str(raised.value).endswith(why) and problems_of_added() == (why,)
        assert ros2.main(["bag", "list", "storage"]) == 0
        told = capsys.readouterr()
        assert told.out == LISTED
        assert why in told.err and "[bag.storage-not-loaded]" in told.err


def test_a_storage_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(BagError, match="there is no storage 'mcaq' of bags; did you mean 'mcap'"):
        create_bag(tmp_path / "a", "mcaq")
    (tmp_path / "out.yaml").write_text(f"output_bags: [{{uri: {tmp_path}/b, storage_id: tape}}]")
    with pytest.raises(BagError, match="there is no storage 'tape' of bags; there are rosbag"):
        from gazelle.cli.ros2.bag.convert import convert

        convert(["-i", str(tmp_path), "-o", str(tmp_path / "out.yaml")])


def test_a_folder_without_bag_names_the_suffixes(tmp_path: Path) -> None:
    missing = re.escape(" and ".join(f"no {one.suffix}" for one in FOLDER_FORMATS))
    with pytest.raises(BagError, match=rf"no bag in this folder \({missing}\)"):
        open_bag(tmp_path)


def test_a_compression_that_a_storage_does_not_know_is_refused_of_folders_too(
    tmp_path: Path,
) -> None:
    for path in (tmp_path / "a.db3", tmp_path / "folder"):
        with pytest.raises(BagError, match="sqlite3 knows no compression 'zstd', but none"):
            create_bag(path, "sqlite3", compression="zstd")
    with pytest.raises(BagError, match="sqlite3 knows no compression 'zstd', but none"):
        Rosbag2Writer(tmp_path / "other", "sqlite3", compression="zstd")
    assert not (tmp_path / "other").exists()
