from __future__ import annotations

import pytest

from gazelle.errors import NotFoundError
from gazelle.interfaces import action_type, known_types, ros1_service_type, service_type


def test_ros2_service_bundles_request_and_response():
    found = service_type("std_srvs/SetBool")
    assert found is not None and found == service_type("std_srvs/srv/SetBool")
    assert found.Request(data=True).data
    assert found.Response.TYPE_NAME == "std_srvs/srv/SetBool_Response"


def test_ros1_service_has_genpy_attributes():
    found = ros1_service_type("gazebo_msgs/SpawnModel")
    assert found is ros1_service_type("gazebo_msgs/srv/SpawnModel")
    assert found._request_class._type == "gazebo_msgs/SpawnModelRequest"
    assert found._request_class.__name__ == "SpawnModelRequest"
    assert found._request_class("m", "<sdf/>", "", None, "world").model_xml == "<sdf/>"
    assert found._response_class(success=True).status_message == ""


def test_action_has_its_services_and_feedback():
    found = action_type("example_interfaces/Fibonacci")
    assert found.Goal(order=3).order == 3
    assert found.SendGoal.Request().goal.order == 0
    assert found.GetResult.Response().result == found.Result()
    assert found.FeedbackMessage().goal_id.uuid.size == 16


def test_every_service_and_action_can_be_made():
    for name in known_types("srv"):
        assert service_type(name).name == name
        assert name == ros1_service_type(name).TYPE_NAME
    for name in known_types("action"):
        assert action_type(name).name == name
    assert len(known_types("srv")) > 120


def test_unknown_service_says_what_is_near():
    with pytest.raises(NotFoundError, match=r"service type .* did you mean 'std_srvs/srv/Trigger'"):
        service_type("std_srvs/Triger")
    with pytest.raises(NotFoundError, match="action type"):
        action_type("nav2_msgs/NavigateTo")
