"""turtlesim on the graph: topics, services, parameters, the action, the picture."""

from __future__ import annotations

import math
import re
import threading

import numpy as np
import pytest
from tests.patience import stretched

from gazelle.errors import LaunchError
from gazelle.graph import ServiceCallError
from gazelle.graph.actions import ActionClient
from gazelle.interfaces import md5sum, message_type
from gazelle.nodes.host import run_node

_NODE = "turtlesim/turtlesim_node"
_BLUE = (69, 86, 255)


def _place(bench, turtle: str = "turtle1"):
    poses = bench.listen(f"/{turtle}/pose", "turtlesim/msg/Pose")
    return lambda: bench.eventually(lambda: poses)[-1]


def _rgb(message) -> tuple[int, int, int]:
    return message.r, message.g, message.b


def test_messages_are_turtlesims_own() -> None:
    assert md5sum("turtlesim/Pose") == "863b248d5016ca62ea2e895ae5265cf9"
    assert md5sum("turtlesim/Color") == "353891e354491c51aabe32df673fb446"


def test_names_and_texts_are_the_originals(bench, capfd) -> None:
    bench.start(_NODE)
    pose = _place(bench)()
    assert (pose.x, pose.y, pose.theta) == (5.544444561004639, 5.544444561004639, 0.0)
    assert "/turtlesim" in bench.graph.node_names()
    topics = dict(bench.graph.topic_names_and_types())
    assert {name for name in topics if name.startswith("/turtle")} == {
        "/turtle1/cmd_vel",
        "/turtle1/color_sensor",
        "/turtle1/pose",
    }
    services = {one.name for one in bench.graph.services()}
    assert services >= {
        "/clear",
        "/kill",
        "/reset",
        "/spawn",
        "/turtle1/set_pen",
        "/turtle1/teleport_absolute",
        "/turtle1/teleport_relative",
    }
    assert bench.stop() == [0]
    texts = "".join(capfd.readouterr())
    assert "Starting turtlesim with node name /turtlesim\n" in texts
    place = "at x=[5.544445], y=[5.544445], theta=[0.000000]"
    assert f"Spawning turtle [turtle1] {place}\n" in texts


def test_turtles_are_spawned_killed_and_reset_by_name(bench, capfd) -> None:
    bench.start(_NODE)
    for wanted, given in (("", "turtle2"), ("anna", "anna"), ("", "turtle3")):
        answer = bench.call("/spawn", "turtlesim/Spawn", x=2.0, y=3.0, theta=0.5, name=wanted)
        assert answer.name == given
    with pytest.raises(ServiceCallError, match=r"A turtled named \[anna\] already exists"):
        bench.call("/spawn", "turtlesim/Spawn", name="anna")
    assert (_place(bench, "anna")().x, _place(bench, "anna")().y) == pytest.approx((2.0, 3.0))
    bench.call("/kill", "turtlesim/Kill", name="anna")
    with pytest.raises(ServiceCallError, match="there is turtle1, turtle2, turtle3"):
        bench.call("/kill", "turtlesim/Kill", name="anna")
    bench.call("/reset", "std_srvs/Empty")
    bench.eventually(lambda: not any("turtle2" in one.name for one in bench.graph.services()))
    assert bench.call("/spawn", "turtlesim/Spawn").name == "turtle2"
    texts = "".join(capfd.readouterr())
    assert "Resetting turtlesim.\n" in texts
    assert "Tried to kill turtle [anna], which does not exist" in texts


def test_name_that_no_topic_can_have_is_refused_and_nothing_is_left(bench) -> None:
    bench.start(_NODE)
    with pytest.raises(ServiceCallError, match="illegal name '2nd'"):
        bench.call("/spawn", "turtlesim/Spawn", name="2nd")
    with pytest.raises(ServiceCallError, match="needs numbers for its place"):
        bench.call("/spawn", "turtlesim/Spawn", x=math.nan)
    assert bench.call("/spawn", "turtlesim/Spawn").name == "turtle2"


