"""turtlebot3_teleop_key: steps, limits, words."""

from __future__ import annotations

import termios

import pytest

from gazelle.nodes.turtlebot3.teleop import Speeds, limits_of

_NODE = "turtlebot3_teleop/turtlebot3_teleop_key"


def _is_taken(keyboard) -> bool:
    return keyboard.settings[3] & (termios.ECHO | termios.ISIG) == 0


@pytest.mark.parametrize(
    ("model", "linear", "angular"),
    [("burger", 0.22, 2.84), ("waffle", 0.26, 1.82), ("waffle_pi", 0.26, 1.82), ("", 0.22, 2.84)],
)
def test_speeds_end_at_the_robots_limits(model: str, linear: float, angular: float) -> None:
    speeds = Speeds(limits_of(model))
    for _count in range(60):
        assert speeds.press("w")
        assert speeds.press("d")
    assert (speeds.linear_m_s, speeds.angular_rad_s) == (linear, -angular)


def test_sent_speeds_follow_by_half_a_step() -> None:
    speeds = Speeds(limits_of("burger"))
    speeds.press("w")
    speeds.press("a")
    assert [speeds.advance() for _ in range(3)] == [(0.005, 0.05), (0.01, 0.1), (0.01, 0.1)]


@pytest.mark.parametrize("key", ["s", " "])
def test_stop_is_at_once(key: str) -> None:
    speeds = Speeds(limits_of("burger"))
    for _count in range(5):
        speeds.press("x")
        speeds.advance()
    assert speeds.press(key)
    assert speeds.advance() == (0.0, 0.0)


def test_other_keys_mean_nothing() -> None:
    assert not Speeds(limits_of("burger")).press("k")


def test_keys_drive_and_ctrl_c_stops_the_robot(bench, keyboard, capfd) -> None:
    bench.node.parameters.set("/model", "waffle")
    twists = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    bench.start(_NODE)
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("wwa")
    bench.eventually(lambda: twists and twists[-1].linear.x == 0.02)
    bench.eventually(lambda: twists[-1].angular.z == 0.1)
    keyboard.type("w" * 30)
    bench.eventually(lambda: twists[-1].linear.x >= 0.05)
    keyboard.type("\x03")
    assert bench.wait() == [0]
    bench.eventually(lambda: (twists[-1].linear.x, twists[-1].angular.z) == (0.0, 0.0))
    assert keyboard.settings == keyboard.before
    text = capfd.readouterr().out
    assert text.startswith(
        "\nControl Your TurtleBot3!\n---------------------------\nMoving around:"
    )
    assert "currently:\tlinear vel 0.01\t angular vel 0.0 \n" in text
    assert "currently:\tlinear vel 0.26\t angular vel 0.1 \n" in text
    assert text.count("CTRL-C to quit\n\n") == 2


def test_ros2_name_takes_the_model_of_the_environment(bench, keyboard, capfd, monkeypatch) -> None:
    monkeypatch.setenv("TURTLEBOT3_MODEL", "waffle")
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    twists = bench.listen("/cmd_vel", "geometry_msgs/msg/TwistStamped")
    bench.start("turtlebot3_teleop/teleop_keyboard", "--ros-args")
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("w")
    bench.eventually(lambda: twists and twists[-1].twist.linear.x == 0.01)
    assert twists[-1].header.stamp.sec > 0
    assert bench.stop() == [0]
    words = "currently:\tlinear velocity 0.01\t angular velocity 0.0 \n"
    assert words in capfd.readouterr().out
