"""Map files as map_server and nav2_map_server read and write them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gazelle.diagnostics import Diagnostics, Severity
from gazelle.mapping.grids import (
    MapMode,
    MapWriteError,
    OccupancyGrid,
    SaveOptions,
    cells_of_pixels,
    read_map,
    write_map,
)

_YAML = """image: map.pgm
resolution: 0.05
origin: [-1.0, -2.0, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""


def _grid() -> OccupancyGrid:
    cells = np.array([[0, 100, -1], [25, 26, 65], [64, 10, 101 - 128]], np.int8)
    return OccupancyGrid(cells, 0.05, (-10.0, -10.5, 0.0))


def _read(path: Path, ros_version: int = 1) -> OccupancyGrid:
    found = Diagnostics()
    grid = read_map(path, found, ros_version=ros_version)
    assert grid is not None, list(found)
    assert not len(found)
    return grid


def _findings(
    folder: Path, text: str, name: str = "map.yaml", ros_version: int = 1
) -> dict[str, str]:
    (folder / name).write_text(text)
    found = Diagnostics()
    grid = read_map(folder / name, found, ros_version=ros_version)
    assert (grid is None) == (found.worst is Severity.ERROR)
    return {item.code: str(item) for item in found}


def test_map_saver_of_ros_1_writes_these_bytes(tmp_path: Path) -> None:
    image, described = write_map(_grid(), tmp_path / "map")
    grey = bytes([205, 254, 205, 254, 205, 0, 254, 0, 205])
    assert image.read_bytes() == b"P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n3 3\n255\n" + grey
    assert described.read_text() == (
        f"image: {tmp_path}/map.pgm\nresolution: 0.050000\n"
        "origin: [-10.000000, -10.500000, 0.000000]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n"
    )


def test_map_saver_of_nav2_writes_these_bytes(tmp_path: Path) -> None:
    image, described = write_map(_grid(), tmp_path / "map", SaveOptions(ros_version=2))
    assert image.read_bytes().startswith(b"P5\n3 3\n255\n\xcd\xfe\xcd")
    assert described.read_text() == (
        "image: map.pgm\nmode: trinary\nresolution: 0.05\norigin: [-10, -10.5, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196"
    )


def test_the_published_map_of_turtlebot3_is_written_as_it_was(
    workspaces_dir: Path, tmp_path: Path
) -> None:
    folder = workspaces_dir / "turtlebot3_ws/src/turtlebot3/turtlebot3_navigation/maps"
    grid = _read(folder / "map.yaml")
    assert (grid.width, grid.height) == (384, 384)
    assert grid.origin == (-10.0, -10.0, 0.0)
    image, _described = write_map(grid, tmp_path / "map")
    original = (folder / "map.pgm").read_bytes()
    assert image.read_bytes() == original.replace(b"Map_generator.cpp", b"map_saver.cpp")


@pytest.mark.parametrize("mode", [MapMode.SCALE, MapMode.RAW])
@pytest.mark.parametrize("kind", ["png", "bmp"])
def test_every_cell_comes_back(tmp_path: Path, mode: MapMode, kind: str) -> None:
    cells = np.arange(-1, 101, dtype=np.int8)[None].repeat(2, axis=0)
    if mode is MapMode.SCALE and kind == "bmp":
        cells = np.abs(cells)  # BMP as Pillow writes it keeps opacity, readers of old may not
    options = SaveOptions(2, mode, kind, occupied_thresh=1.0, free_thresh=0.0)
    _image, described = write_map(OccupancyGrid(cells, 0.1), tmp_path / "m", options)
    np.testing.assert_array_equal(_read(described, ros_version=2).cells, cells)


@pytest.mark.parametrize("ros_version", [1, 2])
def test_trinary_maps_come_back_as_three_values(tmp_path: Path, ros_version: int) -> None:
    _image, described = write_map(_grid(), tmp_path / "m", SaveOptions(ros_version))
    want = [[0, 100, -1], [0, -1, 100], [-1, 0, -1]]
    np.testing.assert_array_equal(_read(described, ros_version).cells, want)


def _one(grey: int | tuple[int, ...], mode: MapMode, ros_version: int, **options: object) -> int:
    pixel = np.array(grey, np.uint8).reshape(1, 1, -1)
    return int(cells_of_pixels(pixel, mode, ros_version=ros_version, **options)[0, 0])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("grey", "mode", "ros1", "ros2"),
    [
        (0, MapMode.TRINARY, 100, 100),
        (254, MapMode.TRINARY, 0, 0),
        (205, MapMode.TRINARY, -1, -1),
        (206, MapMode.TRINARY, 0, 0),
        (128, MapMode.SCALE, 66, 67),
        (42, MapMode.RAW, 42, 42),
        (100, MapMode.RAW, 100, 100),
        (205, MapMode.RAW, -51, -1),
        (255, MapMode.RAW, -1, -1),
        # Opacity is averaged in with the colours in trinary mode.
        ((0, 0, 0, 255), MapMode.TRINARY, 100, 100),
        ((255, 255, 255, 0), MapMode.TRINARY, -1, -1),
        ((128, 128, 128, 0), MapMode.SCALE, -1, -1),
        ((0, 0, 0, 0), MapMode.SCALE, 100, -1),
    ],
)
def test_grey_values_mean_what_each_program_makes_of_them(
    grey: int | tuple[int, ...], mode: MapMode, ros1: int, ros2: int
) -> None:
    assert _one(grey, mode, 1) == ros1
    assert _one(grey, mode, 2) == ros2


