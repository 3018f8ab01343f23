"""What loads controllers, runs them, and sends them commands."""

from __future__ import annotations

from gazelle.node_specs.common_topics import TF_LISTENED
from gazelle.node_specs.spec import ROS_1, ROS_2, NodeName, NodeRole, NodeSpec, listens, offers

__all__ = ["CONTROL"]

CONTROL = (
    NodeSpec(
        package="controller_manager",
        executable="controller_manager",
        ros=ROS_1,
        entry="gazelle.nodes.controller_manager.command:run",
        does="lists, loads, starts, stops and unloads controllers",
        is_light=True,
        aliases=(NodeName("pr2_controller_manager", "pr2_controller_manager", ROS_1),),
        role=NodeRole.CONTROLLER_SPAWNER,
        is_complete=True,
    ),
    NodeSpec(
        package="controller_manager",
        executable="ros2_control_node",
        ros=ROS_2,
        entry="gazelle.nodes.controller_manager.ros2_control_node:run",
        does="runs controllers on mock hardware, without a simulation",
        is_light=False,
        parameters="gazelle.nodes.controller_manager.ros2_control_node:PARAMETERS",
        name="controller_manager",
        services=(
            offers("~cleanup_controller", "controller_manager_msgs/srv/CleanupController"),
            offers("~configure_controller", "controller_manager_msgs/srv/ConfigureController"),
            offers("~list_controller_types", "controller_manager_msgs/srv/ListControllerTypes"),
            offers("~list_controllers", "controller_manager_msgs/srv/ListControllers"),
            offers(
                "~list_hardware_components", "controller_manager_msgs/srv/ListHardwareComponents"
            ),
            offers(
                "~list_hardware_interfaces", "controller_manager_msgs/srv/ListHardwareInterfaces"
            ),
            offers("~load_controller", "controller_manager_msgs/srv/LoadController"),
            offers(
                "~reload_controller_libraries",
                "controller_manager_msgs/srv/ReloadControllerLibraries",
            ),
            offers(
                "~set_hardware_component_state",
                "controller_manager_msgs/srv/SetHardwareComponentState",
            ),
            offers("~switch_controller", "controller_manager_msgs/srv/SwitchController"),
            offers("~unload_controller", "controller_manager_msgs/srv/UnloadController"),
        ),
        frames=None,
        joints=None,
    ),
    NodeSpec(
        package="controller_manager",
        executable="spawner",
        entry="gazelle.nodes.controller_manager.spawner:run",
        does="loads and starts controllers",
        is_light=True,
        aliases=(NodeName("pr2_controller_manager", "spawner", ROS_1),),
        role=NodeRole.CONTROLLER_SPAWNER,
        is_complete=True,
    ),
    NodeSpec(
        package="controller_manager",
        executable="spawner.py",
        ros=ROS_2,
        entry="gazelle.nodes.controller_manager.spawner_ros2:run",
        does="loads and activates controllers, ROS 2's older name",
        is_light=True,
        role=NodeRole.CONTROLLER_SPAWNER,
        is_complete=True,
    ),
    NodeSpec(
        package="controller_manager",
        executable="unspawner",
        entry="gazelle.nodes.controller_manager.spawner:run_unspawner",
        does="stops controllers",
        is_light=True,
        aliases=(NodeName("pr2_controller_manager", "unspawner", ROS_1),),
    ),
    NodeSpec(
        package="controller_manager",
        executable="hardware_spawner",
        ros=ROS_2,
        entry="gazelle.nodes.controller_manager.hardware_spawner:run",
        does="configures or activates hardware of ros2_control",
        is_light=True,
    ),
    NodeSpec(
        package="controller_manager",
        executable="unspawner.py",
        ros=ROS_2,
        entry="gazelle.nodes.controller_manager.spawner_ros2:run_unspawner",
        does="deactivates and unloads controllers, ROS 2's older name",
        is_light=True,
    ),
    NodeSpec(
        package="ros2_controllers_test_nodes",
        executable="publisher_forward_position_controller",
        ros=ROS_2,
        entry="gazelle.nodes.ros2_controllers_test_nodes.forward_position:run",
        does="sends one list of commands after another to a forward controller",
        is_light=True,
        parameters="gazelle.nodes.ros2_controllers_test_nodes.forward_position:PARAMETERS",
        aliases=(
            NodeName("ros2_control_test_nodes", "publisher_forward_position_controller", ROS_2),
        ),
    ),
    NodeSpec(
        package="ros2_controllers_test_nodes",
        executable="publisher_joint_trajectory_controller",
        ros=ROS_2,
        entry="gazelle.nodes.ros2_controllers_test_nodes.joint_trajectory:run",
        does="sends one goal after another to a joint_trajectory_controller",
        is_light=True,
        parameters="gazelle.nodes.ros2_controllers_test_nodes.joint_trajectory:PARAMETERS",
        aliases=(
            NodeName("ros2_control_test_nodes", "publisher_joint_trajectory_controller", ROS_2),
        ),
        name="publisher_position_trajectory_controller",
    ),
    NodeSpec(
        package="force_torque_sensor_broadcaster",
        executable="wrench_transformer_node",
        ros=ROS_2,
        entry="gazelle.nodes.filters.wrench_transformer:run",
        does="turns wrenches into other frames",
        is_light=True,
        parameters="gazelle.nodes.filters.wrench_transformer:PARAMETERS",
        name="fts_wrench_transformer",
        topics=(
            listens("~wrench", "geometry_msgs/msg/WrenchStamped"),
            *TF_LISTENED,
        ),
    ),
)
