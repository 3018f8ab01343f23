"""ros2 interface."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest

_MANIFEST = (
    "<package format='3'><name>{}</name><version>0.0.1</version><description/>"
    "<maintainer email='a@b.c'>a</maintainer><license>MIT</license>"
    "<export><build_type>ament_cmake</build_type></export></package>"
)


@pytest.fixture
def own_types(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A package of the user's with comments in its definitions."""
    folder = tmp_path / "src" / "shop"
    (folder / "msg").mkdir(parents=True)
    (folder / "package.xml").write_text(_MANIFEST.format("shop"), encoding="utf-8")
    (folder / "msg" / "Price.msg").write_text(
        "# in cents\n\nint32 cents  # never negative\n", encoding="utf-8"
    )
    (folder / "msg" / "Item.msg").write_text(
        '# sold\nstring name "a # b"\nPrice[<=3] prices # all\nstring CODE="#1"\n',
        encoding="utf-8",
    )
    monkeypatch.chdir(tmp_path)


def test_show_indents_the_fields_of_fields(run: Any) -> None:
    assert run("ros2", "interface", "show", "geometry_msgs/msg/PointStamped") == (
        0,
        "std_msgs/Header header\n\tbuiltin_interfaces/Time stamp\n\t\tint32 sec\n"
        "\t\tuint32 nanosec\n\tstring frame_id\n"
        "Point point\n\tfloat64 x\n\tfloat64 y\n\tfloat64 z\n",
        "",
    )
    assert run("ros2", "interface", "show", "std_srvs/srv/SetBool").out == (
        "bool data\n---\nbool success\nstring message\n"
    )


def test_comments_are_shown_as_asked(own_types: None, run: Any) -> None:
    show = ("ros2", "interface", "show", "shop/msg/Item")
    assert run(*show).out == (
        '# sold\nstring name "a # b"\nPrice[<=3] prices # all\n\tint32 cents\nstring CODE="#1"\n'
    )
    assert run(*show, "--all-comments").out == (
        '# sold\nstring name "a # b"\nPrice[<=3] prices # all\n\t# in cents\n\n'
        '\tint32 cents  # never negative\nstring CODE="#1"\n'
    )
    assert run(*show, "--no-comments").out == (
        'string name "a # b"\nPrice[<=3] prices\n\tint32 cents\nstring CODE="#1"\n'
    )
    assert run(*show, "--no-comments", "--all-comments").code == 2


def test_packages_of_the_workspace_are_listed(own_types: None, run: Any) -> None:
    assert run("ros2", "interface", "package", "shop").out == "shop/msg/Item\nshop/msg/Price\n"
    assert "shop\n" in run("ros2", "interface", "packages", "-m").out
    assert "shop" not in run("ros2", "interface", "packages", "-s").out


def test_show_reads_standard_input(run: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("std_msgs/msg/String\n"))
    assert run("ros2", "interface", "show", "-").out == "string data\n"
    monkeypatch.setattr("sys.stdin", io.StringIO("\n"))
    assert run("ros2", "interface", "show", "-").code == 1


@pytest.mark.parametrize(
    ("name", "words"),
    [
        (
            "std_msgs/String",
            "Invalid name 'std_msgs/String'. Expected three parts separated by '/'\n"
            "  did you mean 'std_msgs/msg/String'?\n",
        ),
        ("std_msgs/msg/Strin", "Could not find the interface 'std_msgs/msg/Strin'\n  did you"),
        ("std_mgs/msg/String", "Unknown package 'std_mgs'\n  did you mean 'std_msgs/msg/String'"),
        ("std_msgs/mgs/String", "Could not find the interface 'std_msgs/mgs/String'"),
    ],
)
def test_unknown_names_are_told(run: Any, name: str, words: str) -> None:
    for verb in ("show", "proto"):
        code, out, error = run("ros2", "interface", verb, name)
        assert (code, out) == (1, "")
        assert error.startswith(words)


def test_proto_is_yaml_to_copy(run: Any) -> None:
    assert run("ros2", "interface", "proto", "geometry_msgs/msg/Point").out == (
        '"x: 0.0\ny: 0.0\nz: 0.0\n"\n'
    )
    out = run("ros2", "interface", "proto", "--no-quotes", "example_interfaces/srv/AddTwoInts").out
    assert out == "a: 0\nb: 0\n\n"
    action = "example_interfaces/action/Fibonacci"
    assert run("ros2", "interface", "proto", action).out == '"order: 0\n"\n'


def test_list_has_three_parts_and_the_types_of_ros2(run: Any) -> None:
    text = run("ros2", "interface", "list").out
    heads = [line for line in text.splitlines() if not line.startswith(" ")]
    assert heads == ["Messages:", "Services:", "Actions:"]
    assert "    geometry_msgs/msg/Twist\n" in text
    assert "nav2_msgs/srv/" in text
    # Of ROS 1 alone.
    assert "rosgraph_msgs/msg/Log" not in text
    only = run("ros2", "interface", "list", "-a").out
    assert only.startswith("Actions:\n    ")
    assert "/srv/" not in only


def test_package_lists_its_types(run: Any) -> None:
    assert run("ros2", "interface", "package", "std_srvs").out == (
        "std_srvs/srv/Empty\nstd_srvs/srv/SetBool\nstd_srvs/srv/Trigger\n"
    )
    assert run("ros2", "interface", "package", "-m", "std_srvs") == (0, "", "")
    assert run("ros2", "interface", "package", "rviz2") == (0, "", "")
    code, _, error = run("ros2", "interface", "package", "std_srs")
    assert code == 1
    assert error.startswith("Unknown package 'std_srs'\n  did you mean 'std_srvs'")
