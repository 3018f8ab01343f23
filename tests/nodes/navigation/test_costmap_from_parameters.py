"""Costmaps from parameter files of both generations."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from gazelle.diagnostics import Diagnostics
from gazelle.navigation.costmap import (
    InflationLayer,
    ObstacleLayer,
    StaticLayer,
    VoxelOptions,
)
from gazelle.nodes.navigation.costmap_from_parameters import Assembly, assemble


def _made(tree: dict[str, Any], **options: Any) -> tuple[Assembly, list[str]]:
    diagnostics = Diagnostics()
    return assemble(tree, "/costmap", diagnostics, **options), [str(item) for item in diagnostics]


def _kinds(made: Assembly) -> list[type]:
    return [type(layer) for layer in made.costmap.layers]


def test_turtlebot3s_costmaps_come_up_without_a_word(workspaces_dir: Path) -> None:
    folder = workspaces_dir / "turtlebot3_ws/src/turtlebot3/turtlebot3_navigation/param"

    def read(name: str) -> dict[str, Any]:
        tree: dict[str, Any] = yaml.safe_load((folder / name).read_text())
        return tree

    shared = read("costmap_common_params_burger.yaml")
    local, said = _made({**shared, **read("local_costmap_params.yaml")["local_costmap"]})
    assert said == []
    assert _kinds(local) == [ObstacleLayer, InflationLayer]
    options = local.costmap.options
    assert (options.rolling_window, options.width, options.resolution) == (True, 3.0, 0.05)
    assert local.costmap.grid.costs.shape == (60, 60)
    (source,) = local.sources.values()
    assert (source.topic, source.data_type) == ("scan", "LaserScan")
    assert (source.obstacle_range, source.raytrace_range) == (3.0, 3.5)
    # The outline is padded by 1 cm.
    assert local.costmap.footprint.corners[0] == pytest.approx((-0.115, -0.115))
    whole, said = _made({**shared, **read("global_costmap_params.yaml")["global_costmap"]})
    assert said == []
    assert _kinds(whole) == [StaticLayer, ObstacleLayer, InflationLayer]
    assert whole.costmap.layers[2].options.inflation_radius == 1.0


def test_plugins_of_ros_1_name_layers_and_types() -> None:
    made, said = _made(
        {
            "plugins": [
                {"name": "walls", "type": "costmap_2d::StaticLayer"},
                {"name": "seen", "type": "costmap_2d::VoxelLayer"},
            ],
            "walls": {"map_topic": "/walls"},
            "seen": {
                "observation_sources": "cloud",
                "cloud": {"data_type": "PointCloud2", "topic": "/points"},
                "z_voxels": 8,
            },
            "obstacle_range": 1.5,
        }
    )
    assert said == []
    assert [layer.name for layer in made.costmap.layers] == ["walls", "seen"]
    seen = made.costmap.layers[1].options
    assert isinstance(seen, VoxelOptions)
    assert seen.z_voxels == 8
    # Ranges are searched for upwards.
    assert made.sources["seen", "cloud"].obstacle_range == 1.5


def test_plugins_of_nav2_are_names_with_a_plugin_each() -> None:
    scan = {"topic": "/scan", "obstacle_max_range": 2.0, "raytrace_max_range": 3.5}
    made, said = _made(
        {
            "robot_radius": 0.22,
            "plugins": ["obstacle_layer", "inflation_layer"],
            "obstacle_layer": {
                "plugin": "nav2_costmap_2d::ObstacleLayer",
                "observation_sources": "scan",
                "scan": scan,
            },
            "inflation_layer": {"plugin": "nav2_costmap_2d::InflationLayer"},
        },
        ros_version=2,
    )
    assert said == []
    assert made.costmap.footprint.circumscribed_m == pytest.approx(0.22, abs=0.02)
    source = made.sources["obstacle_layer", "scan"]
    assert (source.obstacle_range, source.raytrace_range) == (2.0, 3.5)


def test_old_parameters_with_voxels() -> None:
    made, said = _made({"map_type": "voxel", "z_voxels": 4, "observation_sources": ""})
    assert said == []
    assert isinstance(made.costmap.layers[0].options, VoxelOptions)
    assert made.costmap.layers[0].options.z_voxels == 4


def test_what_does_not_fit_is_told_all_at_once() -> None:
    _, said = _made(
        {
            "footprint": "[[0, 0], [1]]",
            "plugins": [{"name": "x", "type": "costmap_2d::StaticLayr"},
                        {"name": "y", "type": "range_sensor_layer::RangeSensorLayer"}],
            "update_frequncy": 3,
        }
    )  # fmt: skip
    text = "\n".join(said)
    assert "layer 'x' is of type 'costmap_2d::StaticLayr', which is not known" in text
    assert "costmap_2d::StaticLayer" in text
    assert "sonar layers are not there; use a LaserScan source" in text
    assert "'update_frequncy' is not one of costmap" in text
    assert "parameter 'footprint': a corner of a footprint is [x, y], not [1]" in text
    assert "[navigation.unknown-plugin]" in text
    _, said = _made({"plugins": "static"})
    assert "'plugins' is 'static', not a list" in said[0]


def test_outline_is_found_in_the_node_above() -> None:
    corners = [[-0.2, -0.2], [-0.2, 0.2], [0.3, 0.2], [0.3, -0.2]]
    made, said = _made({"footprint_padding": 0.0}, above={"footprint": corners})
    assert said == []
    assert made.costmap.footprint.corners[2] == (0.3, 0.2)


def test_layers_that_plugins_do_not_name_are_told_once() -> None:
    """As the local costmap of Nav2's default file has its static layer."""
    tree = {
        "plugins": ["inflation_layer"],
        "inflation_layer": {"plugin": "nav2_costmap_2d::InflationLayer"},
        "static_layer": {"plugin": "nav2_costmap_2d::StaticLayer", "map_topic": "m"},
        "voxel_layer": {"map_subscribe_transient_local": True},
    }
    made, said = _made(tree, ros_version=2)
    assert _kinds(made) == [InflationLayer]
    assert [text.partition(": /costmap: ")[2].partition(";")[0] for text in said] == [
        "layer 'static_layer' has parameters and is not one of plugins",
        "layer 'voxel_layer' has parameters and is not one of plugins",
    ]
    assert all("parameter.idle" in text for text in said)


