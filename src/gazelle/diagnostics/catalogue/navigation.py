"""Codes of maps, mapping and navigation."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

_MAPS = (
    Entry(
        "map.unreadable",
        "error",
        "The YAML of a map cannot be read",
        "A map is a YAML that names a picture; map_server is given the YAML.",
        "give the path of the .yaml that map_saver wrote",
        "Map_server could not open",
    ),
    Entry(
        "map.no-yaml",
        "error",
        "The YAML of a map cannot be understood",
        "Nothing is loaded. map_server ends with an exception of yaml-cpp here.",
        "write `key: value` lines as map_saver does: image, resolution, origin, negate, "
        "occupied_thresh, free_thresh",
        "map_server exception: yaml-cpp: error",
    ),
    Entry(
        "map.bad-value",
        "error",
        "A value of a map's YAML is missing or cannot be used",
        "Sizes and places of a map come from its YAML, so nothing is guessed.",
        "such as `resolution: 0.05`, `origin: [-10.0, -10.0, 0.0]`, `negate: 0`, "
        "`occupied_thresh: 0.65`, `free_thresh: 0.196`",
        "The map does not contain a resolution tag or it is invalid.",
    ),
    Entry(
        "map.unknown-key",
        "warning",
        "A map's YAML has a key that means nothing",
        "map_server does not look at it either, so what it should do does not happen.",
        "remove it, or correct its name",
    ),
    Entry(
        "map.odd-resolution",
        "warning",
        "The cells of a map are oddly large or small",
        "`resolution` is in metres per cell: 0.05 for 5 cm. A wrong one scales the whole map, and "
        "localisation cannot match any scan with it.",
        "give the metres per cell that the map was made with, 0.05 for most",
    ),
    Entry(
        "map.no-image",
        "error",
        "The picture of a map is not there",
        "`image` counts from the folder of the YAML. map_saver writes the name as it was given, "
        "so maps that were moved, or saved by a relative path, name the wrong place.",
        "put the picture beside the YAML and write only its name, such as `image: map.pgm`",
        "failed to open image file",
    ),
    Entry(
        "map.bad-image",
        "error",
        "The picture of a map cannot be read",
        "PGM, PNG, BMP and other common pictures are read.",
        "save the map anew, or export the picture as PGM or PNG",
        "failed to open image file",
    ),
)

_MAPPING = (
    Entry(
        "mapping.bad-line",
        "warning",
        "A line of a log cannot be read",
        "A number is missing or is none, so the line says nothing certain; the others are used.",
        "delete the line, or write it as the format says",
    ),
    Entry(
        "mapping.lua",
        "error",
        "A configuration of cartographer is not understood",
        "Configurations are Lua: assignments, tables, arithmetic, functions and include; loops are "
        "not. The file has to return its table of options.",
        "write it as cartographer_ros' own configurations are",
        "Check failed: status == 0",
    ),
    Entry(
        "mapping.no-scans",
        "error",
        "A log holds no scans with odometry",
        "Mapping needs both: scans of a lidar, and where odometry saw the robot at those times.",
        "record the scan topic together with /tf (or /odom), or name the scan topic",
    ),
    Entry(
        "mapping.log-unreadable",
        "error",
        "A log is in no format that is known",
        "Known are CARMEN logs (FLASER, ROBOTLASER1), numpy archives with t, scans and odo, and "
        "bags.",
        "convert it to a CARMEN log or to a bag",
    ),
    Entry(
        "mapping.stamps",
        "warning",
        "Stamps of a log do not tell the time",
        "Scans are taken in the order of the file, so the map is none the worse; how long it "
        "lasted is not known, and relations that are given by time are not found.",
        "convert the log again, or record it on a machine whose clock is not set on the way",
    ),
    Entry(
        "mapping.scan-without-pose",
        "warning",
        "Scans could not be placed by odometry",
        "No transform from odometry's frame to the lidar was known at their times.",
        "publish the transform of the lidar's frame, and odometry, while scans are recorded",
        "MessageFilter: Dropped 100.00% of messages so far",
    ),
)

_NODES = (
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

ENTRIES = (*_MAPS, *_MAPPING, *_NODES)
