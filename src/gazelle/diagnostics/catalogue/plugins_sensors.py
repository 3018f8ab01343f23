"""Codes of sensors that sit wrong and of plug-ins known by name."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "simulator.sensor-misplaced",
        "error",
        "A sensor sits where it cannot measure",
        "Force-torque sensors measure what a joint carries and stand in a joint; all others sit on "
        "a link.",
        "move the <sensor> into the joint or link named",
        "Parent of a force torque sensor must be a joint",
    ),
    Entry(
        "simulator.no-such-collision",
        "warning",
        "A contact sensor watches a collision that its link does not have",
        "Gazebo says nothing and the sensor never reports a contact. In URDF the collision is "
        "called as its name attribute says, else <link>_collision.",
        "write the collision's name as the link has it",
    ),
    Entry(
        "simulator.no-place-on-earth",
        "info",
        "A GPS needs to know where the world lies",
        "Latitude and longitude are counted from the world's <spherical_coordinates>; without them "
        "from 0, 0, as in Gazebo Classic.",
        "write <spherical_coordinates> into the world",
        "Spherical coordinates not set",
    ),
    Entry(
        "plugin.named-only",
        "warning",
        "A plug-in is known by name and does nothing",
        "It is one of the common ones, and what it does needs something that is not simulated. The "
        "rest of the model works.",
        "see docs/plugins.md for what it would have done and what there is instead",
    ),
    Entry(
        "plugin.without-effect",
        "info",
        "A plug-in does nothing by itself",
        "It is a library that other plug-ins are made of, or a template to copy.",
        "nothing to do; the element can be removed",
        quiet=True,
    ),
    Entry(
        "plugin.compiled",
        "warning",
        "A plug-in of the workspace is compiled code",
        "Its C++ source is there, but Gazelle has neither a compiler nor Gazebo's libraries. A "
        "Python file of the plug-in's name takes its place.",
        "write the plug-in in Python (docs/howto/own_plugin.md)",
        "Failed to load plugin",
    ),
    Entry(
        "plugin.user-class",
        "error",
        "A plug-in's Python file has no class for the place it stands in",
        "A plug-in in a world needs a WorldPlugin, in a model a ModelPlugin, in a sensor a "
        "SensorPlugin; with several of them the <plugin>'s name chooses.",
        "derive one class from the right base",
    ),
    Entry(
        "plugin.user-error",
        "error",
        "A plug-in of your own raised an exception",
        "Its topics are closed and it is not called again until the world is loaded anew; "
        "everything else runs on.",
        "correct the line named",
    ),
)
