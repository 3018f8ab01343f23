"""Exported files hold the numbers and pictures that were recorded."""

from __future__ import annotations

import csv
import importlib.util
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.bag import BagError, Storage, cdr_connection, create_bag, open_bag
from gazelle.bag.export import export_bag, picture
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type, to_cdr


def _image(encoding: str, pixels: np.ndarray) -> Any:
    height, width = pixels.shape[:2]
    data = np.frombuffer(pixels.tobytes(), np.uint8)
    return message_type("sensor_msgs/msg/Image")(
        height=height, width=width, encoding=encoding, step=len(data) // height, data=data
    )


@pytest.fixture
def filmed(tmp_path: Path) -> Path:
    """Ten red images at 20 Hz."""
    writer = create_bag(tmp_path / "a.mcap", Storage.MCAP)
    camera = writer.add(cdr_connection("/camera/image_raw", "sensor_msgs/msg/Image"))
    pixels = np.zeros((32, 48, 3), np.uint8)
    pixels[..., 0] = 250
    for place in range(10):
        writer.write(camera, 10**18 + place * 50_000_000, to_cdr(_image("rgb8", pixels)))
    writer.close()
    return tmp_path / "a.mcap"


def test_csv_has_a_row_for_every_message(bag_of: Callable, tmp_path: Path) -> None:
    bag = open_bag(bag_of("a.bag"))
    (path,) = export_bag(bag, tmp_path / "out", "csv", topics=["/point"], diagnostics=Diagnostics())
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 50
    assert (rows[3]["point.x"], rows[3]["header.frame_id"]) == ("6.0", "map")
    assert float(rows[3]["time_s"]) == pytest.approx(1.7e9 + 0.06)


def test_parquet_has_the_same_columns(bag_of: Callable, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    bag = open_bag(bag_of("a.mcap"))
    files = export_bag(bag, tmp_path / "out", "parquet", diagnostics=Diagnostics())
    table = parquet.read_table(next(one for one in files if one.stem == "point"))
    assert table.num_rows == 50 and table["point.x"].to_pylist()[-1] == 98.0


def test_png_holds_the_colours(filmed: Path, tmp_path: Path) -> None:
    from PIL import Image

    files = export_bag(open_bag(filmed), tmp_path / "out", "png", diagnostics=Diagnostics())
    assert len(files) == 10
    assert np.asarray(Image.open(files[4]))[3, 5].tolist() == [250, 0, 0]


def test_mp4_lasts_as_long_as_the_recording(filmed: Path, tmp_path: Path) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    (path,) = export_bag(open_bag(filmed), tmp_path / "out", "mp4", diagnostics=Diagnostics())
    about = next(ffmpeg.read_frames(str(path)))
    assert about["size"] == (48, 32) and about["fps"] == pytest.approx(20)


@pytest.mark.parametrize(("form", "module"), [("parquet", "pyarrow"), ("mp4", "imageio_ffmpeg")])
def test_a_missing_library_is_named_with_its_command(
    filmed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, form: str, module: str
) -> None:
    monkeypatch.setitem(__import__("sys").modules, module, None)
    with pytest.raises(BagError, match=r"pip install 'gazelle-sim\[bags\]'"):
        export_bag(open_bag(filmed), tmp_path / "out", form, diagnostics=Diagnostics())
    assert importlib.util.find_spec("PIL") is not None


def test_pictures_of_every_kind_of_pixel() -> None:
    ramp = np.array([[0, 100], [200, 250]], np.uint8)
    assert picture(_image("mono8", ramp))[1, 0].tolist() == [200, 200, 200]
    depth = np.array([[1.0, 2.0], [3.0, np.nan]], np.float32)
    assert picture(_image("32FC1", depth))[..., 0].tolist() == [[0, 127], [255, 255]]
    blue = np.zeros((2, 2, 3), np.uint8)
    blue[..., 0] = 9
    assert picture(_image("bgr8", blue))[0, 0].tolist() == [0, 0, 9]
    with pytest.raises(BagError, match="encoding 'yuv' are not drawn"):
        picture(_image("yuv", ramp))


def test_topics_that_are_not_there_are_told(bag_of: Callable, tmp_path: Path) -> None:
    bag = open_bag(bag_of("a.bag"))
    with pytest.raises(BagError, match="no topic /poin, but /point, /word"):
        export_bag(bag, tmp_path, "csv", topics=["/poin"], diagnostics=Diagnostics())
    with pytest.raises(BagError, match="no topic holds images"):
        export_bag(bag, tmp_path, "png", diagnostics=Diagnostics())
