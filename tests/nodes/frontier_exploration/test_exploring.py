"""explore_server and explore_client, with somebody who drives at once wherever they want."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests.patience import stretched

from gazelle.errors import GazelleError
from gazelle.geometry import Pose
from gazelle.graph.actions import ActionClient, ActionServer, ServerGoal
from gazelle.graph.tf import StampedPose, StaticTransformBroadcaster
from gazelle.interfaces import fill, message_type
from gazelle.mapping.grids import OccupancyGrid
from gazelle.nodes.map_server.occupancy_grid import message_of_grid

_COSTMAP = {
    "global_frame": "map",
    "robot_base_frame": "base_link",
    "transform_tolerance": 0.0,
    "update_frequency": 50.0,
    "robot_radius": 0.1,
    "resolution": 0.1,
    "track_unknown_space": True,
    "plugins": [
        {"name": "static", "type": "costmap_2d::StaticLayer"},
        {"name": "explore_boundary", "type": "frontier_exploration::BoundedExploreLayer"},
    ],
    "explore_boundary": {"resize_to_boundary": False, "explore_clear_space": False},
}
_ROOM = ((-0.4, -0.9), (4.0, -0.9), (4.0, 0.9), (-0.4, 0.9))
_ELSEWHERE = ((7.0, 7.0), (8.0, 7.0), (8.0, 8.0))


class World:
    """A corridor of 6 m along x from −0.5 m, 2 m of which are known; move_base knows the way."""

    def __init__(self, bench: Any, *, refuses: bool = False, grows: bool = True) -> None:
        self.refuses, self.grows = refuses, grows
        self.goals: list[tuple[float, float]] = []
        self.known = 20
        kind = "nav_msgs/msg/OccupancyGrid"
        self.maps = bench.node.create_publisher("/map", kind, latch=True)
        StaticTransformBroadcaster(bench.node).send(StampedPose("map", "base_link", 0, Pose()))
        self.server = ActionServer(
            bench.node, "move_base", "move_base_msgs/MoveBase", on_goal=self._on_goal, ros_version=1
        )
        self.publish()

    def publish(self) -> None:
        cells = np.full((20, 60), 100, np.int8)
        cells[5:15, 1:59] = 0
        cells[:, self.known :] = -1
        self.maps.publish(message_of_grid(OccupancyGrid(cells, 0.1, (-0.5, -1.0, 0.0)), "map", 0))

    def _on_goal(self, goal: ServerGoal) -> None:
        at = goal.request.target_pose.pose.position
        self.goals.append((round(at.x, 2), round(at.y, 2)))
        goal.accept()
        if self.refuses:
            goal.abort(text="no way")
            return
        if self.grows:
            self.known = min(self.known + 20, 60)
            self.publish()
        goal.succeed()


@pytest.fixture
def serve(bench: Any) -> Callable[..., Any]:
    """Starts explore_server and returns what sends it a polygon."""

    def start(costmap: Any = None, **layer: Any) -> Any:
        values = {**_COSTMAP, **(costmap or {})}
        values = {**values, "explore_boundary": {**_COSTMAP["explore_boundary"], **layer}}
        bench.graph.parameters.set(
            "/explore_server", {"explore_costmap": values, "frequency": 50.0}
        )
        bench.start("frontier_exploration/explore_server")
        client = ActionClient(bench.node, "explore_server", "frontier_exploration/ExploreTask")

        def send(corners: Any, frame: str = "map", **options: Any) -> Any:
            client.require_server(stretched(30.0))
            goal = client.types.Goal()
            point = message_type("geometry_msgs/msg/Point32")
            goal.explore_boundary.header.frame_id = goal.explore_center.header.frame_id = frame
            goal.explore_boundary.polygon.points = [point(x=x, y=y) for x, y in corners]
            if len(corners):
                goal.explore_center.point.x, goal.explore_center.point.y = corners[0]
            return client.send_goal(goal, **options)

        return send

    return start


def test_frontiers_inside_of_the_polygon_are_driven_to(bench: Any, serve: Any) -> None:
    world = World(bench)
    goal = serve()(_ROOM)
    bench.eventually(lambda: goal.is_done)
    assert (goal.status.name, goal.text) == ("SUCCEEDED", "Finished exploring room")
    # What is known ends at 1.5 m and at 3.5 m; the polygon ends before 5.5 m.
    assert [x for x, _ in world.goals] == [1.45, 3.45]


def test_without_a_polygon_everything_is_explored(bench: Any, serve: Any) -> None:
    world = World(bench)
    goal = serve()(())
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name == "SUCCEEDED"
    assert [x for x, _ in world.goals] == [1.45, 3.45]
    assert world.known == 60


def test_a_robot_outside_goes_to_the_centre_first(bench: Any, serve: Any) -> None:
    world = World(bench, grows=False)
    goal = serve()(_ELSEWHERE)
    bench.eventually(lambda: len(world.goals) > 1)
    assert set(world.goals) == {(7.0, 7.0)}
    goal.cancel()
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name == "PREEMPTED"


def test_frontiers_that_move_base_gives_up_are_left_out(
    bench: Any, serve: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    world = World(bench, refuses=True)
    goal = serve()(_ROOM)
    bench.eventually(lambda: goal.is_done)
    assert len(world.goals) == 1
    assert goal.status.name == "ABORTED"
    assert (
        goal.text == "Failed exploration: none of 1 frontiers inside of the boundary can be reached"
    )
    assert "is left out: no way" in "".join(capfd.readouterr())


def test_a_centre_that_move_base_gives_up_ends_the_task(bench: Any, serve: Any) -> None:
    World(bench, refuses=True)
    goal = serve()(_ELSEWHERE)
    bench.eventually(lambda: goal.is_done)
    assert (goal.status.name, goal.text) == ("ABORTED", "Failed to move: no way")


def test_nothing_to_explore_is_a_failure(bench: Any, serve: Any) -> None:
    World(bench)
    goal = serve()(((-0.4, -0.9), (0.6, -0.9), (0.6, 0.9), (-0.4, 0.9)))
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name == "ABORTED"
    assert (
        goal.text == "Failed exploration: none of 0 frontiers inside of the boundary can be reached"
    )


@pytest.mark.parametrize(
    ("corners", "frame", "why"),
    [
        (_ROOM, "mars", "mars"),
        (_ROOM[:2], "map", "the boundary has 2 corners; 3 or more make a polygon"),
    ],
)
def test_a_polygon_that_is_none_is_refused(
    bench: Any, serve: Any, corners: Any, frame: str, why: str
) -> None:
    World(bench)
    send = serve()

    def refusal() -> str:
        goal = send(corners, frame)
        bench.eventually(lambda: goal.is_done)
        assert goal.status.name == "ABORTED"
        return str(goal.text)

    # As long as it has heard of no frame at all it says that.
    bench.eventually(lambda: why in refusal())


def test_free_space_of_the_map_counts_as_unknown_when_it_is_to_be_explored(
    bench: Any, serve: Any
) -> None:
    World(bench)
    goal = serve(explore_clear_space=True)(_ROOM)
    bench.eventually(lambda: goal.is_done)
    # There is no sensor: nothing is known, and so nothing borders on the unknown.
    assert goal.text.startswith("Failed exploration")


def test_the_costmap_gets_the_size_of_the_polygon(bench: Any, serve: Any) -> None:
    World(bench)
    costmaps = bench.listen("/explore_server/explore_costmap/costmap", "nav_msgs/OccupancyGrid")
    without_map = {"plugins": _COSTMAP["plugins"][1:], "publish_frequency": 20.0}
    goal = serve(without_map, resize_to_boundary=True)(_ROOM)
    bench.eventually(lambda: costmaps and costmaps[-1].info.width == 44)
    info = costmaps[-1].info
    assert (info.height, info.origin.position.x, info.origin.position.y) == pytest.approx(
        (18, -0.4, -0.9), abs=1e-6
    )
    bench.eventually(lambda: goal.is_done)


def test_services_of_the_layer(bench: Any, serve: Any) -> None:
    World(bench)
    serve(frontier_travel_point="centroid")
    below = "/explore_server/explore_costmap/explore_boundary"
    clouds = bench.listen(f"{below}/frontiers", "sensor_msgs/PointCloud2")
    polygon = message_type("geometry_msgs/msg/PolygonStamped")()
    polygon.header.frame_id = "map"
    update = "frontier_exploration/UpdateBoundaryPolygon"
    bench.call(f"{below}/update_boundary_polygon", update, explore_boundary=polygon)
    start = message_type("geometry_msgs/msg/PoseStamped")()
    start.header.frame_id = "map"
    kind = "frontier_exploration/GetNextFrontier"

    def found() -> Any:
        try:
            return bench.call(f"{below}/get_next_frontier", kind, start_pose=start).next_frontier
        except GazelleError as error:
            assert "No frontiers found, exploration complete" in str(error)
            return None

    at = bench.eventually(found).pose.position
    assert (at.x, at.y) == pytest.approx((1.45, 0.0), abs=0.051)
    # While there was no map yet, clouds of no frontiers may have been sent.
    bench.eventually(lambda: clouds and clouds[-1].width)
    assert (clouds[-1].width, [field.name for field in clouds[-1].fields]) == (
        1, ["x", "y", "z", "intensity"],
    )  # fmt: skip


def test_an_unknown_travel_point_is_told(
    bench: Any, serve: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    World(bench)
    serve(frontier_travel_point="nearest")(())
    said: list[str] = []

    def is_told() -> bool:
        said.extend(capfd.readouterr())
        return "falling back to 'closest'" in "".join(said)

    bench.eventually(is_told)


def test_a_value_that_is_no_number_is_told(bench: Any, capfd: pytest.CaptureFixture[str]) -> None:
    World(bench)
    values = {"explore_costmap": _COSTMAP, "goal_aliasing": "near"}
    bench.graph.parameters.set("/explore_server", values)
    bench.start("frontier_exploration/explore_server")
    said: list[str] = []

    def is_told() -> bool:
        said.extend(capfd.readouterr())
        return "'goal_aliasing' is 'near'" in "".join(said)

    bench.eventually(is_told)


class Clicks:
    """RViz's tool Publish Point."""

    def __init__(self, bench: Any) -> None:
        self.bench = bench
        self.markers = bench.listen("/exploration_polygon_marker", "visualization_msgs/Marker")
        kind = "geometry_msgs/msg/PointStamped"
        self.out = bench.node.create_publisher("/clicked_point", kind)
        bench.start("frontier_exploration/explore_client")
        bench.eventually(lambda: self.out.matched)

    def click(self, x: float, y: float, frame: str = "map") -> Any:
        """Click and return the outline that is drawn then."""
        seen = len(self.markers)
        message = self.out.message_class()
        fill(message, {"header": {"frame_id": frame}, "point": {"x": x, "y": y}})
        self.out.publish(message)
        self.bench.eventually(lambda: len(self.markers) >= seen + 2)
        return self.markers[seen + 1]