@pytest.mark.parametrize(
    ("size", "cells"), [({"width": float("inf")}, "inf"), ({"width": 1e6, "height": 1e6}, "4e+14")]
)
def test_a_costmap_of_more_cells_than_can_be_held_has_the_usual_size(
    size: dict[str, Any], cells: str
) -> None:
    made, said = _made({"rolling_window": True, "plugins": [], **size})
    assert (made.costmap.grid.width, made.costmap.grid.height) == (200, 200)
    (text,) = said
    assert f"are {cells} cells of 0.05 m, 2.68e+08 can be held; 10 m and 10 m are used" in text


def test_ranges_of_the_costmap_or_above_are_those_of_sensors_that_have_none() -> None:
    tree = {
        "plugins": [{"name": "seen", "type": "costmap_2d::ObstacleLayer"}],
        "obstacle_range": 4.0,
        "seen": {"observation_sources": "scan", "scan": {"data_type": "LaserScan"}},
    }
    made, said = _made(tree, above={"obstacle_range": 1.0, "raytrace_range": 5.0})
    assert said == []
    (source,) = made.sources.values()
    assert (source.obstacle_range, source.raytrace_range) == (4.0, 5.0)
    # Nav2 looks for them with the sensor only.
    nav2 = {"plugins": ["obstacle_layer"], "obstacle_max_range": 4.0}
    _made_of_nav2, said = _made(nav2, ros_version=2)
    assert "'obstacle_max_range' is not one of costmap; it has no effect" in said[0]
