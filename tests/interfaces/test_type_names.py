from __future__ import annotations

import pytest

from gazelle.interfaces import (
    RosVersion,
    default_types,
    definition,
    known_types,
    ros1_type_of,
    wire_type,
)
from gazelle.interfaces.wire_layout import Wire, bind


@pytest.mark.parametrize(
    ("ros1", "wire"),
    [
        ("sensor_msgs/LaserScan", "sensor_msgs/msg/LaserScan"),
        ("tf/tfMessage", "tf2_msgs/msg/TFMessage"),
        ("rosgraph_msgs/Log", "rcl_interfaces/msg/Log"),
        ("dynamic_reconfigure/Config", "dynamic_reconfigure/msg/Config"),
    ],
)
def test_wire_names(ros1, wire):
    assert wire_type(ros1) == wire
    if ros1 != "tf/tfMessage":
        assert ros1_type_of(wire) == ros1


def test_service_names():
    assert wire_type("std_srvs/Empty", "srv") == "std_srvs/srv/Empty"
    assert ros1_type_of("std_srvs/srv/Empty_Request") == "std_srvs/EmptyRequest"
    assert ros1_type_of("tf2_msgs/msg/TFMessage") == "tf2_msgs/TFMessage"


def test_no_field_is_lost_between_the_generations_unless_known():
    """What ROS 1 has and the wire has not; a new definition shows up here."""
    lost = {}
    names = [name for name in known_types() if definition(name, RosVersion.ROS1).native]
    for name in names:
        layout = bind(default_types(), name, RosVersion.ROS1, Wire.CDR)
        if layout.missing:
            lost[name] = layout.missing
    assert lost == {"std_msgs/msg/Header": ("seq",)}