def test_clicked_points_become_a_task(bench: Any) -> None:
    goals: list[ServerGoal] = []
    kind = "frontier_exploration/ExploreTask"
    server = ActionServer(bench.node, "explore_server", kind, on_goal=goals.append, ros_version=1)
    clicks = Clicks(bench)
    for count, (x, y) in enumerate(_ROOM, 1):
        line = clicks.click(x, y)
        assert (len(line.points), line.color.b) == (count, 1.0)
    line = clicks.click(_ROOM[0][0] + 0.05, _ROOM[0][1])
    assert (len(line.points), line.color.r) == (5, 1.0)
    assert clicks.click(1.0, 0.0).action == 2
    bench.eventually(lambda: goals)
    request = goals[0].request
    corners = [(p.x, p.y) for p in request.explore_boundary.polygon.points]
    assert np.array(corners) == pytest.approx(np.array(_ROOM))
    assert (request.explore_boundary.header.frame_id, request.explore_center.point.x) == ("map", 1)
    server.close()


@pytest.mark.parametrize(
    ("places", "why"),
    [
        ([(0, 0, "map"), (1, 0, "odom")], "Frame mismatch, restarting polygon selection"),
        ([(0, 0, "map"), (9, 0, "map"), (0.1, 0, "map")], "Not a valid polygon, restarting"),
        (
            [(*corner, "map") for corner in (*_ROOM, _ROOM[0], (9.0, 9.0))],
            "Center not inside polygon, restarting",
        ),
    ],
)
def test_clicks_that_make_no_polygon_start_anew(
    bench: Any, capfd: pytest.CaptureFixture[str], places: Any, why: str
) -> None:
    clicks = Clicks(bench)
    last = None
    for place in places:
        last = clicks.click(*place)
    assert last is not None and last.action == 2
    assert why in "".join(capfd.readouterr())
