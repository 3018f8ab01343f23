"""Drive the scout around its workshop, print what it senses, save what its camera sees.

Run it from anywhere: ``python examples/drive_scout.py``. It needs no graph and no display.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

import gazelle
from gazelle.interfaces import message_type
from gazelle.workspace import Workspace

HERE = Path(__file__).parent
PACKAGE = HERE / "scout_ws" / "src" / "scout_robot"


def main() -> None:
    """Drive two metres ahead, turn left by 90 degrees, look."""
    workspace = Workspace.discover(extra=[HERE / "scout_ws"])
    with gazelle.Simulation.load(
        PACKAGE / "urdf" / "scout.urdf.xacro",
        world=PACKAGE / "worlds" / "workshop.world",
        workspace=workspace,
    ) as sim:
        for finding in sim.diagnostics:
            print(finding)
        drive(sim, seconds=10.0, linear_m_s=0.2, angular_rad_s=0.0)
        drive(sim, seconds=np.pi / 2 / 0.5, linear_m_s=0.0, angular_rad_s=0.5)
        ranges_m = sim.sensor("lidar").read().ranges_m[0]
        print(f"nearest obstacle {np.nanmin(ranges_m):.2f} m away")
        picture = sim.sensor("camera").read()
        Image.fromarray(picture.rgb).save("scout.png")
        print("what the camera sees is in scout.png")
        print("state", sim.state_hash())


def drive(
    sim: gazelle.Simulation, *, seconds: float, linear_m_s: float, angular_rad_s: float
) -> None:
    """Command a speed for a time, then stop, and say where the robot is."""
    twist = message_type("geometry_msgs/msg/Twist")()
    twist.linear.x, twist.angular.z = linear_m_s, angular_rad_s
    sim.publish("/cmd_vel", twist)
    sim.run(seconds=seconds)
    sim.publish("/cmd_vel", message_type("geometry_msgs/msg/Twist")())
    sim.run(seconds=0.5)
    pose = sim.model("scout").pose
    x, y, _ = pose.position_m
    print(f"t = {sim.time_s:5.2f} s: x {x:.3f} m, y {y:.3f} m, yaw {pose.rpy_rad[2]:.3f} rad")


if __name__ == "__main__":
    main()
