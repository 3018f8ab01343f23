"""Parameters without effect are known before a node is started."""

from __future__ import annotations

import pytest

from gazelle.nodes.unsupported_parameters import (
    misspelt_parameters,
    node_of_name,
    unsupported_parameters,
)


def test_slam_and_localisation_by_their_names() -> None:
    (one,) = unsupported_parameters("gmapping/slam_gmapping", {"particles": 30, "delta": 0.05}, 1)
    assert one == ("particles", "the map is a graph of poses, not a filter with particles")
    values = {"odom0": "/o", "odom0_queue_size": 2, "use_control": False, "debug": True}
    found = unsupported_parameters("robot_localization/ekf_node", values, 2)
    assert [item.key for item in found] == ["odom0_queue_size", "debug"]
    assert unsupported_parameters("my_robot/driver", {"particles": 1}, 1) == ()


def test_every_node_with_a_table_is_known() -> None:
    found = unsupported_parameters("joint_state_publisher/joint_state_publisher", {"delta": 0.1}, 1)
    assert found == (("delta", "joints stand where nothing moves them"),)
    values = {"override_timestamps_with_wall_time": False, "override_frame_id": "lidar"}
    (one,) = unsupported_parameters("ros_ign_bridge/parameter_bridge", values, 2)
    assert one == ("override_frame_id", "frames stay")
    assert unsupported_parameters("ros_ign_bridge/parameter_bridge", values, 1) == ()


def test_plug_ins_and_layers_are_looked_through() -> None:
    values = {
        "base_local_planner": "dwa_local_planner/DWAPlannerROS",
        "DWAPlannerROS": {"max_vel_x": 1.0, "publish_traj_pc": True},
        "global_costmap/plugins": [{"name": "still", "type": "costmap_2d::StaticLayer"}],
        "global_costmap/still/map_topic": "/map",
        "local_costmap": {"resolution": 0.05, "always_send_full_costmap": True},
    }
    found = unsupported_parameters("move_base/move_base", values, 1)
    assert [item.key for item in found] == ["DWAPlannerROS.publish_traj_pc"]
    values = {"static_layer": {"plugin": "nav2_costmap_2d::StaticLayer",
                               "map_subscribe_transient_local": True}}  # fmt: skip
    (one,) = unsupported_parameters("costmap", values, 2)
    assert one.key == "static_layer.map_subscribe_transient_local"


def test_nodes_by_the_names_that_files_use() -> None:
    assert node_of_name("/robot1/controller_server") == "nav2_controller/controller_server"
    assert node_of_name("local_costmap") == "costmap"
    assert node_of_name("ekf_filter_node") == "robot_localization/ekf_node"
    assert node_of_name("my_driver") == ""


@pytest.mark.parametrize(
    ("node", "values", "wanted"),
    [
        ("amcl/amcl", {"min_particels": 1}, ("min_particels", "min_particles")),
        ("amcl/amcl", {"min_particles": 1, "use_sim_time": True, "something": 1}, None),
        (
            "move_base/move_base",
            {"local_costmap": {"updat_frequency": 1.0}},
            ("local_costmap.updat_frequency", "update_frequency"),
        ),
        # A layer reads what stands above it.
        ("move_base/move_base", {"local_costmap": {"obstacle_range": 1.0}}, None),
        ("nobody/knows", {"min_particels": 1}, None),
    ],
)
def test_names_that_a_node_nearly_knows(
    node: str, values: dict[str, object], wanted: tuple[str, str] | None
) -> None:
    found = misspelt_parameters(node, values, 1)
    assert [item.key for item in found] == ([wanted[0]] if wanted else [])
    assert all(wanted is not None and f"'{wanted[1]}'" in item.hint for item in found)