def test_background_counts_from_the_next_clear(bench) -> None:
    bench.start(_NODE)
    colors = bench.listen("/turtle1/color_sensor", "turtlesim/msg/Color")
    assert _rgb(bench.eventually(lambda: colors)[-1]) == _BLUE
    assert bench.node.parameters.get("/turtlesim/background_r") == 69
    bench.node.parameters.set("/turtlesim/background_r", 150)
    count = len(colors)
    bench.eventually(lambda: len(colors) > count + 2)
    assert _rgb(colors[-1]) == _BLUE
    bench.call("/clear", "std_srvs/Empty")
    bench.eventually(lambda: _rgb(colors[-1]) == (150, 86, 255))
    # Up to Melodic the parameter had no node's name before it.
    bench.node.parameters.set("/background_g", 1)
    bench.call("/clear", "std_srvs/Empty")
    bench.eventually(lambda: _rgb(colors[-1]) == (150, 1, 255))


def test_pen_draws_in_its_color_on_the_way_of_a_teleport(bench) -> None:
    bench.start(_NODE)
    pictures = bench.listen("/turtlesim/_canvas", "sensor_msgs/msg/Image")
    bench.call("/turtle1/set_pen", "turtlesim/SetPen", r=255, g=10, b=20, width=5)
    bench.call("/turtle1/teleport_absolute", "turtlesim/TeleportAbsolute", x=1.0, y=5.544444)

    def pixels() -> np.ndarray | None:
        if not pictures:
            return None
        return np.frombuffer(bytes(pictures[-1].data), np.uint8).reshape(500, 500, 3)

    bench.eventually(lambda: pixels() is not None and tuple(pixels()[250, 150]) == (255, 10, 20))
    assert tuple(pixels()[100, 400]) == _BLUE
    assert (pictures[-1].encoding, pictures[-1].step) == ("rgb8", 1500)
    assert not any("canvas" in name for name, _kind in bench.graph.topic_names_and_types())


def test_wall_is_told_in_the_originals_words(bench, capfd) -> None:
    bench.start(_NODE)
    place = _place(bench)
    bench.call("/turtle1/teleport_absolute", "turtlesim/TeleportAbsolute", x=20.0, y=3.0)
    bench.eventually(lambda: place().x > 11)
    assert bench.stop() == [0]
    texts = "".join(capfd.readouterr())
    assert "Oh no! I hit the wall! (Clamping from [x=20.000000, y=8.088889])" in texts


def test_velocity_that_is_no_number_is_left_out(bench, capfd) -> None:
    bench.start(_NODE)
    place = _place(bench)
    twist = message_type("geometry_msgs/msg/Twist")
    out = bench.node.create_publisher("/turtle1/cmd_vel", twist)
    bench.eventually(lambda: out.matched)
    bad, good = twist(), twist()
    bad.linear.x, good.linear.x = math.nan, 1.0
    out.publish(bad)
    text = "velocities that are no numbers are left out"
    bench.eventually(lambda: text in "".join(capfd.readouterr()))
    out.publish(good)
    bench.eventually(lambda: place().linear_velocity == 1.0)


def test_picture_is_saved_on_request_and_at_the_end(bench, tmp_path) -> None:
    path = tmp_path / "turtles.png"
    bench.start(_NODE, "--png", str(path))
    answer = bench.call("/turtlesim/save_image", "std_srvs/Trigger")
    assert (answer.success, answer.message) == (True, str(path))
    path.unlink()
    assert bench.stop() == [0]
    assert path.read_bytes().startswith(b"\x89PNG")


def test_ros2_parameters_count_at_once_and_have_ranges(bench) -> None:
    bench.start(_NODE, "--ros-args", "-p", "background_g:=7", "-r", "__node:=sim")
    colors = bench.listen("/turtle1/color_sensor", "turtlesim/msg/Color")
    assert _rgb(bench.eventually(lambda: colors)[-1]) == (69, 7, 255)
    parameter, value = (
        message_type(f"rcl_interfaces/msg/{name}") for name in ("Parameter", "ParameterValue")
    )

    def set_red(number: int) -> str:
        row = parameter(name="background_r", value=value(type=2, integer_value=number))
        answer = bench.call("/sim/set_parameters", "rcl_interfaces/SetParameters", parameters=[row])
        return answer.results[0].reason

    assert set_red(200) == ""
    bench.eventually(lambda: _rgb(colors[-1]) == (200, 7, 255))
    assert "doesn't comply with range [0, 255]" in set_red(300)


