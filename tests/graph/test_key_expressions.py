from __future__ import annotations

import pytest

from gazelle.graph import key_expressions
from gazelle.graph.key_expressions import Attachment, Entity, Kind, Qos

HASH = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"


def test_topic_key_is_that_of_rmw_zenoh() -> None:
    """The example of ros2/rmw_zenoh, docs/design.md."""
    assert key_expressions.topic_key(0, "/chatter", "std_msgs/msg/String", HASH) == (
        f"0/chatter/std_msgs::msg::dds_::String_/{HASH}"
    )


def test_tokens_are_those_of_rmw_zenoh() -> None:
    node = Entity("aac3178e", 0, 0, Kind.NODE, "/listener")
    assert key_expressions.token(2, node) == "@ros2_lv/2/aac3178e/0/0/NN/%/%/listener"
    publisher = Entity(
        "aac3178e", 0, 10, Kind.PUBLISHER, "/ns/talker", "/chatter", "std_msgs/msg/String", HASH
    )
    assert key_expressions.token(0, publisher) == (
        "@ros2_lv/0/aac3178e/0/10/MP/%/%ns/talker/%chatter/"
        f"std_msgs::msg::dds_::String_/{HASH}/::,:,:,:,,"
    )


@pytest.mark.parametrize("kind", list(Kind))
def test_token_round_trip(kind: Kind) -> None:
    node = Entity("12ab", 3, 4, kind, "/a/b/name")
    entity = node if kind is Kind.NODE else Entity(
        "12ab", 3, 4, kind, "/a/b/name", "/x/y", "std_srvs/srv/Empty", HASH, Qos(False, True, 7)
    )  # fmt: skip
    assert Entity.from_token(key_expressions.token(5, entity)) == entity


@pytest.mark.parametrize(
    "text",
    ["", "a/b", "@ros2_lv/0/z/0/0/XX/%/%/n", "@ros2_lv/0/z/x/0/NN/%/%/n", "@x/0/z/0/0/NN/%/%/n"],
)
def test_what_is_no_token_is_left_out(text: str) -> None:
    assert Entity.from_token(text) is None


def test_qos_as_rmw_zenoh_writes_it() -> None:
    assert Qos().to_key() == "::,:,:,:,,"
    assert Qos(reliable=False, latched=True, depth=10).to_key() == "2:1:,10:,:,:,,"
    assert Qos.from_key("1:2:1,5:,:,:,,") == Qos(True, False, 5)
    assert Qos.from_key("") == Qos()
    assert Qos(depth=0).to_key() == "::2,:,:,:,,"
    assert Qos.from_key("::2,7:9223372036,854775807:,:,,") == Qos(depth=0)
    full = Qos(False, True, 3, 1_500_000_000, 20, True, 2_000_000_001)
    assert full.to_key() == "2:1:,3:1,500000000:0,20:3,2,1"
    assert Qos.from_key(full.to_key()) == full


def test_attachment_is_the_33_bytes_of_rmw_zenoh() -> None:
    attachment = Attachment(1, 2, bytes(range(16)))
    data = attachment.to_bytes()
    assert data == b"\1" + bytes(7) + b"\2" + bytes(7) + b"\x10" + bytes(range(16))
    assert Attachment.from_bytes(data) == attachment
    assert Attachment.from_bytes(b"short") == Attachment(0, 0, bytes(16))


def test_any_type_survives_the_wire() -> None:
    assert (
        key_expressions.ros_type(key_expressions.dds_type(key_expressions.ANY_TYPE))
        == key_expressions.ANY_TYPE
    )
    assert (
        key_expressions.ros_type("sensor_msgs::msg::dds_::LaserScan_")
        == "sensor_msgs/msg/LaserScan"
    )


def test_gid_is_16_bytes_and_the_same_everywhere() -> None:
    assert (
        key_expressions.entity_gid("x")
        == key_expressions.entity_gid("x")
        != key_expressions.entity_gid("y")
    )
    assert len(key_expressions.entity_gid("x")) == 16
