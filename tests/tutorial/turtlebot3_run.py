"""Rows T8–T10 in one run: map by keyboard, save, localise, drive to goals, and what goes wrong."""

from __future__ import annotations

import math
import random
import signal
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, label
from tests.tutorial.turtlebot3_session import KeyDriver, PlanePose, Session, apart

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.grids import OccupancyGrid, read_map

__all__ = ["ROUTE", "SHORT_ROUTE", "Arrival", "Report", "drive_and_map", "scripted_run"]

Route = Sequence[tuple[float, float]]

# Between the pillars, which stand at multiples of 1.1 m, and back.
ROUTE: Route = (
    (-1.75, 0.5), (-0.55, 0.55), (-0.55, 1.65), (0.55, 1.65), (0.55, 0.55), (1.6, 0.5),
    (1.6, -0.5), (0.55, -0.55), (0.55, -1.65), (-0.55, -1.65), (-0.55, -0.55), (-1.75, -0.55),
)  # fmt: skip
# Around the pillar in the middle.
SHORT_ROUTE: Route = (
    (-1.75, 0.5), (-0.55, 0.55), (0.55, 0.55), (0.55, -0.55), (-0.55, -0.55), (-1.75, -0.55),
)  # fmt: skip
# The circle around the base's origin in which a model turns.
_TURNS_IN_M = {"burger": 0.15, "waffle": 0.26, "waffle_pi": 0.26}
# Cells are 5 cm, and a goal counts as reached from 5 cm away, so that a robot needs more to turn.
_TO_PASS_M, _TO_TURN_M = 0.05, 0.12
_BOX = """<sdf version="1.6"><model name="box"><static>true</static><link name="link">
<collision name="c"><geometry><box><size>0.2 0.2 0.5</size></box></geometry></collision>
<visual name="v"><geometry><box><size>0.2 0.2 0.5</size></box></geometry></visual>
</link></model></sdf>"""
_PILLAR = (0.0, 0.0, 0.0)
_KIDNAPPED_TO = (0.55, -0.55, 1.0)
_SEARCH_UPDATES = 60
_FOR_KEYS = 2.0
_RELOCALISED_M, _RELOCALISED_RAD = 0.2, 0.2


class Arrival(NamedTuple):
    """The end of a goal.

    Attributes:
        goal: where to.
        text: what move_base says.
        believed: how far off the robot thinks that it is, m and rad.
        true: how far off it is.
    """

    goal: PlanePose
    text: str
    believed: tuple[float, float]
    true: tuple[float, float]


@dataclass
class Report:
    """What a run came to.

    Attributes:
        arrivals: at random goals.
        refusal: what was said about a goal inside of a pillar.
        around_box: the end of a goal behind a box that was not there before.
        updates_when_found: localisation's updates until a kidnapped robot knew where it was.
        after_kidnap: the end of a goal after that.
        bumps: contacts above the ground.
        looks: how often contacts were looked at.
    """

    arrivals: list[Arrival] = field(default_factory=list)
    refusal: str = ""
    around_box: str = ""
    updates_when_found: int | None = None
    after_kidnap: str = ""
    bumps: list[Any] = field(default_factory=list)
    looks: int = 0


def drive_and_map(session: Session, home: Path, route: Route) -> OccupancyGrid:
    """Drive through the world by keyboard and save what SLAM makes of it (T8, T9)."""
    slam = session.launch("turtlebot3_slam", "turtlebot3_slam.launch", "slam_methods:=gmapping")
    maps: list[Any] = []
    session.world.node.create_subscription("/map", "nav_msgs/msg/OccupancyGrid", maps.append)
    # A person drives when RViz shows a map.
    session.world.eventually(lambda: maps)
    driver = KeyDriver(session)
    # Who looks late at a robot three times too fast bumps into things.
    with session.no_faster_than(_FOR_KEYS):
        driver.drive_through(route)
    driver.close()
    saver = session.rosrun("map_server", "map_saver", "-f", str(home / "map"))
    assert saver.wait() == 0, saver.text
    assert slam.stop(signal.SIGINT) == 0, slam.text
    grid = read_map(home / "map.yaml", Diagnostics())
    assert grid is not None
    return grid


