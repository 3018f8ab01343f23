"""Parameters of ``explore_server`` and of its costmap's layer."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable

__all__ = ["BOUNDED_EXPLORE", "EXPLORE_SERVER", "LAYER_TYPE"]

LAYER_TYPE = "frontier_exploration::BoundedExploreLayer"

EXPLORE_SERVER = ParameterTable(
    "frontier_exploration",
    "Explores what lies inside of a polygon: the action ``ExploreTask``, by move_base. Its costmap"
    " is `explore_costmap`, with the parameters of any costmap.",
    ("frontier_exploration/explore_server",),
    (
        Parameter("frequency", "number", 0.0,
                  "how often a new goal is looked for while the robot drives;"
            " 0 for only where it has arrived", "Hz", 0.0),
        Parameter("goal_aliasing", "number", 0.1, "a new goal within half of this is the old one",
                  "m",
            0.0),
        Parameter("explore_costmap", "group", None, "the costmap that frontiers are looked for in"),
    ),
)  # fmt: skip

BOUNDED_EXPLORE = ParameterTable(
    "frontier_exploration's layer",
    "The polygon in explore_server's costmap.",
    (LAYER_TYPE,),
    (
        Parameter("enabled", "flag", True, "frontiers end at the polygon"),
        Parameter("explore_clear_space", "flag", True,
                  "what the map calls free counts as unknown until"
            " the costmap's sensors have seen it"),
        Parameter("resize_to_boundary", "flag", True, "the costmap gets the polygon's size"),
        Parameter("frontier_travel_point", "text", "closest",
                  "where to go to: closest, middle (both its"
            " nearest cell) or centroid"),
    ),
)  # fmt: skip
