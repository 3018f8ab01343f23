"""Codes of loading a description of any format."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "load.not-found",
        "error",
        "A robot, model or world does not exist",
        "Nothing is loaded.",
        "correct the path or name",
        "Unable to find uri",
    ),
    Entry(
        "load.unknown-format",
        "error",
        "A file is no robot, model or world",
        "Its outermost element is neither <robot> nor <sdf>.",
        "give a URDF, xacro, SDF or world file, or a model's folder",
        "Error parsing XML in file",
    ),
    Entry(
        "load.nothing",
        "error",
        "A file holds no model or no world",
        "The file was read and is of the right kind, but what was asked for is not in it.",
        "give a file with a <model> (for a robot) or a <world>",
        "Unable to find <world> element",
    ),
    Entry(
        "load.stand-in",
        "info",
        "A model of the same name stands in for one of a server or of Gazebo's model database",
        "Nothing is downloaded. Gazelle has its own models for the names that worlds use most: "
        "the places and sizes are the original's, the shapes are plain.",
        "nothing; for the original put its folder into GAZEBO_MODEL_PATH or GZ_SIM_RESOURCE_PATH, "
        "or a copy of Fuel's cache into ~/.gz/fuel",
    ),
    Entry(
        "load.off-path",
        "info",
        "A model was found in a folder that no search path names",
        "Gazelle also looks around the file that names the model and in the models folders of "
        "the workspace's packages.",
        "nothing here; for Gazebo name the folder in GAZEBO_MODEL_PATH or GZ_SIM_RESOURCE_PATH",
    ),
)
