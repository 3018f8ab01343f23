"""rosmsg and rossrv."""

from __future__ import annotations

import pytest


def test_show_is_that_of_ros(run, recorded) -> None:
    assert run("rosmsg", "show", "sensor_msgs/JointState") == recorded("msg_show")
    assert run("rosmsg", "info", "sensor_msgs/JointState.msg") == recorded("msg_show")
    assert run("rossrv", "show", "std_srvs/SetBool") == recorded("srv_show")


def test_md5_and_package_are_those_of_ros(run, recorded) -> None:
    assert run("rosmsg", "md5", "sensor_msgs/LaserScan") == recorded("msg_md5")
    assert run("rosmsg", "package", "sensor_msgs") == recorded("msg_pkg")


def test_a_short_name_shows_all_of_that_name(run) -> None:
    assert run("rosmsg", "show", "String").out == "[std_msgs/String]:\nstring data\n\n"
    assert run("rosmsg", "md5", "String").out == (
        "[std_msgs/String]: 992ce8a1687cec8c8bd883ec73ca41d1\n"
    )


def test_raw_text_keeps_the_words_of_the_definition(run) -> None:
    assert run("rosmsg", "show", "-r", "std_msgs/String").out == "string data\n"
    assert run("rossrv", "show", "-r", "std_srvs/SetBool").out == (
        "bool data\n---\nbool success\nstring message\n"
    )


def test_lists_hold_what_ros1_has(run) -> None:
    messages = run("rosmsg", "list").out.splitlines()
    assert "geometry_msgs/Twist" in messages
    assert "builtin_interfaces/Time" not in messages
    assert messages == sorted(messages)
    assert "std_srvs/SetBool" in run("rossrv", "list").out.splitlines()
    packages = run("rosmsg", "packages", "-s").out.split()
    assert "sensor_msgs" in packages
    assert "std_srvs" not in packages


def test_unknown_names_are_errors_that_help(run) -> None:
    short = run("rosmsg", "show", "Twst")
    assert (short.code, short.err) == (1, "Could not find msg 'Twst'\n  did you mean 'Twist'?\n")
    full = run("rosmsg", "show", "geometry_msgs/Twst")
    assert full.code == 1
    assert full.err.startswith("ERROR: Unable to load msg [geometry_msgs/Twst]: ")
    package = run("rosmsg", "package", "sensor_msg")
    assert package.code == 64
    assert package.err.startswith("Invalid package: sensor_msg\n  did you mean 'sensor_msgs'")
    assert run("rosmsg", "show", "std_msgs::String").code == 2


def test_types_of_the_workspace_are_known(run, tmp_path, monkeypatch) -> None:
    package = tmp_path / "src" / "my_bot_msgs"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package format='2'><name>my_bot_msgs</name><version>0.1.0</version>"
        "<description>d</description><maintainer email='a@b.c'>m</maintainer>"
        "<license>MIT</license><buildtool_depend>catkin</buildtool_depend></package>"
    )
    (package / "msg" / "Wheel.msg").write_text("# a wheel\nint32 LEFT=1\nfloat64 speed\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    out = run("rosmsg", "show", "my_bot_msgs/Wheel").out
    assert out == "int32 LEFT=1\nfloat64 speed\n\n"
    assert "my_bot_msgs/Wheel" in run("rosmsg", "list").out.splitlines()


@pytest.mark.parametrize(("words", "code"), [([], 0), (["nonsense"], 64), (["--help"], 0)])
def test_usage_names_the_commands(run, words: list[str], code: int) -> None:
    found = run("rosmsg", *words)
    assert found.code == code
    assert "\trosmsg show\tShow message description\n" in found.out