def test_negate_makes_white_occupied() -> None:
    assert _one(255, MapMode.TRINARY, 1, negate=True) == 100
    assert _one(0, MapMode.TRINARY, 2, negate=True) == 0


def test_rows_of_a_picture_start_on_top(tmp_path: Path) -> None:
    (tmp_path / "map.yaml").write_text(_YAML)
    (tmp_path / "map.pgm").write_bytes(b"P5\n1 2\n255\n" + bytes([0, 254]))
    np.testing.assert_array_equal(_read(tmp_path / "map.yaml").cells, [[0], [100]])


def test_png_with_16_bits_is_read(tmp_path: Path) -> None:
    (tmp_path / "map.yaml").write_text(_YAML.replace("pgm", "png"))
    deep = np.array([[0, 65535]], np.uint16)
    Image.fromarray(deep).save(tmp_path / "map.png")
    np.testing.assert_array_equal(_read(tmp_path / "map.yaml").cells, [[100, 0]])


def test_a_missing_picture_is_told_with_the_nearest_name(tmp_path: Path) -> None:
    (tmp_path / "map1.pgm").write_bytes(b"P5\n1 1\n255\n\0")
    text = _findings(tmp_path, _YAML)["map.no-image"]
    assert f'failed to open image file "{tmp_path}/map.pgm"' in text
    assert "map.yaml:1:1" in text
    assert "did you mean 'map1.pgm'" in text


@pytest.mark.parametrize("resolution", ["0.05", "0"])
def test_a_missing_picture_is_told_in_nav2s_words_in_ros_2(tmp_path: Path, resolution: str) -> None:
    text = _findings(tmp_path, _YAML.replace("0.05", resolution), ros_version=2)["map.no-image"]
    assert f"Failed to load image file {tmp_path}/map.pgm for reason: there is no such" in text
    assert "ROS/Gazebo says: Failed to load image file" in text


def test_a_broken_picture_is_told_in_nav2s_words_in_ros_2(tmp_path: Path) -> None:
    (tmp_path / "map.pgm").write_bytes(b"no picture")
    text = _findings(tmp_path, _YAML, ros_version=2)["map.bad-image"]
    assert f"Failed to load image file {tmp_path}/map.pgm for reason: it is no picture" in text


