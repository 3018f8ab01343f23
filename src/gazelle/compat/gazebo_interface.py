"""What `gazebo_ros.gazebo_interface` is in Gazelle: Gazebo's services as rospy's calls."""

from __future__ import annotations

import sys
from typing import Any

from gazelle.compat import rospy
from gazelle.compat.rospy.log import loginfo
from gazelle.interfaces import ros1_service_type

__all__ = ["set_model_configuration_client", "spawn_sdf_model_client", "spawn_urdf_model_client"]


def spawn_sdf_model_client(
    model_name: str,
    model_xml: str,
    robot_namespace: str,
    initial_pose: Any,
    reference_frame: str,
    gazebo_namespace: str,
) -> bool | None:
    """Put an SDF model into the world; None if the call fails.

    Args:
        model_name: its name in the world.
        model_xml: the model's text.
        robot_namespace: the namespace of its plug-ins.
        initial_pose: where, a ``geometry_msgs/Pose``.
        reference_frame: the frame of the pose; empty is the world.
        gazebo_namespace: where the services are, ``/gazebo``.
    """
    arguments = (model_name, model_xml, robot_namespace, initial_pose, reference_frame)
    return _call(f"{gazebo_namespace}/spawn_sdf_model", "SpawnModel", "Spawn status", *arguments)


def spawn_urdf_model_client(
    model_name: str,
    model_xml: str,
    robot_namespace: str,
    initial_pose: Any,
    reference_frame: str,
    gazebo_namespace: str,
) -> bool | None:
    """Put a URDF model into the world, as `spawn_sdf_model_client` does."""
    arguments = (model_name, model_xml, robot_namespace, initial_pose, reference_frame)
    return _call(f"{gazebo_namespace}/spawn_urdf_model", "SpawnModel", "Spawn status", *arguments)


def set_model_configuration_client(
    model_name: str,
    model_param_name: str,
    joint_names: list[str],
    joint_positions: list[float],
    gazebo_namespace: str,
) -> bool | None:
    """Set a model's joints, in radians and metres; None if the call fails."""
    arguments = (model_name, model_param_name, joint_names, joint_positions)
    service = f"{gazebo_namespace}/set_model_configuration"
    return _call(service, "SetModelConfiguration", "Set model configuration status", *arguments)


def _call(service: str, kind: str, said: str, *arguments: Any) -> bool | None:
    """Wait for a service and call it; what it answers is told."""
    loginfo(f"Waiting for service {service}")
    rospy.wait_for_service(service)
    call = rospy.ServiceProxy(service, ros1_service_type(f"gazebo_msgs/{kind}"))
    loginfo(f"Calling service {service}")
    try:
        answer = call(*arguments)
    except rospy.ServiceException as error:
        sys.stdout.write(f"Service call failed: {error}\n")
        return None
    loginfo(f"{said}: {answer.status_message}")
    return bool(answer.success)
