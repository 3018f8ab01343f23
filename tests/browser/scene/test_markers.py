"""Marker, MarkerArray and InteractiveMarkers."""

from __future__ import annotations

from typing import Any

import pytest
from tests.browser.scene.rviz_page import RvizPage, stamped

pytestmark = pytest.mark.slow

_TYPES = range(12)


def _marker(number: int, kind: int, **fields: Any) -> dict[str, Any]:
    points = [{"x": 0.0}, {"x": 0.5}, {"x": 0.5, "y": 0.5}]
    return {
        "header": stamped(), "ns": f"type{kind}", "id": number, "type": kind, "action": 0,
        "pose": {"position": {"x": 0.7 * (number % 12), "z": 0.3}, "orientation": {"w": 1.0}},
        "scale": {"x": 0.3, "y": 0.3, "z": 0.3} if kind not in (4, 5) else {"x": 0.05},
        "color": {"r": 0.2, "g": 0.6, "b": 1.0, "a": 1.0}, "text": f"Text {number}",
        "points": points if kind in (4, 6, 7, 8, 11) else points[:2] if kind == 5 else [],
    } | fields  # fmt: skip


def test_every_type_of_marker_is_drawn_and_namespaces_hide_them(rviz: RvizPage, bench: Any) -> None:
    markers = [_marker(kind, kind) for kind in _TYPES if kind != 10]
    bench.keep_publishing(
        "/shapes", "visualization_msgs/msg/MarkerArray", lambda _: {"markers": markers}, hz=3
    )
    rviz.add("/shapes", "MarkerArray")
    rviz.shows("MarkerArray", markers=11, **{f"type{kind}": 1 for kind in _TYPES if kind != 10})
    before = rviz.report()["triangles"]
    rviz.opened("MarkerArray").get_by_text("Namespaces", exact=True).click()
    rviz.row("MarkerArray").get_by_label("type2", exact=True).uncheck()
    rviz.eventually(lambda: rviz.report()["triangles"] < before)
    rviz.seen.shot()


def test_thousand_equal_markers_are_one_draw_call(rviz: RvizPage, bench: Any) -> None:
    markers = [_marker(number, 1, ns="cubes") for number in range(1000)]
    bench.keep_publishing(
        "/cubes", "visualization_msgs/msg/MarkerArray", lambda _: {"markers": markers}, hz=2
    )
    rviz.add("/cubes", "MarkerArray")
    rviz.shows("MarkerArray", markers=1000, drawCalls=1)
    assert rviz.report()["calls"] < 30


def test_markers_end_with_their_lifetime_and_by_deleting(rviz: RvizPage, bench: Any) -> None:
    rviz.seen.page.evaluate("gazelle.addDisplay('Marker', {Topic: '/marker'}, 'rviz')")
    bench.publish("/marker", "visualization_msgs/msg/Marker", **_marker(1, 1))
    bench.eventually(lambda: bench.graph.subscription_count("/marker") == 1)
    rviz.eventually(
        lambda: _sent(bench, _marker(1, 1)) and rviz.counts("Marker").get("markers") == 1
    )
    bench.publish("/marker", "visualization_msgs/msg/Marker", **_marker(2, 2, lifetime={"sec": 1}))
    rviz.shows("Marker", markers=2)
    rviz.shows("Marker", markers=1)
    bench.publish("/marker", "visualization_msgs/msg/Marker", **_marker(1, 1, action=2))
    rviz.shows("Marker", markers=0)


def _sent(bench: Any, marker: dict[str, Any]) -> bool:
    bench.publish("/marker", "visualization_msgs/msg/Marker", **marker)
    return True


def test_wrong_marker_is_told(rviz: RvizPage, bench: Any) -> None:
    nothing = {"r": 1.0, "g": 0.0, "b": 0.0, "a": 0.0}
    bench.keep_publishing(
        "/marker", "visualization_msgs/msg/Marker", lambda _: _marker(1, 1, color=nothing), hz=3
    )
    rviz.add("/marker", "Marker")
    rviz.eventually(lambda: rviz.counts("Marker").get("markers") == 1)
    assert rviz.display("Marker")["level"] == "warn"
    assert "color.a is 0" in rviz.display("Marker")["status"]["Markers"]


def test_interactive_marker_is_dragged_along_its_axis(rviz: RvizPage, bench: Any) -> None:
    feedback = bench.listen("/menu/feedback", "visualization_msgs/msg/InteractiveMarkerFeedback")
    axis = {
        "name": "move_x",
        "orientation": {"w": 1.0},
        "interaction_mode": 3,
        "always_visible": True,
    }
    marker = {
        "header": stamped(),
        "name": "handle",
        "description": "Drag me",
        "scale": 1.0,
        "controls": [axis],
        "pose": {"position": {"x": 0.0, "y": 0.0, "z": 0.5}, "orientation": {"w": 1.0}},
    }
    update = {"server_id": "menu", "type": 1, "markers": [marker]}
    bench.keep_publishing(
        "/menu/update", "visualization_msgs/msg/InteractiveMarkerUpdate", lambda _: update, hz=2
    )
    rviz.add("/menu/update", "InteractiveMarkers")
    rviz.shows("InteractiveMarkers", markers=1, controls=1)
    panel = rviz.seen.panel("rviz")
    panel.get_by_role("button", name="Interact").click()
    rviz.drag(rviz.project(0.55, 0, 0.5), rviz.project(1.55, 0, 0.5))
    bench.eventually(lambda: any(one.event_type == 5 for one in feedback))
    last = feedback[-1]
    assert (last.marker_name, last.control_name) == ("handle", "move_x")
    assert last.pose.position.x == pytest.approx(1.0, abs=0.1)
    assert last.pose.position.y == pytest.approx(0.0, abs=1e-6)
    assert last.pose.position.z == pytest.approx(0.5, abs=1e-6)
