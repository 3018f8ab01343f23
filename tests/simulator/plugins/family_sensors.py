"""Laws of the plug-ins that measure and publish, and of those that only say something."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from tests.simulator.plugins import test_bumper, test_ft_sensor, test_range, test_surroundings
from tests.simulator.plugins.family_trial import HERE, KEYS, FamilyRow, Trial, vector
from tests.simulator.plugins.test_cameras import DEPTH_KEYS, FOV, HEIGHT, WALL, WIDTH, camera
from tests.simulator.plugins.test_gz_odometry import MODEL, push
from tests.simulator.plugins.test_multicamera import (
    BASELINE_M,
    DISTANCE_M,
    FOCAL_PX,
    TRIGGERED,
    column_of_the_post,
)
from tests.simulator.plugins.test_multicamera import ROS1 as STEREO1
from tests.simulator.plugins.test_multicamera import ROS2 as STEREO2
from tests.simulator.plugins.test_multicamera import world as stereo_world
from tests.simulator.plugins.test_pushing import floating, lever
from tests.simulator.plugins.test_surroundings import place_of

from gazelle.description.model import SphericalCoordinates
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.simulator.plugins.unsupported_plugins import NOTHING_TABLE
from gazelle.simulator.plugins.unsupported_plugins import TABLE as NAMED_TABLE

__all__ = ["ROWS"]

P = f'<plugin name="p" filename="{HERE}">{KEYS}</plugin>'
HIGH = {"pose": Pose((0.0, 0.0, 50.0))}


def keys_of(plugin: str) -> str:
    """What stands in a plug-in's element."""
    return plugin.partition(">")[2].removesuffix("</plugin>")


def ranges(trial: Trial, *, field: str) -> None:
    """Beams end on the wall 2 m ahead; its face is 2 m / cos of the angle away."""
    topic = "/demo/out" if trial.is_ros2 else "/d"
    messages = trial.listen(topic)
    trial.sim.run(seconds=0.2)
    message = messages[-1]
    assert message.header.frame_id == "eye"
    if field == "ranges":
        found = np.asarray(message.ranges)[:5]
        assert found == pytest.approx(2.0 / np.cos(np.linspace(-0.2, 0.2, 5)), abs=2e-3)
    elif field == "range":
        assert message.range == pytest.approx(2.0, abs=1e-3)
    else:
        assert [point.x for point in message.points] == pytest.approx([2.0] * 15, abs=2e-3)


