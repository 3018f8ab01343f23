"""The panel Navigation, Nav2's ``.rviz`` file and maps of which only parts come."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from tests.browser.scene.rviz_page import RvizPage, stamped

from gazelle.graph.actions import ActionServer
from gazelle.interfaces import action_type, service_type

pytestmark = pytest.mark.slow

# As nav2_bringup's default view names displays, tools and panels.
_NAV2_VIEW = """
Panels:
  - {Class: rviz_common/Displays, Name: Displays}
  - {Class: nav2_rviz_plugins/Navigation 2, Name: Navigation 2}
  - {Class: nav2_rviz_plugins/Selector, Name: Selector}
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/Grid, Name: Grid, Enabled: true}
    - Class: rviz_default_plugins/Map
      Name: Map
      Enabled: true
      Topic: {Depth: 1, Durability Policy: Transient Local, Value: /map}
      Update Topic: {Value: /map_updates}
    - Class: nav2_rviz_plugins/ParticleCloud
      Name: Amcl Particle Swarm
      Color: 0; 180; 0
      Max Arrow Length: 0.3
      Min Arrow Length: 0.02
      Shape: Arrow (Flat)
      Enabled: true
      Topic: {Value: /particle_cloud}
    - Class: rviz_common/Group
      Name: Controller
      Enabled: true
      Displays:
        - Class: rviz_default_plugins/Map
          Name: Local Costmap
          Color Scheme: costmap
          Enabled: true
          Topic: {Value: /local_costmap/costmap}
        - Class: rviz_default_plugins/Polygon
          Name: Polygon
          Enabled: true
          Topic: {Value: /local_costmap/published_footprint}
  Global Options: {Fixed Frame: map}
  Tools:
    - {Class: rviz_default_plugins/MoveCamera}
    - {Class: rviz_default_plugins/SetInitialPose, Covariance yaw: 0.5, Topic: {Value: /there}}
    - {Class: nav2_rviz_plugins/GoalTool}
  Views:
    Current: {Class: rviz_default_plugins/TopDownOrtho, Scale: 60, X: 0, Y: 0, Angle: 0}
