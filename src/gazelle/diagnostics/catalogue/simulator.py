"""Codes of the world server, its plug-ins and its sensors."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

_SERVER = (
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

_PLACEMENT = (
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
        "Its C++ source is there, but Gazelle does not have the libraries of Gazebo. A "
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

_SENSORS = (
    Entry(
        "sensors.unknown-submesh",
        "warning",
        "A mesh has no part of the name asked for",
        "Nothing is shown in its place; sensors do not see it.",
        "use one of the names listed, or remove <submesh> to use the whole mesh",
    ),
    Entry(
        "sensors.unusable-shape",
        "warning",
        "A height map or a polyline cannot be turned into a surface",
        "Sensors do not see it.",
        "use a greyscale image of at least 2×2 pixels, or an outline of at least three points",
    ),
    Entry(
        "sensors.unreadable-texture",
        "warning",
        "A texture cannot be read",
        "The surface is shown in its plain colour.",
        "check the path, and save the image as PNG or JPEG",
        "Texture file not found",
    ),
    Entry(
        "sensors.wide-angle-lens",
        "warning",
        "A wide-angle lens is drawn as a pinhole",
        "The picture shows the right things; straight lines stay straight, as they would not.",
        'use type="camera" with a field of view below 180 degrees, and <distortion> for its lens',
    ),
)

ENTRIES = (*_SERVER, *_PLACEMENT, *_SENSORS)