def picture(trial: Trial, *, topic: str) -> None:
    """A red wall is red, and a metre of it is as wide as the field of view says."""
    trial.sim.spawn(WALL.replace("20 20", "1 1"), name="wall", pose=Pose((3.1, 0.0, 0.0)))
    pictures = trial.listen(topic)
    trial.sim.run(seconds=0.1)
    message = pictures[-1]
    pixels = np.asarray(message.data).reshape(HEIGHT, WIDTH, 3).astype(int)
    red = (pixels[:, :, 0] > 200) & (pixels[:, :, 1] < 50)
    assert red[HEIGHT // 2].sum() == pytest.approx(WIDTH / (2 * math.tan(FOV / 2)) / 3.0, abs=1.01)
    assert message.header.frame_id == "eye_optical"


def triggered(trial: Trial) -> None:
    """No picture without a trigger, one for each."""
    pictures = trial.listen("/r/stereo/image_raw")
    trial.sim.run(seconds=0.3)
    assert pictures == []
    trial.sim.publish("/r/stereo/shoot", message_type("std_msgs/Empty")())
    trial.sim.run(seconds=0.3)
    assert len(pictures) == 1
    assert column_of_the_post(pictures[0]) == pytest.approx(79.5, abs=0.75)


def stereo(trial: Trial) -> None:
    """Disparity is f b / z."""
    left, right = (trial.listen(f"/r/stereo/{side}/image_raw") for side in ("left", "right"))
    trial.sim.run(seconds=0.2)
    disparity = column_of_the_post(left[-1]) - column_of_the_post(right[-1])
    assert disparity == pytest.approx(FOCAL_PX * BASELINE_M / DISTANCE_M, abs=0.75)


def depth(trial: Trial) -> None:
    """A wall is as deep everywhere as it is far."""
    trial.sim.spawn(WALL, name="wall", pose=Pose((3.1, 0.0, 0.0)))
    depths = trial.listen("/d/depth/image_raw")
    trial.sim.run(seconds=0.1)
    values = np.asarray(depths[-1].data).view(np.float32)
    assert values == pytest.approx(np.full(WIDTH * HEIGHT, 3.0), abs=1e-3)


def turning_fall(trial: Trial, *, topic: str) -> None:
    """In free fall an IMU feels no force, and the rate it turns at."""
    messages = trial.listen(topic)
    trial.sim.server.engine.set_model_velocity("thing", (0, 0, 0), (0, 0, 0.5))
    trial.sim.run(seconds=1.0)
    message = messages[-1]
    assert vector(message.linear_acceleration) == pytest.approx([0.0] * 3, abs=2e-3)
    assert vector(message.angular_velocity) == pytest.approx([0.0, 0.0, 0.5], abs=1e-3)
    turned = 2 * math.atan2(message.orientation.z, message.orientation.w)
    assert turned == pytest.approx(0.5, abs=0.02)


def joint_states(trial: Trial, *, topic: str) -> None:
    """Joints that turn freely: positions are their rates times the time."""
    messages = trial.listen(topic)
    for name, rate in (("one", 1.5), ("two", -0.5)):
        trial.sim.joint(f"{name}_joint").handle.set_state(velocity=rate)
    trial.sim.run(seconds=0.5)
    message = messages[-1]
    time_s = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
    found = dict(zip(message.name, message.position, strict=True))
    assert time_s > 0.45
    assert found == pytest.approx({"one_joint": 1.5 * time_s, "two_joint": -0.5 * time_s}, abs=2e-3)


def truth(trial: Trial) -> None:
    """The true pose and speed of a thrown body, with the offset of the keys."""
    messages = trial.listen("/demo/truth" if trial.is_ros2 else "/truth")
    trial.sim.server.engine.set_model_velocity("thing", (1.0, -2.0, 0), (0, 0, 0))
    trial.sim.run(seconds=0.5)
    message = messages[-1]
    time_s = message.header.stamp.nanosec * 1e-9
    wanted = [time_s, -2.0 * time_s, 50.0 - 4.9 * time_s**2 + 1.0]
    assert vector(message.pose.pose.position) == pytest.approx(wanted, abs=5e-3)
    assert vector(message.twist.twist.linear) == pytest.approx([1, -2, -9.8 * time_s], abs=2e-2)


def weight(trial: Trial) -> None:
    """The ground carries m g; the box lies on its side, its y axis up."""
    messages = trial.listen("/demo/touched" if trial.is_ros2 else "/r/touched")
    trial.sim.run(seconds=0.6)
    (state,) = messages[-1].states
    assert vector(state.total_wrench.force) == pytest.approx([0.0, 5 * 9.8, 0.0], abs=0.5)


def hanging(trial: Trial) -> None:
    """A mass on an arm pulls down, and turns with its lever."""
    messages = trial.listen("/demo/ft" if trial.is_ros2 else "/r/ft")
    trial.sim.run(seconds=0.1)
    wrench = messages[-1].wrench
    assert vector(wrench.force) == pytest.approx([0, 0, -test_ft_sensor.WEIGHT_N], abs=1e-6)
    lever_nm = test_ft_sensor.ARM_M * test_ft_sensor.WEIGHT_N
    assert vector(wrench.torque) == pytest.approx([0, lever_nm, 0], abs=1e-6)


def all_force(trial: Trial) -> None:
    """All force on a body that falls is its weight."""
    messages = trial.listen("/f")
    trial.sim.run(seconds=0.1)
    assert vector(messages[-1].wrench.force) == pytest.approx([0, 0, -2.0 * 9.8])


def on_earth(trial: Trial, *, topic: str, origin: SphericalCoordinates) -> None:
    """Latitude, longitude and height lead back to the place in the world."""
    fixes = trial.listen(topic)
    trial.sim.link("body").handle.set_velocity((2.0, -1.0, 0.5))
    trial.sim.run(seconds=1.0)
    assert place_of(fixes[-1], origin) == pytest.approx((102.0, 49.0, 20.5), abs=0.01)


def magnetic(trial: Trial) -> None:
    """The horizontal part is cos(inclination) of the whole; x points east, y north."""
    messages = trial.listen("/magnetic")
    trial.sim.run(seconds=0.2)
    sine, cosine = math.sin(math.radians(60)), math.cos(math.radians(60))
    assert vector(messages[-1].vector) == pytest.approx([0.0, 2 * cosine, -2 * sine], abs=1e-6)


def height(trial: Trial) -> None:
    """A barometer gives the height."""
    messages = trial.listen("/pressure_height")
    trial.sim.run(seconds=0.2)
    assert messages[-1].point.z == pytest.approx(20.0)


def flat_odometry(trial: Trial) -> None:
    """The true pose without its height, and the twist in the robot's axes."""
    messages = trial.listen("/model/bot/odometry")
    push(trial.sim)
    trial.sim.run(seconds=0.5)
    pose, message = trial.sim.model("bot").pose, messages[-1]
    wanted = [*pose.position_m[:2], 0.0]
    assert vector(message.pose.pose.position) == pytest.approx(wanted, abs=1e-6)
    forward, left = 2 * math.cos(0.2), -2 * math.sin(0.2)
    assert vector(message.twist.twist.linear) == pytest.approx([forward, left, 0.0], abs=5e-3)


def link_poses(trial: Trial) -> None:
    """Links relative to their model, whatever the model does."""
    messages = trial.listen("/model/bot/pose")
    trial.sim.joint("turn").handle.set_state(position=0.3)
    trial.sim.run(seconds=0.1)
    mast = [item for item in messages if item.child_frame_id == "bot/mast"][-1]
    assert vector(mast.transform.translation) == pytest.approx([0, 0, 1], abs=1e-6)
    assert 2 * math.asin(mast.transform.rotation.z) == pytest.approx(0.3, abs=1e-6)


def noticed(trial: Trial, *, code: str, place: int, text: str = "") -> None:
    """One notice with the plug-in's name and place; the world goes on, and the body falls."""
    (found,) = trial.sim.diagnostics.by_code(code)
    assert f"'p' (lib{trial.name}.so)" in found.message or f"'p' ({trial.name})" in found.message
    assert text.format(meanings(trial.name)) in found.message
    assert found.span is not None
    assert found.span.line == place
    trial.sim.run(seconds=0.5)
    fallen = 50.0 - trial.sim.model("thing").pose.position_m[2]
    assert fallen == pytest.approx(4.9 * 0.25, rel=0.01)


def meanings(name: str) -> str:
    """What the page says about a plug-in that is known by name."""
    rows = (*NAMED_TABLE.behaviour, *NOTHING_TABLE.behaviour)
    said = [row for row in rows if row.startswith(f"`{name}`: ")]
    return said[0].removeprefix(f"`{name}`: ").removesuffix(".") if said else ""


def system(trial: Trial) -> None:
    """One notice; sensors without a plug-in publish by themselves: an IMU, m g up."""
    (found,) = trial.sim.diagnostics.by_code("plugin.built-in")
    assert f"plug-in 'p' ({trial.name}) is part of Gazelle" in found.message
    assert found.span is not None
    messages = trial.listen("/own")
    trial.sim.run(seconds=0.5)
    assert len(messages) == 10
    assert vector(messages[-1].linear_acceleration) == pytest.approx([0.0, 0.0, 9.8])


def imu_world(body: str = "") -> str:
    return f"""<sdf version="1.9"><world name="lab">{P}<model name="post"><static>true</static>
      <link name="head"><sensor name="s" type="imu"><update_rate>20</update_rate>
      <topic>own</topic></sensor></link></model>{body}</world></sdf>"""


def sensing_body() -> str:
    """A body that falls, with an IMU around the plug-in."""
    sensor = f"""<gazebo reference="body"><sensor name="imu" type="imu">
      <update_rate>100</update_rate>{P}</sensor></gazebo></robot>"""
    return floating("libnone.so", "").split("<gazebo>")[0] + sensor


def dropped() -> str:
    """A body that falls; the plug-in stands in the third line."""
    return floating(HERE, KEYS).replace("<gazebo>", "\n<gazebo>").replace("\n  ixz", " ixz")


NAMESPACE = "<robotNamespace>r</robotNamespace>"
DEMO = "<ros><namespace>/demo</namespace>{}</ros>"
OUT = DEMO.format("<remapping>~/out:=out</remapping>")
CLASSIC_RANGE = "<topicName>d</topicName><frameName>eye</frameName>"
EYE1 = "<cameraName>eye</cameraName><frameName>eye_optical</frameName>"
EYE2 = "<ros/><camera_name>eye</camera_name><frame_name>eye_optical</frame_name>"
OF_BODY = "<bodyName>body</bodyName><topicName>imu</topicName>"
GPS = """<sensor name="gps" type="gps"><update_rate>10</update_rate><gps><position_sensing>
  <vertical><noise type='gaussian'><stddev>0</stddev></noise></vertical></position_sensing></gps>
  {}</sensor>"""
HECTOR_GPS = """<updateRate>20</updateRate><referenceLatitude>49.8</referenceLatitude>
  <referenceLongitude>8.6</referenceLongitude><referenceAltitude>120</referenceAltitude>
  <referenceHeading>90</referenceHeading><gaussianNoise>0 0 0</gaussianNoise>"""
MAGNETIC = """<referenceHeading>90</referenceHeading><declination>0</declination>
  <inclination>60</inclination><magnitude>2</magnitude>"""
SINGLE = partial(stereo_world, P, ("only",))
# compressedDepth and theora are offered and send nothing, which is said.
NO_ENCODER = frozenset({"plugin.no-encoder"})
BUILT_IN = frozenset({"plugin.built-in"})


def _ranged(family: str, field: str, *spellings: str) -> FamilyRow:
    return FamilyRow(family, test_range.world(HERE, KEYS), partial(ranges, field=field), spellings)


def _eye(family: str, kind: str, law: Any, *spellings: str, said: Any = frozenset()) -> FamilyRow:
    return FamilyRow(family, camera(HERE, KEYS, kind=kind), law, spellings, {"world": None}, said)


ROWS = (
    _ranged("laser", "ranges", CLASSIC_RANGE),
    _ranged(
        "ray_sensor",
        "ranges",
        f"{OUT}<output_type>sensor_msgs/LaserScan</output_type><frame_name>eye</frame_name>",
    ),
    _ranged("range", "range", CLASSIC_RANGE),
    _ranged("hector sonar", "range", CLASSIC_RANGE),
    _ranged("block_laser", "points", CLASSIC_RANGE),
    _eye("camera", "camera", partial(picture, topic="/eye/image_raw"), EYE1, EYE2, said=NO_ENCODER),
    FamilyRow(
        "triggered_camera",
        SINGLE().replace('type="multicamera"', 'type="camera"'),
        triggered,
        (keys_of(TRIGGERED),),
        said=NO_ENCODER,
    ),
    FamilyRow(
        "multicamera",
        stereo_world(P),
        stereo,
        (keys_of(STEREO1), keys_of(STEREO2)),
        said=NO_ENCODER,
    ),
    _eye("openni_kinect", "depth", depth, DEPTH_KEYS),
    _eye("depth_camera", "depth", depth, DEPTH_KEYS),
    FamilyRow("imu", floating(HERE, KEYS), partial(turning_fall, topic="/imu"), (OF_BODY,), HIGH),
    FamilyRow(
        "hector imu", floating(HERE, KEYS), partial(turning_fall, topic="/imu"), (OF_BODY,), HIGH
    ),
    FamilyRow(
        "imu_sensor",
        sensing_body(),
        partial(turning_fall, topic="/imu"),
        (
            "<topicName>imu</topicName><frameName>f</frameName>",
            "<ros><remapping>~/out:=imu</remapping></ros><frame_name>f</frame_name>",
        ),
        HIGH,
    ),
    FamilyRow(
        "joint_state_publisher",
        lever(HERE, KEYS),
        partial(joint_states, topic="/joint_states"),
        (
            "<jointName>one_joint, two_joint</jointName><updateRate>50</updateRate>",
            "<ros/><joint_name>one_joint</joint_name><joint_name>two_joint</joint_name>",
        ),
    ),
    FamilyRow(
        "gz-sim joint_state_publisher",
        lever(HERE, KEYS),
        partial(joint_states, topic="/world/default/model/thing/joint_state"),
        options={"world": None},
    ),
    FamilyRow(
        "p3d",
        floating(HERE, KEYS),
        truth,
        (
            "<bodyName>body</bodyName><topicName>truth</topicName><xyzOffset>0 0 1</xyzOffset>",
            DEMO.format("<remapping>odom:=truth</remapping>")
            + "<body_name>body</body_name><xyz_offset>0 0 1</xyz_offset>"
            + "<update_rate>50</update_rate>",
        ),
        HIGH,
    ),
    FamilyRow(
        "bumper",
        test_bumper.world(P),
        weight,
        (keys_of(test_bumper.ROS1), keys_of(test_bumper.ROS2)),
    ),
    FamilyRow(
        "ft_sensor",
        test_ft_sensor.world(P),
        hanging,
        (
            f"{NAMESPACE}<jointName>pivot</jointName><topicName>ft</topicName>",
            DEMO.format("<remapping>wrench:=ft</remapping>") + "<joint_name>pivot</joint_name>",
        ),
    ),
    FamilyRow(
        "f3d",
        floating(HERE, KEYS),
        all_force,
        ("<bodyName>body</bodyName><topicName>f</topicName>",),
        HIGH,
    ),
    FamilyRow(
        "gps_sensor",
        test_surroundings.world(sensor=GPS.format(P)),
        partial(on_earth, topic="/demo/out", origin=test_surroundings.ORIGIN),
        (OUT,),
    ),
    FamilyRow(
        "hector gps",
        test_surroundings.world(plugin=P),
        partial(on_earth, topic="/fix", origin=SphericalCoordinates(49.8, 8.6, 120.0)),
        (HECTOR_GPS,),
    ),
    FamilyRow("hector magnetic", test_surroundings.world(plugin=P), magnetic, (MAGNETIC,)),
    FamilyRow("hector baro", test_surroundings.world(plugin=P), height),
    *(
        FamilyRow(
            family,
            MODEL.replace(
                'filename="{filename}" name="{name}"', f'name="p" filename="{HERE}"'
            ).replace("{keys}", KEYS),
            law,
        )
        for family, law in (
            ("gz-sim odometry_publisher", flat_odometry),
            ("gz-sim pose_publisher", link_poses),
        )
    ),
    FamilyRow("gz-sim systems", imu_world(), system, said=BUILT_IN),
    *(
        FamilyRow(
            family,
            dropped(),
            partial(noticed, code=code, place=2, text=text),
            options=HIGH,
            said=frozenset({code}),
        )
        for family, code, text in (
            ("gazebo_ros server plug-ins", "plugin.built-in", "is part of Gazelle{}"),
            ("known by name", "plugin.named-only", "{}"),
            ("without effect", "plugin.without-effect", "{}"),
        )
    ),
)
