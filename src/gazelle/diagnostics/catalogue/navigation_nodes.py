"""Codes of navigation's nodes: parameters, plug-ins, behaviour trees."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "navigation.unknown-plugin",
        "error",
        "A plug-in of navigation is not known",
        "Planners, controllers, layers and behaviours are compiled code in ROS; Gazelle has its own"
        " under the same names.",
        "choose one of those that the message names",
        "Failed to create the planner, are you sure it is properly registered and that the "
        "containing library is built?",
    ),
    Entry(
        "navigation.tree-structure",
        "error",
        "The XML of a behaviour tree does not make a tree",
        "BehaviorTree.CPP refuses the file, and the navigator does not start.",
        "see the message",
        "Error loading XML file",
    ),
    Entry(
        "navigation.tree-unknown-node",
        "error",
        "A behaviour tree has a node of a kind that nobody knows",
        "In ROS it comes from a compiled plug-in (plugin_lib_names).",
        "choose a node of BehaviorTree.CPP or Nav2",
        "Error at line: -> Node not recognized",
    ),
    Entry(
        "navigation.tree-unknown-port",
        "error",
        "A node of a behaviour tree has no port of this name",
        "BehaviorTree.CPP refuses the tree, as it may be a typing mistake.",
        "correct the name, or take it out",
        "Possible typo? In the XML, you tried to remap port",
    ),
)
