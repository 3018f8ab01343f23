"""Plots of a run."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gazelle.errors import GazelleError, NotFoundError
from gazelle.interfaces import message_type
from gazelle.simulator import Simulation

_ROBOT = """<robot name="cart"><link name="world"/><link name="cart"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="arm"><inertial><mass value="0.1"/>
  <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="world"/><child link="cart"/>
  <axis xyz="1 0 0"/><limit lower="-90" upper="90" effort="50" velocity="9"/></joint>
  <joint name="turn" type="continuous"><parent link="cart"/><child link="arm"/>
  <axis xyz="0 0 1"/><limit effort="50" velocity="9"/></joint>
  <gazebo reference="cart"><sensor name="imu" type="imu"><update_rate>20</update_rate></sensor>
  </gazebo></robot>"""


@pytest.fixture
def sim() -> Iterator[Simulation]:
    """A cart on a rail, with an arm that turns."""
    with Simulation.load(_ROBOT, world=None) as made:
        yield made


def test_joints_are_plotted_from_the_start_of_the_run(sim: Simulation) -> None:
    sim.joint("slide").command_velocity(0.5)
    sim.run(seconds=1.0)
    found = sim.plot("slide/position", "slide/velocity").data
    position = found["slide/position"]
    assert position.times_s[0] == 0.0
    assert position.times_s[-1] == pytest.approx(1.0)
    assert position.values[0] == 0.0
    assert position.values[-1] == pytest.approx(sim.joint("slide").position)
    assert found["slide/velocity"].values[-1] == pytest.approx(0.5, abs=1e-3)


def test_a_joint_alone_means_its_position(sim: Simulation) -> None:
    assert sim.plot("slide").names == ("slide/position",)


def test_a_link_is_plotted_where_it_is_in_the_world(sim: Simulation) -> None:
    sim.joint("slide").command_velocity(0.5)
    sim.joint("turn").command_velocity(4.0)
    sim.run(seconds=2.0)
    found = sim.plot("cart/x", "arm/yaw").data
    assert found["cart/x"].values[-1] == pytest.approx(sim.link("cart").pose.position_m[0])
    # Angles go on past half a turn.
    assert found["arm/yaw"].values[-1] == pytest.approx(sim.joint("turn").position, abs=1e-6)
    assert found["arm/yaw"].values[-1] > 6.5


def test_efforts_and_sensors_are_recorded_from_the_first_plot_on(sim: Simulation) -> None:
    sim.run(seconds=1.0)
    plot = sim.plot("slide/effort", "imu/linear_acceleration_m_s2[2]")
    sim.joint("slide").command_effort(2.0)
    sim.run(seconds=1.0)
    effort, gravity = plot.data.values()
    assert effort.times_s[0] == pytest.approx(1.0)
    assert effort.values[-1] == pytest.approx(2.0)
    assert len(gravity.times_s) == 21
    assert sim.plot("slide/effort").data["slide/effort"].times_s[0] == pytest.approx(1.0)


def test_topics_are_recorded_with_the_time_of_their_messages(sim: Simulation) -> None:
    publisher = sim.server.node.create_publisher("/odom", message_type("nav_msgs/Odometry"))
    plot = sim.plot("/odom/twist/twist/linear/x")
    message = message_type("nav_msgs/Odometry")()
    message.header.stamp.sec, message.twist.twist.linear.x = 7, 1.5
    publisher.publish(message)
    found = plot.data["/odom/twist/twist/linear/x"]
    assert (found.times_s.tolist(), found.values.tolist()) == ([7.0], [1.5])


def test_a_plot_without_values_says_when_they_come(sim: Simulation) -> None:
    sim.server.node.create_publisher("/odom", message_type("nav_msgs/Odometry"))
    plot = sim.plot("/odom/twist/twist/linear/x")
    html = plot._repr_mimebundle_()["text/html"]  # type: ignore[attr-defined]
    assert "recorded from now on; run, and look again" in html


def test_a_run_that_is_reset_begins_its_plot_anew(sim: Simulation) -> None:
    sim.joint("slide").command_velocity(0.5)
    sim.run(seconds=1.0)
    sim.reset()
    sim.run(seconds=0.2)
    found = sim.plot("slide/position").data["slide/position"]
    assert found.times_s[-1] == pytest.approx(0.2)
    assert (np.diff(found.times_s) > 0).all()


def test_what_comes_into_the_world_is_plotted_from_then_on(sim: Simulation) -> None:
    sim.run(seconds=0.5)
    sim.spawn(_ROBOT, name="second")
    sim.run(seconds=0.5)
    found = sim.plot("cart::slide/position", "second::slide/position").data
    first, second = found.values()
    assert first.times_s[0] == 0.0
    assert second.times_s[0] >= 0.5
    assert first.times_s[-1] == second.times_s[-1] == pytest.approx(1.0)


def test_a_long_run_is_kept_whole_and_coarser(
    sim: Simulation, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gazelle.simulator import run_history

    monkeypatch.setattr(run_history, "_MAX_ROWS", 256)
    sim.joint("slide").command_velocity(0.5)
    sim.run(seconds=12.0)
    found = sim.plot("slide/position").data["slide/position"]
    assert len(found.times_s) <= 256
    assert found.times_s[0] == 0.0
    assert found.times_s[-1] == pytest.approx(12.0, abs=0.1)
    assert np.ptp(np.diff(found.times_s)[1:]) < 1e-9


def test_a_plot_changes_nothing_of_a_run() -> None:
    hashes = set()
    for names in ((), ("slide/effort", "cart/x")):
        with Simulation.load(_ROBOT, world=None) as sim:
            sim.joint("slide").command_velocity(0.5)
            if names:
                sim.plot(*names)
            sim.run(seconds=0.5)
            hashes.add(sim.state_hash())
    assert len(hashes) == 1


@pytest.mark.parametrize("kind", ["svg", "png", "pdf", "csv"])
def test_a_plot_is_saved_as_its_name_asks(sim: Simulation, tmp_path: Path, kind: str) -> None:
    sim.run(seconds=0.1)
    path = sim.plot("slide/position").save(tmp_path / f"plot.{kind}")
    begin = {"svg": b"<svg", "png": b"\x89PNG", "pdf": b"%PDF", "csv": b"name,time_s,value"}
    assert path.read_bytes().startswith(begin[kind])
    if kind == "png":
        assert Image.open(path).size[0] > 1000


def test_other_files_are_refused(sim: Simulation, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"plots are written as \.csv, \.pdf, \.png, \.svg"):
        sim.plot("slide").save(tmp_path / "plot.docx")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("slid/position", "did you mean 'slide'"),
        ("carts/x", "did you mean 'cart'"),
        ("imu/linear_acceleration", "did you mean 'linear_acceleration_m_s2'"),
        ("imu/linear_acceleration_m_s2", "is no number but ndarray"),
        ("im/angular_velocity_rad_s[0]", "there are: 'cart::cart::imu'"),
        ("/odmo/twist/linear/x", "did you mean '/odom'"),
        ("/odom/twst/linear/x", "has no field 'twst'; did you mean 'twist'"),
    ],
)
def test_what_is_not_there_is_told_with_what_is(sim: Simulation, name: str, message: str) -> None:
    sim.server.node.create_publisher("/odom", message_type("nav_msgs/Odometry"))
    with pytest.raises(GazelleError, match=message.replace("[", r"\[")):
        sim.plot(name)


def test_a_joint_that_cannot_move_is_told(sim: Simulation) -> None:
    fixed = _ROBOT.replace('type="prismatic"', 'type="fixed"')
    with Simulation.load(fixed, world=None) as other, pytest.raises(NotFoundError, match="fixed"):
        other.plot("slide")


def test_nothing_to_plot_is_told_with_examples(sim: Simulation) -> None:
    with pytest.raises(GazelleError, match="plot\\(\\) needs names of what to plot, such as"):
        sim.plot()
