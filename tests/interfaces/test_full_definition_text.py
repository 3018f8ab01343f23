"""Whole texts of definitions: whose text counts, and how they are put together."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from gazelle.interfaces import (
    RosVersion,
    add_package,
    default_types,
    full_definition_text,
    keep_text,
    ros1_definition,
    ros2_definition,
)

RULE = "=" * 80
HEADER = "# Of the test.\nuint32 seq\n# When.\ntime stamp # since 1970\nstring frame_id\n"


@pytest.fixture(autouse=True)
def bare_machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No ROS is installed."""
    monkeypatch.setattr(full_definition_text, "_SYSTEM", tmp_path / "usr")
    monkeypatch.setattr(full_definition_text, "_DISTRIBUTIONS", tmp_path / "opt")
    for name in full_definition_text._VARIABLES:
        monkeypatch.delenv(name, raising=False)
    default_types().look_again()
    yield
    default_types().look_again()


def put(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def module(text: str) -> str:
    head = "import genpy\nclass Header(genpy.Message):\n"
    return f'{head}  _full_text = """{text}"""\n  __slots__ = []\n'


def test_without_a_ros_the_text_has_no_comments() -> None:
    assert ros1_definition("std_msgs/Header") == "uint32 seq\ntime stamp\nstring frame_id\n"


@pytest.mark.parametrize(
    "place", ["usr/share", "opt/noetic/share", "ament/share", "src", "std_msgs"]
)
def test_installed_texts_are_found_everywhere(
    place: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    variable = {"ament/share": "AMENT_PREFIX_PATH"}.get(place, "ROS_PACKAGE_PATH")
    monkeypatch.setenv(variable, str(tmp_path / place.removesuffix("/share")))
    folder = tmp_path / place if place == "std_msgs" else tmp_path / place / "std_msgs"
    put(folder / "msg" / "Header.msg", HEADER)
    assert ros1_definition("std_msgs/Header") == HEADER


def test_texts_of_genpy_modules_are_read_not_run(tmp_path: Path) -> None:
    contained = f"{HEADER}\n{RULE}\nMSG: std_msgs/Other\nint32 x\n"
    text = "raise SystemExit\n" + module(contained.replace("Of the", r"\"\"\"Of the"))
    put(tmp_path / "usr/lib/python3/dist-packages/std_msgs/msg/_Header.py", text)
    assert ros1_definition("std_msgs/Header") == HEADER.replace("Of the", '"""Of the')


@pytest.mark.parametrize("text", ["int32 other\n", "uint32 seq\ntime stamp\n", "= = =\n", ""])
def test_texts_that_mean_something_else_do_not_count(text: str, tmp_path: Path) -> None:
    put(tmp_path / "usr/share/std_msgs/msg/Header.msg", text)
    put(tmp_path / "usr/lib/python3/dist-packages/std_msgs/msg/_Header.py", module(text))
    assert ros1_definition("std_msgs/Header") == "uint32 seq\ntime stamp\nstring frame_id\n"


def test_layout_is_that_of_genpy(tmp_path: Path) -> None:
    put(tmp_path / "usr/share/std_msgs/msg/Header.msg", HEADER)
    mine = "# Mine.\nHeader header\ngeometry_msgs/Vector3 a  # no line end"
    put(tmp_path / "my_msgs/msg/Mine.msg", mine)
    add_package("my_msgs", tmp_path / "my_msgs", RosVersion.ROS1)
    assert ros1_definition("my_msgs/Mine") == (
        f"{mine}\n{RULE}\nMSG: std_msgs/Header\n{HEADER}\n"
        f"{RULE}\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"
    )


def test_layout_of_rosbag2_is_by_name_and_depth_first(tmp_path: Path) -> None:
    mine = "std_msgs/Header header\ngeometry_msgs/Pose a\n"
    put(tmp_path / "my_msgs/msg/Mine.msg", mine)
    add_package("my_msgs", tmp_path / "my_msgs", RosVersion.ROS2)
    order = [
        line[5:] for line in ros2_definition("my_msgs/Mine").splitlines() if line[:4] == "MSG:"
    ]
    assert order == [
        "geometry_msgs/Pose", "geometry_msgs/Point", "geometry_msgs/Quaternion",
        "std_msgs/Header", "builtin_interfaces/Time",
    ]  # fmt: skip
    assert ros2_definition("my_msgs/Mine").startswith(f"{mine}\n{RULE}\nMSG: geometry_msgs/Pose\n")


def test_texts_of_ros2_are_installed_too(tmp_path: Path) -> None:
    text = "# Of the test.\nstring data\n"
    put(tmp_path / "opt/jazzy/share/std_msgs/msg/String.msg", text)
    assert ros2_definition("std_msgs/msg/String") == ros1_definition("std_msgs/String") == text


def test_the_text_that_came_in_counts_first(tmp_path: Path) -> None:
    put(tmp_path / "usr/share/std_msgs/msg/String.msg", "# Installed.\nstring data\n")
    assert keep_text("std_msgs/String", RosVersion.ROS1, "# Sent.\nstring data\n")
    assert ros1_definition("std_msgs/String") == "# Sent.\nstring data\n"
    assert not keep_text("std_msgs/String", RosVersion.ROS1, "int32 data\n")
    assert not keep_text("std_msgs/String", RosVersion.ROS1, "")
    assert not keep_text("no_msgs/None", RosVersion.ROS1, "int32 data\n")
    assert ros1_definition("std_msgs/String") == "# Sent.\nstring data\n"


@pytest.mark.reference
def test_every_text_of_debian_is_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    modules = Path("/usr/lib/python3/dist-packages")
    if not (modules / "std_msgs" / "msg" / "_Header.py").is_file():
        pytest.skip("ROS 1 is not installed (Debian: apt-get install python3-std-msgs …)")
    monkeypatch.setattr(full_definition_text, "_SYSTEM", Path("/usr"))
    for file in sorted(modules.glob("*_msgs/msg/_[A-Z]*.py")):
        found = full_definition_text._LITERAL.search(file.read_text())
        assert found is not None, file
        name = f"{file.parents[1].name}/{file.stem[1:]}"
        assert ros1_definition(name) == found[1][3:-3], name
