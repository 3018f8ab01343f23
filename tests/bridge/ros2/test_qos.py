"""Quality of service that differs on the two sides."""

from __future__ import annotations

from gazelle.bridge.ros2.qos import Quality, request_for, widened
from gazelle.bridge.ros2.ros_graph import End


def end(node: str = "/rviz", *, reliable: bool = True, latched: bool = False) -> End:
    return End(node, "/scan", "sensor_msgs/msg/LaserScan", reliable, latched)


def test_own_quality_is_offered_where_it_serves() -> None:
    for own in (Quality(False, False, 5), Quality(True, False, 5), Quality(True, True, 1)):
        for asked in ([], [end(reliable=False)]):
            assert widened("/robot", "/scan", own, asked) == (own, {})


def test_reliable_is_offered_to_those_who_ask_for_it() -> None:
    own = Quality(reliable=False, depth=5)
    quality, told = widened("/robot", "/scan", own, [end(reliable=False), end()])
    assert quality == Quality(True, False, 5)
    assert list(told) == ["RELIABILITY"]
    assert told["RELIABILITY"].startswith(
        "topic /scan: /robot publishes best effort and /rviz of ROS 2 asks for reliable; ROS 2 "
        "would not connect them [bridge.qos-adapted]"
    )


def test_latched_is_offered_to_those_who_ask_for_it() -> None:
    quality, told = widened("/robot", "/scan", Quality(), [end(latched=True)])
    assert quality.latched
    assert told["DURABILITY"].endswith(
        "ROS says: requesting incompatible QoS. No messages will be sent to it. Last incompatible "
        "policy: DURABILITY"
    )


def test_what_all_publishers_offer_is_asked_for() -> None:
    assert request_for("/scan", []) == (Quality(True, False, 20), {})
    assert request_for("/scan", [end()]) == (Quality(True, False, 20), {})
    assert request_for("/scan", [end(), end(reliable=False)]) == (Quality(False, False, 20), {})
    assert request_for("/map", [end(latched=True)]) == (Quality(True, True, 100), {})


def test_latched_and_other_publishers_of_one_topic_are_told() -> None:
    quality, told = request_for("/map", [end("/a", latched=True), end("/b")])
    assert quality == Quality(True, False, 20)
    assert told["DURABILITY"].startswith(
        "topic /map has latched (transient local) publishers and others in ROS 2: /a latched, /b "
        "volatile; what was latched before the bridge asked does not cross [bridge.qos-mixed]"
    )
