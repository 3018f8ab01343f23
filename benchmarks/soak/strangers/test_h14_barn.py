"""The BARN challenge: a user's script that starts Gazebo and move_base for a Jackal (ROS 1)."""

from __future__ import annotations

import math
import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from stage import Stage

ENVIRONMENT = {
    "JACKAL_LASER": "1",
    "JACKAL_LASER_MODEL": "ust10",
    "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
}
BARN = "ws/src/the-barn-challenge"


def test_the_jackal_has_the_links_of_its_laser(stage: Stage) -> None:
    urdf = "ws/src/jackal/jackal_description/urdf/jackal.urdf.xacro"
    robot = stage.robot(urdf)
    assert len(robot.links) == 15
    assert robot.mass_kg == pytest.approx(19.53, abs=0.005)
    assert len(set(re.findall(r"package://\S+?\.stl", stage.run(f"xacro {urdf}").stdout))) == 4


def test_the_planned_path_is_read(folder: Path) -> None:
    path = folder / BARN / "jackal_helper/worlds/BARN/path_files/path_0.npy"
    assert np.load(path).shape == (43, 2)


def test_the_unmodified_script_runs_a_trial_to_its_score(stage: Stage, tmp_path: Path) -> None:
    out = tmp_path / "out.txt"
    script = f"cd {BARN} && exec python3 run.py --world_idx 0 --out {out}"
    with stage.launch(f'shell bash -c "{script}"') as trial:
        named = trial.says("collision_publisher_node.*compiled code")
        assert "jackal_helper" in named
        scan = trial.topic("/front/scan").next()
        assert len(scan.ranges) == 720
        # World 0 has the ground and 209 cylinders.
        heard = trial.topic("/gazebo/model_states")
        states = heard.wait_for(lambda one: "jackal" in one.name)
        heard.close()
        assert len(states.name) == 210 + 1
        physics = trial.call("/gazebo/get_physics_properties")
        assert physics.time_step == pytest.approx(0.001)
        trial.topic("/move_base/goal").next()
        start = trial.true_pose("jackal").position
        assert math.hypot(start.x + 2.25, start.y - 3.0) < 0.1
        odom = trial.topic("/odometry/filtered")
        for topic in ("/front/scan", "/jackal_velocity_controller/odom"):
            trial.has_rate(topic, 50.0)
        # On two cores the filter is late now and then beside simulation and navigation.
        trial.has_rate("/odometry/filtered", 50.0, share=0.15)
        code = trial.wait(timeout_s=420.0)
        assert code == 0
        assert trial.said(r"Navigation (succeeded|collided|timeout) with time \d+\.\d+")
        assert trial.said(r"Navigation metric: \d\.\d+")
        speeds = [one.twist.twist.linear.x for one in odom.messages(1000)]
        assert max(speeds) <= 0.55
    numbers = out.read_text().split()
    assert len(numbers) == 6
    succeeded, metric = numbers[1] == "1", float(numbers[5])
    assert 0.125 <= metric <= 0.5 if succeeded else metric == 0.0


def test_a_world_that_is_not_well_formed_is_refused_at_its_line(stage: Stage) -> None:
    world = f"{BARN}/jackal_helper/worlds/DynaBARN/world_0.world"
    done = stage.run(f"gzserver {world}")
    assert done.code != 0
    assert re.search(r"world_0\.world:628:\d+: error: not well-formed XML", done.output)
