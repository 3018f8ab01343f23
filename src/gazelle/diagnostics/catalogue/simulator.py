"""Codes of the world server and its plug-ins."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "plugin.unknown",
        "warning",
        "A plug-in is not one that Gazelle has",
        "Gazebo plug-ins are compiled code, which Gazelle does not load; it has its own of the "
        "common ones. The rest of the model works, what this plug-in would have done is missing.",
        "see docs/plugins.md for the plug-ins there are, or write the behaviour as a node",
        "Failed to load plugin",
    ),
    Entry(
        "plugin.built-in",
        "info",
        "A system plug-in is part of Gazelle",
        "gz-sim loads physics, sensors, user commands and the like as plug-ins; here they are "
        "always there.",
        "nothing to do",
        quiet=True,
    ),
    Entry(
        "plugin.missing-joint",
        "error",
        "A plug-in names a joint that the model does not have",
        "The plug-in cannot work and is left out; everything else runs.",
        "write the joint's name as the <joint> element has it",
        "couldn't get joint element",
    ),
    Entry(
        "plugin.missing-link",
        "error",
        "A plug-in names a link that the model does not have",
        "The plug-in cannot work and is left out; everything else runs.",
        "write the link's name as the <link> element has it",
        "bodyName does not exist",
    ),
    Entry(
        "plugin.wrong-place",
        "error",
        "A plug-in does not stand inside the sensor it needs",
        "Camera, laser and IMU plug-ins read the sensor they stand in.",
        "move the <plugin> into a <sensor> of the right type",
        "requires a sensor as its parent",
    ),
    Entry(
        "plugin.wheel-geometry",
        "warning",
        "The drive's wheel parameters disagree with the robot's geometry",
        "Commands and wheel odometry are computed from the parameters, the motion comes from the "
        "geometry: the robot drives faster, slower or turns differently than commanded.",
        "set the wheel separation and diameter to the geometry's values",
    ),
    Entry(
        "plugin.wheels-swapped",
        "warning",
        "The drive turns the wrong way",
        "With these joints a command to turn left (positive angular.z, REP 103) turns right. "
        "Gazebo does the same; the wheels are driven as the file says.",
        "exchange the left and right joints or change <legacyMode>",
    ),
    Entry(
        "plugin.drives-backwards",
        "warning",
        "The drive's wheels turn backwards",
        "Positive speed about the joints' axes moves the robot along -x of its base: a command to "
        "drive forward drives backward.",
        "point the axes of both wheel joints to the robot's left (+y)",
    ),
    Entry(
        "plugin.legacy-mode",
        "info",
        "What <legacyMode> does to a diff drive",
        "Up to ROS Kinetic, Gazebo's plug-in drove the wheels exchanged when legacyMode is true; "
        "later releases dropped the word. Gazelle honours it, and where it is absent chooses what "
        "turns the robot the way REP 103 says.",
        "write <legacyMode>false</legacyMode> and the joints on their true sides",
        "GazeboRosDiffDrive Plugin missing <legacyMode>, defaults to true",
    ),
    Entry(
        "plugin.camera-frame",
        "info",
        "Camera data is in optical axes, its frame is not",
        "Images and clouds use z forward, x right, y down (REP 103's optical frame). The frame "
        "named is the link's, x forward, so a viewer shows the cloud turned.",
        "name an optical frame in <frameName>: a fixed joint with rpy -1.5708 0 -1.5708",
    ),
    Entry(
        "plugin.no-encoder",
        "info",
        "An image format is offered by name only",
        "The topic is listed as image_transport does, but there is no encoder for it here.",
        "subscribe to the raw or the compressed topic",
    ),
    Entry(
        "simulator.frames-dropped",
        "warning",
        "Camera frames were dropped",
        "Rendering takes longer than the camera's period; a late frame is dropped so that the "
        "physics keeps its pace.",
        "lower the resolution or rate, or use --lockstep, which waits for every frame",
    ),
    Entry(
        "simulator.sensor-not-simulated",
        "warning",
        "A sensor is of a kind that is not simulated",
        "It is kept in the model and produces no data.",
        "see docs/plugins.md for the sensors there are",
    ),
    Entry(
        "simulator.unknown-argument",
        "warning",
        "The server does not know an argument",
        "It is dropped; the world starts as if it was not there.",
        "gzserver --help lists the arguments",
    ),
    Entry(
        "simulator.server-plugin",
        "info",
        "A server plug-in is part of Gazelle",
        "ROS 1's services are offered without -s; ROS 2's by the library that offers them there.",
        "nothing to do",
        quiet=True,
    ),
)
