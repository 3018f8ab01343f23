"""``gazelle record`` on files, launches and running worlds."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from gazelle.cli.main import main
from gazelle.simulator import Simulation

CART = """<robot name="cart">
  <link name="body"><inertial><mass value="1"/>
    <inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><box size="0.4 0.3 0.2"/></geometry></visual>
    <collision><geometry><box size="0.4 0.3 0.2"/></geometry></collision></link>
  <link name="eye"/>
  <joint name="seat" type="fixed"><parent link="body"/><child link="eye"/></joint>
</robot>"""


@pytest.fixture(autouse=True)
def _in_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.chdir(tmp_path)
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "GAZEBO_MODEL_PATH"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "cart.urdf").write_text(CART)
    before = signal.getsignal(signal.SIGTERM)
    yield
    signal.signal(signal.SIGTERM, before)


def _stop_after(monkeypatch: pytest.MonkeyPatch, count: int) -> None:
    """Let Ctrl-C come in the midst of a simulation."""
    run = Simulation.run
    calls: list[float] = []

    def interrupted(self: Simulation, *, seconds: float) -> None:
        calls.append(seconds)
        if len(calls) > count:
            raise KeyboardInterrupt
        run(self, seconds=seconds)

    monkeypatch.setattr(Simulation, "run", interrupted)


def _files(folder: Path) -> set[str]:
    return {one.name for one in folder.iterdir()} - {"cart.urdf"}


def test_a_robots_file_becomes_a_page_a_film_and_a_picture(tmp_path: Path, capsys: Any) -> None:
    outputs = ["-o", "run.html", "-o", "run.webp", "-o", "run.png"]
    size = ["--size", "64x48", "--fps", "10", "--camera", "fixed:cart"]
    assert main(["record", *outputs, *size, "-s", "0.5", "cart.urdf"]) == 0
    page, film, picture = capsys.readouterr().out.splitlines()
    assert page.startswith("run.html: 0.5 s, ")
    assert film.startswith("run.webp: 64x48, 5 frames, 0.5 s, ")
    assert picture.startswith("run.png: 64x48, ")
    with Image.open("run.webp") as image:
        assert image.size == (64, 48)
    assert "<title>cart</title>" in (tmp_path / "run.html").read_text(encoding="utf-8")
    assert _files(tmp_path) == {"run.html", "run.webp", "run.png"}


def test_equal_words_give_equal_bytes_and_run_html_is_the_usual_name(tmp_path: Path) -> None:
    words = ["--size", "64x48", "--fps", "5", "-s", "0.4", "cart.urdf"]
    assert main(["record", "-o", "a.webp", *words]) == 0
    assert main(["record", "-o", "b.webp", *words]) == 0
    assert (tmp_path / "a.webp").read_bytes() == (tmp_path / "b.webp").read_bytes()
    assert main(["record", "-s", "0.1", "--title", "My cart", "cart.urdf"]) == 0
    assert "<title>My cart</title>" in (tmp_path / "run.html").read_text(encoding="utf-8")


def test_delay_and_speed_choose_what_is_shown(capsys: Any) -> None:
    words = ["--size", "32x24", "--fps", "10", "-s", "0.8", "--delay", "0.2", "--speed", "2"]
    assert main(["record", "-o", "a.webp", *words, "cart.urdf"]) == 0
    assert "a.webp: 32x24, 4 frames, 0.4 s" in capsys.readouterr().out


def test_ctrl_c_ends_the_recording_and_what_there_is_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    _stop_after(monkeypatch, 2)
    assert main(["record", "-o", "a.html", "-o", "a.png", "-s", "0", "cart.urdf"]) == 0
    assert capsys.readouterr().out.startswith("a.html: 0.5 s, ")
    assert _files(tmp_path) == {"a.html", "a.png"}


def test_ctrl_c_in_the_drawing_keeps_the_frames_and_says_how_many(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    from gazelle.video import film

    drawn = film._drawn

    def interrupted(*words: Any) -> Iterator[Any]:
        for number, frame in enumerate(drawn(*words)):
            if number == 3:
                raise KeyboardInterrupt
            yield frame

    monkeypatch.setattr(film, "_drawn", interrupted)
    words = ["--size", "32x24", "--fps", "10", "-s", "1", "cart.urdf"]
    assert main(["record", "-o", "a.webp", "-o", "b.webp", *words]) == 130
    assert capsys.readouterr().out.startswith("a.webp: 3 of 10 frames, ended early")
    assert _files(tmp_path) == {"a.webp"}


def test_ctrl_c_before_there_is_anything_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    _stop_after(monkeypatch, 0)
    assert main(["record", "-o", "a.png", "-s", "1", "--delay", "2", "cart.urdf"]) == 1
    assert "the run ended after 0.0 s, before the 2 s of --delay were over" in (
        capsys.readouterr().err
    )
    assert _files(tmp_path) == set()


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["-o", "a.gif"], "'a.gif': '.gif' is not written; end it with .html, .webp, .mp4"),
        (["-o", "a"], "'a': a name without an ending is not written; end it with .html"),
        (["-s", "-1"], "'-1' is no number of 0 or more"),
        (["--fps", "0"], "'0' is no number above 0"),
        (["--size", "9x9"], "'9x9' is no size of 16 to 8192 pixels, as 640x400"),
        (["--look-at", "0", "0", "0"], "--look-at needs --eye"),
    ],
)
def test_words_that_cannot_be_are_told(capsys: Any, words: list[str], text: str) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["record", *words, "cart.urdf"])
    assert ended.value.code == 2
    assert text in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["carts.urdf"], "robot or world 'carts.urdf' not found; did you mean 'cart.urdf'?"),
        (["my.launch"], "in a package? gazelle record -o OUT PACKAGE my.launch"),
        (["gazebo_ros", "a.urdf"], "robots and worlds there: none"),
        (["a", "b", "c"], "'a b c': name one file, or a package and a file in it"),
        (["-o", "no/a.webp", "cart.urdf"], "no/a.webp cannot be written: there is no folder"),
        (["--fast", "a", "b.launch.py"], "--fast works with roslaunch's files"),
        (["-o", "a.png", "-s", "0.1", "--camera", "nose", "cart.urdf"], "cameras there: none; a"),
        (["-o", "a.png", "-s", "0.1", "--camera", "follow:car", "cart.urdf"],
         "did you mean 'cart'"),
    ],
)  # fmt: skip
def test_what_is_not_there_is_told_with_what_to_do(
    capsys: Any, words: list[str], text: str
) -> None:
    assert main(["record", *words]) == 1
    assert text in capsys.readouterr().err


def test_a_missing_encoder_is_told_before_the_run(
    monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "imageio_ffmpeg", None)
    monkeypatch.setattr(Simulation, "load", lambda *_: pytest.fail("it was run"))
    assert main(["record", "-o", "a.mp4", "cart.urdf"]) == 1
    text = "MP4 files need imageio-ffmpeg; pip install 'gazelle-sim[bags]', or write .webp"
    assert text in capsys.readouterr().err


def test_without_a_graph_it_says_what_to_start(
    free_port: int, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    assert main(["record", "-o", "a.html"]) == 1
    assert f"no graph is running on port {free_port}" in capsys.readouterr().err


def test_a_launch_that_ends_early_is_told_with_what_it_printed(capsys: Any) -> None:
    Path("bad.launch").write_text("<launch><node pkg='nowhere' type='a' name='a'/></launch>")
    assert main(["record", "bad.launch"]) == 1
    text = capsys.readouterr().err
    assert "roslaunch bad.launch: the launch has ended with exit code 1" in text
    assert "'nowhere' not found" in text


@pytest.mark.slow(10)
def test_a_launch_is_started_recorded_and_ended(
    examples_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.chdir(examples_dir / "scout_ws")
    output = str(tmp_path / "run.html")
    assert main(["record", "-o", output, "-s", "1", "scout_robot", "scout.launch"]) == 0
    assert capsys.readouterr().out.startswith(f"{output}: ")
    page = Path(output).read_text(encoding="utf-8")
    assert "<title>scout" in page
    assert len(page) < 400_000


def test_ctrl_c_before_there_is_a_world_ends_the_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    from gazelle.recording import GraphRecorder

    def interrupted(*_words: Any) -> bool:
        raise KeyboardInterrupt

    monkeypatch.setattr(GraphRecorder, "wait_for_world", interrupted)
    Path("empty.launch").write_text("<launch/>")
    assert main(["record", "-o", "a.html", "empty.launch"]) == 130
    assert capsys.readouterr().err == ""
    assert _files(tmp_path) == {"empty.launch"}