def scripted_run(
    session: Session,
    home: Path,
    *,
    model: str,
    goals: int,
    seed: int,
    route: Route = ROUTE,
    say: Callable[[str], object] = print,
) -> Report:
    """Do everything of T8 to T10, as printed."""
    report = Report()
    grid = drive_and_map(session, home, route)
    say(f"mapped: {grid.width} × {grid.height} cells; contacts {session.bumps[:2]}")
    navigation = session.launch(
        "turtlebot3_navigation", "turtlebot3_navigation.launch", f"map_file:={home / 'map.yaml'}"
    )
    x, y, yaw = session.truth()
    # A person clicks near it.
    session.estimate((x + 0.15, y - 0.1, yaw + 0.15))
    free = _Places(grid, _TURNS_IN_M[model], session.truth())
    rng = random.Random(seed)
    for _ in range(goals):
        report.arrivals.append(_arrival(session, free.draw(rng, session.truth())))
        say(f"{report.arrivals[-1]}")
    report.refusal = session.drive_to(_PILLAR).text
    say(f"refused: {report.refusal}")
    report.around_box = _around_a_box(session)
    say(f"around a box: {report.around_box}")
    report.updates_when_found = _kidnap(session)
    say(f"found after {report.updates_when_found} updates")
    report.after_kidnap = session.drive_to((0.55, 0.55, 0.0)).text
    report.bumps, report.looks = session.bumps, session.looks
    assert navigation.stop(signal.SIGINT) == 0, navigation.text
    return report


def _arrival(session: Session, goal: PlanePose) -> Arrival:
    end = session.drive_to(goal)
    return Arrival(goal, end.text, apart(goal, session.belief()), apart(goal, session.truth()))


def _around_a_box(session: Session) -> str:
    """A box falls onto the straight way to a goal."""
    assert session.drive_to((-1.65, -0.75, math.pi / 2)).text == "Goal reached."
    pose = {"position": {"x": -1.65, "y": 0.0, "z": 0.25}, "orientation": {"w": 1.0}}
    spawned = session.world.call(
        "/gazebo/spawn_sdf_model", "gazebo_msgs/SpawnModel", model_name="box", model_xml=_BOX,
        initial_pose=pose,
    )  # fmt: skip
    assert spawned.success, spawned.status_message
    text = str(session.drive_to((-1.65, 0.75, math.pi / 2)).text)
    session.world.call("/gazebo/delete_model", "gazebo_msgs/DeleteModel", model_name="box")
    return text


def _kidnap(session: Session) -> int | None:
    """Carry the robot away, spread the particles, turn around slowly until it knows the place."""
    before = len(session.estimates)
    session.place(_KIDNAPPED_TO)
    # The simulated odometry jumps along; localisation takes that for a motion.
    session.world.eventually(lambda: len(session.estimates) > before)
    session.world.call("/global_localization", "std_srvs/Empty")
    before = len(session.estimates)
    pause = threading.Event()
    try:
        while (count := len(session.estimates) - before) < _SEARCH_UPDATES:
            session.go(0.0, 0.5)
            pause.wait(0.05)
            away, turn = apart(session.belief(), session.seen_pose())
            if count >= 5 and away < _RELOCALISED_M and turn < _RELOCALISED_RAD:
                return count
    finally:
        session.go(0.0, 0.0)
    return None


class _Places:
    """Poses in a map around which a robot can turn and to which ways lead."""

    def __init__(self, grid: OccupancyGrid, turns_in_m: float, start: PlanePose) -> None:
        room_m = distance_transform_edt(grid.cells == 0) * grid.resolution_m
        labels, _ = label(room_m > turns_in_m + _TO_PASS_M)
        column, row = grid.world_to_cell(start[0], start[1])
        rows, columns = distance_transform_edt(
            labels == 0, return_distances=False, return_indices=True
        )
        here = labels[rows[row, column], columns[row, column]]
        self._grid = grid
        self._cells: NDArray[np.int64] = np.argwhere(
            (labels == here) & (room_m > turns_in_m + _TO_TURN_M)
        )

    def draw(self, rng: random.Random, here: PlanePose) -> PlanePose:
        """Return one that is not where the robot is."""
        while True:
            row, column = self._cells[rng.randrange(len(self._cells))]
            x, y = (float(value) for value in self._grid.cell_to_world(column, row))
            if math.hypot(x - here[0], y - here[1]) > 0.5:
                return x, y, rng.uniform(-math.pi, math.pi)
