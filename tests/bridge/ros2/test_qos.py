"""Quality of service that differs on the two sides."""

from __future__ import annotations

from gazelle.bridge.ros2.qos import QosProfile, request_for, widened
from gazelle.bridge.ros2.ros2_graph import RosEndpoint


def end(node: str = "/rviz", *, reliable: bool = True, latched: bool = False) -> RosEndpoint:
    return RosEndpoint(node, "/scan", "sensor_msgs/msg/LaserScan", reliable, latched)


def test_own_quality_is_offered_where_it_serves() -> None:
    for own in (QosProfile(False, False, 5), QosProfile(True, False, 5), QosProfile(True, True, 1)):
        for asked in ([], [end(reliable=False)]):
            assert widened("/robot", "/scan", own, asked) == (own, {})


def test_reliable_is_offered_to_those_who_ask_for_it() -> None:
    own = QosProfile(reliable=False, depth=5)
    qos, told = widened("/robot", "/scan", own, [end(reliable=False), end()])
    assert qos == QosProfile(True, False, 5)
    assert list(told) == ["RELIABILITY"]
    assert told["RELIABILITY"].startswith(
        "topic /scan: /robot publishes best effort and /rviz of ROS 2 asks for reliable; ROS 2 "
        "would not connect them [bridge.qos-adapted]"
    )


def test_latched_is_offered_to_those_who_ask_for_it() -> None:
    qos, told = widened("/robot", "/scan", QosProfile(), [end(latched=True)])
    assert qos.latched
    assert told["DURABILITY"].endswith(
        "ROS says: requesting incompatible QoS. No messages will be sent to it. Last incompatible "
        "policy: DURABILITY"
    )


def test_what_all_publishers_offer_is_asked_for() -> None:
    assert request_for("/scan", []) == (QosProfile(True, False, 20), {})
    assert request_for("/scan", [end()]) == (QosProfile(True, False, 20), {})
    assert request_for("/scan", [end(), end(reliable=False)]) == (QosProfile(False, False, 20), {})
    assert request_for("/map", [end(latched=True)]) == (QosProfile(True, True, 100), {})


def test_latched_and_other_publishers_of_one_topic_are_told() -> None:
    qos, told = request_for("/map", [end("/a", latched=True), end("/b")])
    assert qos == QosProfile(True, False, 20)
    assert told["DURABILITY"].startswith(
        "topic /map has latched (transient local) publishers and others in ROS 2: /a latched, /b "
        "volatile; what was latched before the bridge asked does not cross [bridge.qos-mixed]"
    )
