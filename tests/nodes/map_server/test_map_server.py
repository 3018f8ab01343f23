"""map_server and map_saver on a graph."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.errors import LaunchError
from gazelle.mapping.grids import MapMode, OccupancyGrid, write_map
from gazelle.nodes.host import run_node
from gazelle.nodes.map_server.occupancy_grid import grid_of_message, message_of_grid
from gazelle.nodes.map_server.saver import parse_cli, parse_saver

_MAP = "nav_msgs/msg/OccupancyGrid"
_CHANGE = "lifecycle_msgs/srv/ChangeState"


def _grid() -> OccupancyGrid:
    cells = np.full((4, 6), -1, np.int8)
    cells[1:3, 1:5] = 0
    cells[2, 2] = 100
    return OccupancyGrid(cells, 0.05, (-1.0, -2.0, 0.0))


@pytest.fixture
def yaml(tmp_path: Path) -> Path:
    return write_map(_grid(), tmp_path / "map")[1]


def test_messages_carry_the_grid_there_and_back() -> None:
    back = grid_of_message(message_of_grid(_grid(), "map", 1_500_000_000))
    np.testing.assert_array_equal(back.cells, _grid().cells)
    assert (back.resolution_m, back.origin) == (0.05, (-1.0, -2.0, 0.0))
    message = message_of_grid(_grid(), "map", 1_500_000_000)
    assert (message.header.frame_id, message.info.map_load_time.sec) == ("map", 1)


def test_a_message_whose_size_is_wrong_is_an_error() -> None:
    message = message_of_grid(_grid(), "map", 0)
    message.info.width = 7
    with pytest.raises(ValueError, match="says 7 × 4 cells and has 24"):
        grid_of_message(message)


def test_map_server_publishes_answers_and_changes(bench: Any, yaml: Path, tmp_path: Path) -> None:
    bench.start("map_server/map_server", str(yaml))
    maps = bench.listen("/map", _MAP)
    infos = bench.listen("/map_metadata", "nav_msgs/msg/MapMetaData")
    bench.eventually(lambda: maps and infos)
    np.testing.assert_array_equal(grid_of_message(maps[0]).cells, _grid().cells)
    assert infos[0].width == 6
    assert bench.call("/static_map", "nav_msgs/srv/GetMap").map.info.height == 4
    other = OccupancyGrid(np.zeros((2, 2), np.int8), 0.1)
    described = write_map(other, tmp_path / "other")[1]
    answer = bench.call("/change_map", "nav_msgs/srv/LoadMap", map_url=str(described))
    assert answer.result == 0
    bench.eventually(lambda: len(maps) == 2)
    assert maps[1].info.width == 2
    missing = bench.call("/change_map", "nav_msgs/srv/LoadMap", map_url="/none.yaml")
    assert missing.result == 1
    assert bench.stop() == [0]


def test_map_server_without_a_map_ends_with_255(bench: Any, tmp_path: Path, capfd: Any) -> None:
    (tmp_path / "map.yaml").write_text("image: none.pgm\nresolution: 0\norigin: [0, 0, 0]\n")
    bench.start("map_server/map_server", str(tmp_path / "map.yaml"))
    assert bench.wait() == [255]
    said = "".join(capfd.readouterr())
    assert "'resolution' is 0 m, it must be above 0" in said
    assert "does not contain the tag 'negate'" in said


@pytest.mark.parametrize(
    ("image", "resolution", "says"),
    [
        ("mop.pgm", "0.05", "mop.pgm"),
        ("map.pgm", "0", "'resolution' is 0 m, it must be above 0"),
        ("map.pgm", "-0.05", "'resolution' is -0.05 m, it must be above 0"),
        ("map.pgm", "fine", "'resolution' is"),
    ],
)
def test_a_bad_map_is_told_and_the_good_one_stays(
    bench: Any, yaml: Path, tmp_path: Path, capfd: Any, image: str, resolution: str, says: str
) -> None:
    bench.start("map_server/map_server", str(yaml))
    bench.eventually(lambda: bench.listen("/map", _MAP))
    rest = "origin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    bad = tmp_path / "bad.yaml"
    bad.write_text(f"image: {image}\nresolution: {resolution}\n{rest}")
    assert bench.call("/change_map", "nav_msgs/srv/LoadMap", map_url=str(bad)).result != 0
    assert bench.call("/static_map", "nav_msgs/srv/GetMap").map.info.width == 6
    assert says in "".join(capfd.readouterr())
    assert bench.stop() == [0]


def test_map_saver_writes_what_map_server_publishes(bench: Any, yaml: Path, tmp_path: Path) -> None:
    bench.start("map_server/map_server", str(yaml))
    bench.eventually(lambda: bench.listen("/map", _MAP))
    bench.start("map_server/map_saver", "-f", str(tmp_path / "again"))
    bench.eventually((tmp_path / "again.yaml").exists)
    bench.stop()
    assert (tmp_path / "again.pgm").read_bytes() == (tmp_path / "map.pgm").read_bytes()


def test_nav2s_map_server_is_a_managed_node(bench: Any, yaml: Path, tmp_path: Path) -> None:
    bench.start("nav2_map_server/map_server", "--ros-args", "-p", f"yaml_filename:={yaml}")
    bench.start("nav2_map_server/map_saver_server", "--ros-args")

    def change(node: str, label: str) -> bool:
        from gazelle.interfaces import message_type

        transition = message_type("lifecycle_msgs/msg/Transition")(label=label)
        return bool(bench.call(f"/{node}/change_state", _CHANGE, transition=transition).success)

    maps = bench.listen("/map", _MAP)
    assert not change("map_server", "activate")
    assert change("map_server", "configure")
    assert not maps
    refused = bench.call("/map_server/load_map", "nav2_msgs/srv/LoadMap", map_url=str(yaml))
    assert refused.result == 255
    assert change("map_server", "activate")
    bench.eventually(lambda: maps)
    assert bench.call("/map_server/map", "nav_msgs/srv/GetMap").map.info.width == 6
    loaded = bench.call("/map_server/load_map", "nav2_msgs/srv/LoadMap", map_url="/none.yaml")
    assert loaded.result == 1
    assert change("map_saver", "configure")
    assert change("map_saver", "activate")
    wanted = {"map_url": str(tmp_path / "saved"), "map_mode": "raw", "map_topic": "/map"}
    assert bench.call("/map_saver/save_map", "nav2_msgs/srv/SaveMap", **wanted).result
    assert "mode: raw" in (tmp_path / "saved.yaml").read_text()
    assert bench.call("/map_server/get_state", "lifecycle_msgs/srv/GetState").current_state.id == 3
    bench.stop()


@pytest.mark.parametrize("name", ["save_map_timeout", "free_thresh_default"])
def test_a_saver_on_request_ends_where_a_number_is_none(bench: Any, name: str) -> None:
    words = {"node": "nav2_map_server/map_saver_server",
             "argv": ["--ros-args", "-p", f"{name}:=soon"]}  # fmt: skip
    with pytest.raises(LaunchError, match=f"parameter '/map_saver/{name}' is 'soon', not a number"):
        run_node(words, bench.graph, threading.Event())
    assert "/map_saver" not in bench.graph.node_names()


def test_a_saver_of_the_command_line_tells_of_parameters_that_change_nothing(
    bench: Any, tmp_path: Path, capfd: Any
) -> None:
    bench.start(
        "nav2_map_server/map_saver_cli", "-f", str(tmp_path / "m"), "--ros-args",
        "-p", "save_map_timeout:=0.1", "-p", "save_map_timeot:=5.0",
        "-p", "free_thresh_default:=0.3",
    )  # fmt: skip
    assert bench.wait() == [1]
    told = "".join(capfd.readouterr())
    assert "parameter 'save_map_timeot' is not one of map_saver_cli; it has no effect" in told
    assert "'free_thresh_default' (0.3) has no effect here: --free and --occ say it" in told
    assert "no map on /map within 0.1 s" in told


def test_command_lines_of_the_savers() -> None:
    wanted = parse_saver(["--occ", "90", "--free", "10", "-f", "/tmp/map"])
    assert (wanted.stem, wanted.options.occupied_thresh) == ("/tmp/map", 0.9)
    assert wanted.options.free_thresh == 0.1
    assert parse_saver(["-h"]).help
    words = ["-t", "/other", "-f", "m", "--fmt", "png", "--mode", "scale", "--free", "0.1"]
    cli = parse_cli(words)
    assert (cli.topic, cli.stem, cli.options.mode) == ("/other", "m", MapMode.SCALE)
    assert (cli.options.image_format, cli.options.free_thresh) == ("png", 0.1)


@pytest.mark.parametrize(
    ("parse", "words", "says"),
    [
        (parse_saver, ["-f"], "'-f' wants a value"),
        (parse_saver, ["--ocup", "3"], "did you mean '--occ'"),
        (parse_saver, ["--occ", "0"], "threshold_occupied must be between 1 and 100, not '0'"),
        (parse_saver, ["--free", "x"], "threshold_free must be between 0 and 100"),
        (parse_saver, ["--occ", "20"], "threshold_free must be smaller"),
        (parse_cli, ["--free"], "--free should be followed by a value"),
        (parse_cli, ["--mod", "raw"], "did you mean '--mode'"),
        (parse_cli, ["--mode", "row"], "Map mode parameter not recognized: row"),
        (parse_cli, ["--occ", "much"], "--occ wants a share of 0 to 1, not 'much'"),
    ],
)
def test_wrong_command_lines_are_told(parse: Any, words: list[str], says: str) -> None:
    with pytest.raises(LaunchError, match=says):
        parse(words)