def test_ros2_turtles_turn_to_a_heading_and_give_up_when_driven(bench, capfd) -> None:
    bench.start(_NODE, "--ros-args")
    client = ActionClient(bench.node, "/turtle1/rotate_absolute", "turtlesim/RotateAbsolute")
    assert client.wait_for_server(stretched(20))
    feedback: list[float] = []
    goal = client.send_goal({"theta": 0.3}, on_feedback=lambda one: feedback.append(one.remaining))
    assert goal.wait(stretched(20))
    assert goal.result.delta == pytest.approx(-0.3, abs=0.03)
    assert feedback == sorted(feedback, reverse=True)
    assert feedback[0] == pytest.approx(0.3, abs=0.03)
    goal = client.send_goal({"theta": 3.0})
    twist = message_type("geometry_msgs/msg/Twist")
    out = bench.node.create_publisher("/turtle1/cmd_vel", twist)
    bench.eventually(lambda: out.matched and goal.is_accepted)
    out.publish(twist())
    assert goal.wait(stretched(20))
    assert goal.status.name == "ABORTED"
    goal = client.send_goal({"theta": 3.0})
    bench.eventually(lambda: goal.is_accepted)
    goal.cancel()
    assert goal.wait(stretched(20))
    assert goal.status.name == "CANCELED"
    texts = "".join(capfd.readouterr())
    for text in ("Rotation goal completed successfully", "Rotation goal canceled", "Velocity co"):
        assert text in texts


def test_ros2_answers_an_empty_name_for_one_that_exists(bench) -> None:
    bench.start(_NODE, "--ros-args")
    assert bench.call("/spawn", "turtlesim/Spawn", name="turtle1").name == ""
    bench.call("/kill", "turtlesim/Kill", name="nobody")


def test_log_level_of_the_command_line_counts(bench, capfd) -> None:
    bench.start(_NODE, "--ros-args", "--log-level", "error")
    bench.call("/kill", "turtlesim/Kill", name="nobody")
    text = capfd.readouterr().err
    words = r"\[turtlesim\]: Tried to kill turtle \[nobody\], which does not exist\n"
    assert re.fullmatch(rf"\[ERROR\] \[\d+\.\d{{9}}\] {words}", text), text


def test_background_that_is_no_number_is_told_and_not_taken(bench, capfd) -> None:
    bench.start(_NODE, "_background_r:=red")
    colors = bench.listen("/turtle1/color_sensor", "turtlesim/msg/Color")
    assert _rgb(bench.eventually(lambda: colors)[-1]) == _BLUE
    assert "'background_r' is 'red', no whole number from 0 to 255; 69 is taken" in "".join(
        capfd.readouterr()
    )


@pytest.mark.parametrize(
    ("rule", "text"),
    [
        ("background_r:=red", r"expected \[integer\] got \[string\]"),
        ("background_r:=256", "must be from 0 to 255"),
        ("holonomic:=1", "'holonomic' is 1; it must be like False"),
    ],
)
def test_ros2_value_that_does_not_fit_ends_it(bench, rule: str, text: str) -> None:
    request = {"node": _NODE, "argv": ["--ros-args", "-p", rule]}
    with pytest.raises(LaunchError, match=text):
        run_node(request, bench.graph, threading.Event())


def test_unknown_argument_shows_the_usage(bench) -> None:
    with pytest.raises(LaunchError, match=r"does not know '--pgn x'\nusage: turtlesim_node"):
        run_node({"node": _NODE, "argv": ["--pgn", "x"]}, bench.graph, threading.Event())


def test_unknown_parameters_and_those_of_the_other_ros_are_told(bench, capfd) -> None:
    bench.start(_NODE, "_backgruond_r:=5", "_holonomic:=true")
    bench.call("/clear", "std_srvs/Empty")
    text = "".join(capfd.readouterr())
    assert "parameter 'backgruond_r' is not one of turtlesim; it has no effect" in text
    assert "did you mean 'background_r'" in text
    assert bench.stop() == [0]
