"""Service Caller, Action Caller, Reconfigure, Parameters, Robot Steering, joint sliders, images."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest

from gazelle.interfaces import service_type

pytestmark = pytest.mark.slow

_ARM = """<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
    <axis xyz="0 0 1"/></joint>
</robot>"""


def test_a_service_is_called_with_a_form(bench: Any, look: Any) -> None:
    kind = service_type("std_srvs/srv/SetBool")
    asked: list[bool] = []

    def serve(request: Any) -> Any:
        asked.append(request.data)
        return kind.Response(success=True, message="light is on")

    bench.node.create_service("/light", kind, serve)
    seen = look(bench.url, "rqt_service_caller")
    panel = seen.panel("rqt_service_caller")
    bench.eventually(
        lambda: _choose(panel, "Service", "/light", panel.get_by_label("data", exact=True))
    )
    panel.get_by_label("data", exact=True).check()
    panel.get_by_role("button", name="Call").click()
    panel.get_by_text("light is on").wait_for()
    assert asked == [True]


def test_a_service_that_fails_says_why(bench: Any, look: Any) -> None:
    kind = service_type("std_srvs/srv/Trigger")

    def serve(request: Any) -> Any:
        raise RuntimeError("the gripper is open")

    bench.node.create_service("/grip", kind, serve)
    seen = look(bench.url, "rqt_service_caller")
    panel = seen.panel("rqt_service_caller")
    bench.eventually(
        lambda: _choose(panel, "Service", "/grip", panel.get_by_text("The request has no fields."))
    )
    panel.get_by_role("button", name="Call").click()
    bench.eventually(lambda: "the gripper is open" in panel.get_by_label("Response").inner_text())


def test_a_parameter_is_set_and_deleted(bench: Any, look: Any) -> None:
    bench.graph.parameters.set("/speed", 0.5)
    seen = look(bench.url, "rqt_param")
    panel = seen.panel("rqt_param")
    field = panel.get_by_label("Value of /speed", exact=True)
    field.wait_for()
    assert field.input_value() == "0.5"
    field.fill("0.8")
    field.press("Enter")
    bench.eventually(lambda: bench.graph.parameters.get("/speed", None) == 0.8)
    panel.get_by_label("Name of a parameter to set").fill("/gains")
    panel.get_by_label("Value to set").fill("[1, 2, 3]")
    panel.get_by_role("button", name="Set").click()
    bench.eventually(lambda: bench.graph.parameters.get("/gains", None) == [1, 2, 3])
    panel.get_by_label("Value of /gains", exact=True).wait_for()
    panel.get_by_label("Delete /speed").click()
    field.wait_for(state="detached")
    with pytest.raises(KeyError):
        bench.graph.parameters.get("/speed")


def test_keys_drive_and_letting_go_stops(bench: Any, look: Any) -> None:
    heard = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    seen = look(bench.url, "rqt_robot_steering")
    seen.panel("rqt_robot_steering").get_by_role("application").focus()
    seen.page.keyboard.down("w")
    bench.eventually(lambda: len(heard) > 2)
    seen.page.keyboard.down("a")
    bench.eventually(lambda: heard[-1].angular.z == 1.0)
    seen.page.keyboard.up("w")
    seen.page.keyboard.up("a")
    bench.eventually(lambda: heard[-1].linear.x == 0 and heard[-1].angular.z == 0)
    assert heard[0].linear.x == 0.5
    seen.page.keyboard.down("i")
    bench.eventually(lambda: heard[-1].linear.x == 0.5)
    seen.panel("rqt_robot_steering").get_by_label("Velocity topic").focus()
    bench.eventually(lambda: heard[-1].linear.x == 0)


def test_the_pad_drives_until_it_is_let_go(bench: Any, look: Any) -> None:
    heard = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    seen = look(bench.url, "rqt_robot_steering")
    pad = seen.page.get_by_label("Joystick: drag to drive")
    # A panel is laid out below the page first; this waits until it has come to rest.
    pad.hover()
    box = pad.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    seen.page.mouse.move(x, y)
    seen.page.mouse.down()
    seen.page.mouse.move(x, y - box["height"] / 2, steps=4)
    bench.eventually(lambda: heard and heard[-1].linear.x == pytest.approx(0.5, abs=0.02))
    seen.shot("driving")
    seen.page.mouse.up()
    bench.eventually(lambda: heard[-1].linear.x == 0)


def test_a_slider_keeps_its_velocity_until_stop(bench: Any, look: Any) -> None:
    heard = bench.listen("/robot/cmd_vel", "geometry_msgs/msg/TwistStamped")
    seen = look(bench.url, "rqt_robot_steering")
    panel = seen.panel("rqt_robot_steering")
    bench.eventually(
        lambda: (
            panel.get_by_label("Velocity topic").fill("/robot/cmd_vel"),
            panel.get_by_label("Velocity topic").press("Enter"),
            panel.get_by_label("Type").input_value() == "geometry_msgs/TwistStamped",
        )[-1]
    )
    panel.get_by_label("Angular velocity in rad/s", exact=True).fill("0.4")
    bench.eventually(lambda: len(heard) > 3)
    assert heard[-1].twist.angular.z == pytest.approx(0.4)
    assert heard[-1].header.stamp.sec > 0
    panel.get_by_role("button", name="Stop").click()
    bench.eventually(lambda: heard[-1].twist.angular.z == 0)


def test_joint_sliders_publish_within_the_limits(bench: Any, look: Any) -> None:
    bench.graph.parameters.set("/robot_description", _ARM)
    heard = bench.listen("/joint_states", "sensor_msgs/msg/JointState")
    seen = look(bench.url, "joint_state_publisher_gui")
    panel = seen.panel("joint_state_publisher_gui")
    shoulder = panel.get_by_label("shoulder", exact=True)
    shoulder.wait_for()
    assert (shoulder.get_attribute("min"), shoulder.get_attribute("max")) == ("-1", "2")
    bench.eventually(lambda: heard)
    assert list(heard[-1].name) == ["shoulder", "elbow"]
    panel.get_by_label("shoulder position").fill("0.75")
    panel.get_by_label("shoulder position").press("Enter")
    bench.eventually(lambda: heard[-1].position[0] == 0.75)
    panel.get_by_role("button", name="Randomize").click()
    bench.eventually(lambda: heard[-1].position[1] != 0)
    assert all(-1 <= one.position[0] <= 2 for one in heard)
    panel.get_by_role("button", name="Center").click()
    bench.eventually(lambda: list(heard[-1].position) == [0, 0])


def test_joint_sliders_wait_where_a_simulation_tells_the_joints(bench: Any, look: Any) -> None:
    bench.graph.parameters.set("/robot_description", _ARM)
    bench.publish("/joint_states", "sensor_msgs/msg/JointState", name=["shoulder"], position=[1.0])
    heard = bench.listen("/joint_states", "sensor_msgs/msg/JointState")
    seen = look(bench.url, "joint_state_publisher_gui")
    panel = seen.panel("joint_state_publisher_gui")
    panel.get_by_text("/robot publishes on /joint_states").wait_for()
    assert not [one for one in heard if len(one.name) == 2]
    panel.get_by_role("button", name="Publish").click()
    bench.eventually(lambda: [one for one in heard if len(one.name) == 2])


def test_an_image_is_shown_with_the_pixel_below_the_pointer(bench: Any, look: Any) -> None:
    red = bytes((200, 30, 10)) * (64 * 48)
    bench.keep_publishing(
        "/camera/image_raw",
        "sensor_msgs/msg/Image",
        lambda t: {"width": 64, "height": 48, "encoding": "rgb8", "step": 192, "data": red},
        hz=10,
    )
    seen = look(bench.url, "rqt_image_view")
    panel = seen.panel("rqt_image_view")
    panel.get_by_text("64 × 48").wait_for()
    assert panel.get_by_label("Image topic").input_value() == "/camera/image_raw"
    box = panel.locator("canvas").bounding_box()
    seen.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    text = panel.get_by_label("Pixel").inner_text()
    assert text.startswith("x 32  y 24") or text.startswith("x 31  y 2"), text
    colour = [int(word) for word in text.split("rgb ")[1].split()]
    assert colour == pytest.approx([200, 30, 10], abs=6)
    with seen.page.expect_download() as saved:
        panel.get_by_role("button", name="Save the image").click()
    assert saved.value.suggested_filename == "camera_image_raw.png"
    from PIL import Image

    picture = Image.open(io.BytesIO(Path(saved.value.path()).read_bytes()))
    assert picture.size == (64, 48)


def test_a_hidden_image_costs_nothing(bench: Any, look: Any) -> None:
    """A tab in the background gives no credits, so the server sends nothing."""
    red = bytes((200, 30, 10)) * (64 * 48)
    bench.keep_publishing(
        "/camera/image_raw",
        "sensor_msgs/msg/Image",
        lambda t: {"width": 64, "height": 48, "encoding": "rgb8", "step": 192, "data": red},
        hz=20,
    )
    seen = look(bench.url, "rqt_graph", "rqt_image_view", "rqt_console")
    seen.page.get_by_role("tab", name="Image").click()
    seen.panel("rqt_image_view").get_by_text("64 × 48").wait_for()
    shown = seen.panel("rqt_image_view").locator(".status-line span").first
    seen.page.get_by_role("tab", name="Console").click()
    seen.page.wait_for_timeout(500)
    before = shown.text_content()
    seen.page.wait_for_timeout(600)
    assert shown.text_content() == before
    seen.page.get_by_role("tab", name="Image").click()
    bench.eventually(lambda: shown.text_content() != before)


def _choose(panel: Any, label: str, name: str, then: Any) -> bool:
    """Type a name until the graph knows it."""
    panel.get_by_label(label, exact=True).fill("")
    panel.get_by_label(label, exact=True).fill(name)
    panel.get_by_label(label, exact=True).press("Enter")
    panel.page.wait_for_timeout(150)
    return bool(then.is_visible())