"""


class _Robot:
    """Plays the servers of Nav2 or of move_base."""

    def __init__(self, bench: Any, refused: tuple[int, ...] = ()) -> None:
        self.bench = bench
        self.goals: list[Any] = []
        self.cancelled: list[Any] = []
        self.feedback: dict[str, Any] = {}
        self.result: dict[str, Any] = {}
        self.finishes = True
        self._refused = refused

    def serve(self, name: str, kind: str) -> None:
        """Offer an action."""
        words = action_type(kind)

        def on_goal(goal: Any) -> None:
            self.goals.append(goal.request)
            goal.accept()
            if self.feedback:
                goal.publish_feedback(words.Feedback(**self.feedback))
            if len(self.goals) in self._refused:
                goal.abort(words.Result())
            elif self.finishes:
                goal.succeed(words.Result(**self.result))

        def on_cancel(goal: Any) -> bool:
            self.cancelled.append(goal.request)
            goal.cancel(words.Result())
            return True

        wire: Any = 2 if kind.startswith("nav2_msgs") else 1
        ActionServer(
            self.bench.node, name, kind, on_goal=on_goal, on_cancel=on_cancel, ros_version=wire
        )


@pytest.fixture
def above(rviz: RvizPage) -> RvizPage:
    """RViz looking straight down beside the panel Navigation."""
    rviz.eventually(lambda: rviz.report()["fixedFrame"] == "map")
    rviz.seen.panel("rviz").get_by_label("View type").select_option("TopDownOrtho")
    rviz.seen.page.get_by_role("button", name="Panels", exact=True).click()
    menu = rviz.seen.page.get_by_role("menu", name="Panels")
    menu.get_by_role("menuitem").filter(has_text="Navigation").first.click()
    rviz.seen.panel("navigation").wait_for()
    rviz.seen.page.wait_for_timeout(300)
    return rviz


def _aim(rviz: RvizPage, x: float, y: float) -> None:
    """Drag 2D Nav Goal at a place, looking along y."""
    rviz.seen.panel("rviz").get_by_role("button", name="2D Nav Goal").click()
    rviz.drag(rviz.project(x, y), rviz.project(x, y + 1))


def _value(panel: Any, name: str) -> str:
    return str(panel.get_by_label(name, exact=True).inner_text())


def _has(rows: Any, count: int) -> bool:
    return bool(rows.count() == count)


def _yaw(pose: Any) -> float:
    return 2 * math.atan2(pose.orientation.z, pose.orientation.w)


def test_waypoints_are_goals_of_move_base_one_after_the_other(above: RvizPage, bench: Any) -> None:
    robot = _Robot(bench, refused=(2,))
    robot.serve("/move_base", "move_base_msgs/MoveBase")
    panel = above.seen.panel("navigation")
    panel.get_by_role("button", name="Waypoint mode").click()
    rows = panel.get_by_role("listbox", name="Waypoints").get_by_role("option")
    for number, place in enumerate([(1.0, 0.5), (-1.0, 0.5), (0.0, -1.0)], start=1):
        _aim(above, *place)
        above.eventually(partial(_has, rows, number))
    assert not robot.goals, "a waypoint is no goal yet"
    above.seen.shot("list")
    panel.get_by_role("button", name="Follow waypoints").click()
    above.eventually(lambda: _value(panel, "State") == "finished")
    places = [goal.target_pose.pose.position for goal in robot.goals]
    assert [(round(at.x, 1), round(at.y, 1)) for at in places] == [(1, 0.5), (-1, 0.5), (0, -1)]
    assert _yaw(robot.goals[0].target_pose.pose) == pytest.approx(math.pi / 2, abs=0.05)
    assert robot.goals[0].target_pose.header.frame_id == "map"
    assert [rows.nth(i).get_attribute("data-state") for i in range(3)] == [
        "reached", "missed", "reached",
    ]  # fmt: skip
    assert "1 of 3 waypoints were missed" in _value(panel, "What the robot says")
    assert not panel.get_by_role("button", name="Navigate through poses").is_visible()


def test_waypoints_are_ordered_and_deleted_by_keys(above: RvizPage, bench: Any) -> None:
    _Robot(bench).serve("/move_base", "move_base_msgs/MoveBase")
    panel = above.seen.panel("navigation")
    panel.get_by_role("button", name="Waypoint mode").click()
    rows = panel.get_by_role("listbox", name="Waypoints").get_by_role("option")
    for x in (1.0, 2.0, -1.0):
        _aim(above, x, 0.0)
    above.eventually(lambda: rows.count() == 3)
    press = panel.get_by_role("listbox", name="Waypoints").press
    press("Alt+ArrowUp")
    assert [row.split("\n")[1].split(",")[0] for row in rows.all_inner_texts()] == [
        "1.00", "-1.00", "2.00",
    ]  # fmt: skip
    press("ArrowUp")
    assert rows.nth(0).get_attribute("aria-selected") == "true"
    press("Delete")
    assert [row.split("\n")[0] for row in rows.all_inner_texts()] == ["1", "2"]
    with above.seen.page.expect_download() as caught:
        panel.get_by_role("button", name="Save").click()
    text = caught.value.path().read_text(encoding="utf-8")
    assert text.startswith("waypoints:\n  waypoint0:\n    pose: [-1.0")
    panel.get_by_role("button", name="Clear").click()
    above.eventually(lambda: rows.count() == 0)


def test_goal_shows_what_nav2_says_and_is_cancelled(above: RvizPage, bench: Any) -> None:
    robot = _Robot(bench)
    robot.finishes = False
    words = action_type("nav2_msgs/NavigateToPose").Feedback()
    words.estimated_time_remaining.sec = 12
    robot.feedback = {
        "distance_remaining": 2.5,
        "number_of_recoveries": 3,
        "estimated_time_remaining": words.estimated_time_remaining,
    }
    robot.serve("/navigate_to_pose", "nav2_msgs/NavigateToPose")
    panel = above.seen.panel("navigation")
    cancel = panel.get_by_role("button", name="Cancel")
    assert cancel.is_disabled()
    above.eventually(lambda: panel.get_by_role("button", name="Waypoint mode").is_visible())
    _aim(above, 1.0, 0.5)
    above.eventually(lambda: _value(panel, "ETA") == "12 s")
    assert _value(panel, "Distance") == "2.50 m"
    assert _value(panel, "Recoveries") == "3"
    assert robot.goals[0].pose.pose.position.x == pytest.approx(1.0, abs=0.05)
    above.seen.shot()
    cancel.click()
    above.eventually(lambda: robot.cancelled)
    assert _value(panel, "State") == "cancelled"


def test_nav2_s_waypoint_actions_are_used_where_they_are(above: RvizPage, bench: Any) -> None:
    robot = _Robot(bench)
    robot.feedback = {"current_waypoint": 1}
    robot.serve("/follow_waypoints", "nav2_msgs/FollowWaypoints")
    goal, through = _Robot(bench), _Robot(bench)
    goal.serve("/navigate_to_pose", "nav2_msgs/NavigateToPose")
    through.serve("/navigate_through_poses", "nav2_msgs/NavigateThroughPoses")
    panel = above.seen.panel("navigation")
    panel.get_by_role("button", name="Waypoint mode").click()
    for x in (1.0, -1.0):
        _aim(above, x, 0.0)
    panel.get_by_label("Repetitions").fill("2")
    panel.get_by_role("button", name="Follow waypoints").click()
    above.eventually(lambda: _value(panel, "State") == "succeeded")
    assert [len(one.poses) for one in robot.goals] == [2]
    assert robot.goals[0].number_of_loops == 2
    assert _value(panel, "Waypoint") == "2 of 2 reached"
    panel.get_by_role("button", name="Navigate through poses").click()
    above.eventually(lambda: through.goals)
    assert [round(each.pose.position.x) for each in through.goals[0].poses] == [1, -1]
    assert not goal.goals


def test_nodes_are_paused_and_resumed_and_refusals_are_told(above: RvizPage, bench: Any) -> None:
    _Robot(bench).serve("/navigate_to_pose", "nav2_msgs/NavigateToPose")
    manage = service_type("nav2_msgs/srv/ManageLifecycleNodes")
    trigger = service_type("std_srvs/srv/Trigger")
    commands: list[int] = []

    def on_manage(request: Any) -> Any:
        commands.append(request.command)
        return manage.Response(success=request.command != 3)

    def on_active(_request: Any) -> Any:
        return trigger.Response(success=not commands or commands[-1] != 1)

    where = "/lifecycle_manager_navigation"
    bench.node.create_service(f"{where}/manage_nodes", manage, on_manage)
    bench.node.create_service(f"{where}/is_active", trigger, on_active)
    panel = above.seen.panel("navigation")
    state = panel.get_by_label(f"State of {where}")
    above.eventually(lambda: state.count() and state.inner_text() == "active")
    panel.get_by_role("button", name="Pause").click()
    above.eventually(lambda: state.inner_text() == "inactive")
    panel.get_by_role("button", name="Resume").click()
    above.eventually(lambda: state.inner_text() == "active")
    panel.get_by_role("button", name="Reset").click()
    above.eventually(lambda: commands == [1, 2, 3])
    above.eventually(lambda: "manage_nodes says no" in above.seen.toast())


def test_nav2_s_view_opens_with_its_panel_particles_and_tools(rviz: RvizPage, bench: Any) -> None:
    likely = [{"pose": {"position": {"x": 0.1 * i}}, "weight": 0.1 * i} for i in range(50)]

    def particles(_: float) -> dict[str, Any]:
        return {"header": stamped(), "particles": likely}

    bench.keep_publishing("/particle_cloud", "nav2_msgs/msg/ParticleCloud", particles, hz=2)
    _Robot(bench).serve("/navigate_to_pose", "nav2_msgs/NavigateToPose")
    got = bench.listen("/there", "geometry_msgs/msg/PoseWithCovarianceStamped")
    file = {"name": "nav2.rviz", "mimeType": "text/plain", "buffer": _NAV2_VIEW.encode()}
    rviz.seen.panel("displays").locator("input[type=file]").set_input_files(file)
    rviz.seen.panel("navigation").wait_for()
    assert "nav2_rviz_plugins/Selector do not exist here" in rviz.seen.toast()
    assert set(rviz.report()["displays"]) == {
        "Grid", "Map", "Amcl Particle Swarm", "Controller/Local Costmap", "Controller/Polygon",
    }  # fmt: skip
    rviz.shows("Amcl Particle Swarm", poses=50)
    rviz.seen.panel("rviz").get_by_role("button", name="2D Pose Estimate").click()
    rviz.drag(rviz.project(0, 0), rviz.project(1, 0))
    bench.eventually(lambda: got)
    assert (got[0].pose.covariance[0], got[0].pose.covariance[35]) == (0.25, 0.5)
    rviz.seen.shot()


def test_of_a_large_map_only_what_changes_is_sent_and_drawn(rviz: RvizPage, bench: Any) -> None:
    height, width = 1006, 1674
    cells = np.full((height, width), -1, np.int8)
    cells[100:200, 100:200] = 0
    info = {"resolution": 0.05, "width": width, "height": height}
    received = rviz.seen.page.evaluate_handle(
        """() => {
          const bytes = [];
          const open = Object.getOwnPropertyDescriptor(MessageEvent.prototype, 'data');
          Object.defineProperty(MessageEvent.prototype, 'data', {get() {
            const data = open.get.call(this);
            const kind = data instanceof ArrayBuffer ? new DataView(data).getUint16(2, true) : 0;
            if (kind >= 21) bytes.push(data.byteLength);
            return data;
          }});
          return bytes;
        }"""
    )

    def publish() -> None:
        bench.publish("/map", "nav_msgs/msg/OccupancyGrid", header=stamped(), info=info,
                      data=cells.ravel())  # fmt: skip

    def known() -> int:
        return int(rviz.counts("Map").get("known", 0))

    bench.publish(
        "/map", "nav_msgs/msg/OccupancyGrid", header=stamped(), info=info, data=cells.ravel()
    )
    rviz.add("/map", "Map")
    publish()
    rviz.eventually(lambda: known() == 10_000)
    whole = max(received.evaluate("bytes => bytes"))
    assert whole > height * width
    received.evaluate("bytes => void bytes.splice(0)")
    cells[500:520, 800:830] = 100
    publish()
    rviz.eventually(lambda: known() == 10_600)
    bench.publish("/map_updates", "map_msgs/msg/OccupancyGridUpdate", header=stamped(), x=0, y=0,
                  width=10, height=10, data=[50] * 100)  # fmt: skip
    rviz.eventually(lambda: known() == 10_700)
    parts = received.evaluate("bytes => bytes")
    assert max(parts) < 1000, "600 cells and a head"
    assert rviz.display("Map")["level"] == "ok"
