"""Costs of places: what is free, near an obstacle, or deadly, kept in layers.

Behaviour is that of ``costmap_2d`` (ROS 1, noetic) and ``nav2_costmap_2d`` (ROS 2): cells of 0 to
255, a static layer, obstacle layers that mark and clear along rays, inflation around what is
lethal, and updates of the changed window only.
"""

from __future__ import annotations

from gazelle.navigation.costmap.cost_grid import (
    FREE,
    INSCRIBED,
    LETHAL,
    UNKNOWN,
    CostGrid,
    Window,
    occupancy_of_costs,
)
from gazelle.navigation.costmap.costmap_parameters import (
    LAYER_TYPES,
    REFUSED_LAYERS,
    CostmapOptions,
    InflationOptions,
    ObstacleOptions,
    SourceOptions,
    StaticOptions,
    VoxelOptions,
)
from gazelle.navigation.costmap.footprint import Footprint, footprint_cost
from gazelle.navigation.costmap.inflation_layer import InflationLayer, inflated, inflation_costs
from gazelle.navigation.costmap.layered_costmap import Layer, LayeredCostmap
from gazelle.navigation.costmap.obstacle_layer import (
    Observation,
    ObstacleLayer,
    observation_of_scan,
)
from gazelle.navigation.costmap.static_layer import StaticLayer, costs_of_map

__all__ = [
    "FREE",
    "INSCRIBED",
    "LAYER_TYPES",
    "LETHAL",
    "REFUSED_LAYERS",
    "UNKNOWN",
    "CostGrid",
    "CostmapOptions",
    "Footprint",
    "InflationLayer",
    "InflationOptions",
    "Layer",
    "LayeredCostmap",
    "Observation",
    "ObstacleLayer",
    "ObstacleOptions",
    "SourceOptions",
    "StaticLayer",
    "StaticOptions",
    "VoxelOptions",
    "Window",
    "costs_of_map",
    "footprint_cost",
    "inflated",
    "inflation_costs",
    "observation_of_scan",
    "occupancy_of_costs",
]