@pytest.mark.parametrize(
    ("line", "instead", "says"),
    [
        ("resolution: 0.05", "resolution: 0", "'resolution' is 0 m, it must be above 0"),
        ("resolution: 0.05", "resolution: five", "'resolution' is 'five', not a number"),
        ("resolution: 0.05", "resolution: .nan", "'resolution' is nan, not a number"),
        ("resolution: 0.05\n", "", "the map does not contain the tag 'resolution'"),
        ("[-1.0, -2.0, 0.0]", "[-1.0, -2.0]", "'origin' is [-1.0, -2.0], not [x, y, yaw]"),
        ("negate: 0", "negate: 7", "'negate' is 7, it is 0 or 1"),
        ("0.65", "65", "'occupied_thresh' is 65, it lies in 0 … 1"),
        ("0.196", "0.7", "'free_thresh' 0.7 is above 'occupied_thresh' 0.65"),
        ("negate: 0", "negate: 0\nmode: tri", "Invalid mode tag 'tri'"),
    ],
)
def test_bad_values_are_told_with_their_line(
    tmp_path: Path, line: str, instead: str, says: str
) -> None:
    text = _findings(tmp_path, _YAML.replace(line, instead))["map.bad-value"]
    assert says in text
    assert "map.yaml" in text


def test_all_bad_values_are_told_at_once(tmp_path: Path) -> None:
    (tmp_path / "map.yaml").write_text("image: 5\nresolution: x\norigin: 3\n")
    found = Diagnostics()
    assert read_map(tmp_path / "map.yaml", found) is None
    assert len(found.by_code("map.bad-value")) == 6


def test_a_missing_picture_is_told_beside_bad_values(tmp_path: Path) -> None:
    found = _findings(tmp_path, _YAML.replace("resolution: 0.05", "resolution: 0"))
    assert "'resolution' is 0 m" in found["map.bad-value"]
    assert "there is no such file" in found["map.no-image"]


def test_a_resolution_in_centimetres_is_told(tmp_path: Path) -> None:
    (tmp_path / "map.pgm").write_bytes(b"P5\n1 1\n255\n\0")
    text = _findings(tmp_path, _YAML.replace("0.05", "50"))["map.odd-resolution"]
    assert "50 m wide" in text
    assert "metres per cell" in text


def test_an_unknown_key_is_told(tmp_path: Path) -> None:
    (tmp_path / "map.pgm").write_bytes(b"P5\n1 1\n255\n\0")
    text = _findings(tmp_path, _YAML + "ocupied_thresh: 0.9\n")["map.unknown-key"]
    assert "did you mean 'occupied_thresh'" in text


def test_a_picture_given_for_the_yaml_is_told(tmp_path: Path) -> None:
    found = Diagnostics()
    (tmp_path / "map.pgm").write_bytes(b"P5\n1 1\n255\n\xff")
    assert read_map(tmp_path / "map.pgm", found) is None
    (item,) = found.by_code("map.unreadable")
    assert "give the .yaml, not the picture" in item.fix


def test_a_missing_yaml_is_told(tmp_path: Path) -> None:
    found = Diagnostics()
    assert read_map(tmp_path / "none.yaml", found) is None
    assert found.by_code("map.unreadable")[0].phrase == "Map_server could not open"


@pytest.mark.parametrize("text", ["image: [", "just words", "- a\n- b\n"])
def test_what_is_no_mapping_is_told(tmp_path: Path, text: str) -> None:
    assert "no YAML of a map" in _findings(tmp_path, text)["map.no-yaml"]


@pytest.mark.parametrize("data", [b"", b"P5\n9 9\n255\n\0", b"no picture"])
def test_a_broken_picture_is_told(tmp_path: Path, data: bytes) -> None:
    (tmp_path / "map.pgm").write_bytes(data)
    assert "failed to open image file" in _findings(tmp_path, _YAML)["map.bad-image"]


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (SaveOptions(mode=MapMode.RAW), "nav2_map_server's map_saver_cli writes the others"),
        (SaveOptions(2, image_format="pmg"), "did you mean 'png' or 'pgm'"),
        (SaveOptions(2, occupied_thresh=1.5), "must be 1.0 or less"),
        (SaveOptions(2, free_thresh=-0.5), "must be 0.0 or greater"),
        (SaveOptions(2, occupied_thresh=0.2), "must be smaller than threshold_occupied"),
    ],
)
def test_contradicting_options_are_refused(tmp_path: Path, options: SaveOptions, says: str) -> None:
    with pytest.raises(MapWriteError, match=says):
        write_map(_grid(), tmp_path / "map", options)


def test_a_folder_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(MapWriteError, match="Couldn't save map file"):
        write_map(_grid(), tmp_path / "none" / "map")
