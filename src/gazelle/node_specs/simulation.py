"""The simulator, what puts models into its world, and the bridge of the new Gazebo."""

from __future__ import annotations

from gazelle.node_specs.spec import ROS_1, ROS_2, NodeName, NodeRole, NodeSpec

__all__ = ["SIMULATION"]

SIMULATION = (
    NodeSpec(
        package="gazebo_ros",
        executable="gzserver",
        ros=ROS_1,
        entry="gazelle.nodes.gzserver:run",
        does="the simulator",
        is_light=False,
        aliases=(
            NodeName("gazebo_ros", "gazebo", ROS_1),
            NodeName("gazebo_ros", "debug", ROS_1),
            NodeName("gazebo_ros", "perf", ROS_1),
            NodeName("gazebo", "gazebo", ROS_1),
            NodeName("gazebo", "gzserver", ROS_1),
        ),
        role=NodeRole.SIMULATOR,
    ),
    NodeSpec(
        package="gazebo_ros",
        executable="spawn_model",
        ros=ROS_1,
        entry="gazelle.nodes.spawn_model:run",
        does="puts a model into the running world",
        is_light=True,
        aliases=(
            NodeName("gazebo_ros", "spawn_model.py", ROS_1),
            NodeName("gazebo", "spawn_model", ROS_1),
            NodeName("gazebo", "spawn_model.py", ROS_1),
            NodeName("gazebo_tools", "gazebo_model", ROS_1),
        ),
        role=NodeRole.MODEL_SPAWNER,
    ),
    NodeSpec(
        package="gazebo_ros",
        executable="spawn_entity.py",
        ros=ROS_2,
        entry="gazelle.nodes.spawn_model:run_entity",
        does="puts a model into the running world, ROS 2's name",
        is_light=True,
        role=NodeRole.ENTITY_SPAWNER,
    ),
    NodeSpec(
        package="ros_gz_sim",
        executable="create",
        ros=ROS_2,
        entry="gazelle.nodes.ros_gz.create:run",
        does="puts a model into the running world, the new Gazebo's way",
        is_light=True,
        aliases=(NodeName("ros_ign_gazebo", "create", ROS_2),),
        name="ros_gz_sim",
    ),
    NodeSpec(
        package="ros_gz_sim",
        executable="remove",
        ros=ROS_2,
        entry="gazelle.nodes.ros_gz.remove:run",
        does="takes a model out of the running world, the new Gazebo's way",
        is_light=True,
        name="ros_gz_sim_remove_entity",
    ),
    NodeSpec(
        package="ros_gz_sim",
        executable="gzserver",
        ros=ROS_2,
        entry="gazelle.nodes.ros_gz.server:run",
        does="a world of the new Gazebo",
        is_light=False,
        name="gazebo",
        role=NodeRole.SIMULATOR,
    ),
    NodeSpec(
        package="ros_gz_bridge",
        executable="parameter_bridge",
        ros=ROS_2,
        entry="gazelle.nodes.ros_gz.parameter_bridge:run",
        does="passes topics of the new Gazebo on under names of ROS",
        is_light=True,
        aliases=(
            NodeName("ros_ign_bridge", "parameter_bridge", ROS_2),
            NodeName("ros_gz_bridge", "bridge_node", ROS_2),
        ),
        name="ros_gz_bridge",
    ),
    NodeSpec(
        package="ros_gz_image",
        executable="image_bridge",
        ros=ROS_2,
        entry="gazelle.nodes.ros_gz.parameter_bridge:run_image",
        does="passes images of the new Gazebo on",
        is_light=True,
        aliases=(NodeName("ros_ign_image", "image_bridge", ROS_2),),
        name="ros_gz_image",
    ),
)
