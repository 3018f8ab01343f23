"""Codes of the doctor: what shows only when all files of a launch are looked at together."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "doctor.unreadable",
        "error",
        "A file cannot be read",
        "Nothing that needs it can work.",
        "let yourself read it: chmod u+r FILE",
        "Permission denied",
    ),
    Entry(
        "doctor.unknown-file",
        "error",
        "A file is of no kind that can be examined",
        "The doctor reads robots (URDF, xacro, SDF), worlds, models, launch files, SRDF, YAML "
        "parameters and packages.",
        "name one of those",
    ),
    Entry(
        "doctor.nothing",
        "warning",
        "There is nothing to examine",
        "The folder holds no file of a kind that the doctor knows.",
        "name a package, a folder with robots, worlds or launch files, or a file",
    ),
    Entry(
        "doctor.packages-elsewhere",
        "warning",
        "A launch uses packages that are not here",
        "Nothing here is named alike: they exist, and are installed beside ROS. Gazelle replaces "
        "some packages of ROS and does not have these. "
        "Nodes of them are not started, files of them not included.",
        "install ROS with them, or put their sources into the workspace; nothing is wrong with "
        "the launch file",
        "ResourceNotFound",
    ),
    Entry(
        "doctor.needs-arguments",
        "info",
        "A launch file of a package needs arguments",
        "It has arguments without defaults, so nobody can start it without knowing them.",
        "examine it with its arguments",
        "RLException: requires the arg to be set",
    ),
    Entry(
        "doctor.bad-arguments",
        "error",
        "A node is started with arguments that it refuses",
        "It prints its usage and ends.",
        "correct args=; the message has the usage",
        "usage:",
    ),
    Entry(
        "doctor.world-missing",
        "error",
        "The world of a simulator is not there",
        "Gazebo starts with an empty world in this case, or ends; nothing stands where it should.",
        "correct world_name; the message lists where it was looked for",
        "Could not open file[worlds/…]",
    ),
    Entry(
        "doctor.start-fails",
        "error",
        "The simulator cannot start",
        "Nothing of the launch can work without it.",
        "see the message",
        "process has died [pid …, exit code 255, cmd gzserver …]",
    ),
    Entry(
        "doctor.spawn-fails",
        "error",
        "A model cannot be brought into the world",
        "The spawner says why and ends with exit code 1; the robot is missing.",
        "correct the spawner's arguments or the description; the message has the reason",
        "SpawnModel: Failure - … / Spawn service failed. Exiting.",
    ),
    Entry(
        "doctor.spawn-waits",
        "warning",
        "A spawner waits for something that this launch does not bring",
        "It may come from elsewhere; until then there is no robot.",
        "name a service or model that there is",
        "Waiting for service /gazebo/spawn_urdf_model",
    ),
    Entry(
        "doctor.no-controller-manager",
        "error",
        "A spawner of controllers waits for a controller manager that nobody runs",
        "It gives up after 30 s, and no controller is ever loaded.",
        "give the spawner the namespace of the robot's controller manager",
        "Controller Spawner couldn't find the expected controller_manager ROS interface.",
    ),
    Entry(
        "doctor.controller-fails",
        "error",
        "A controller that a spawner names cannot be loaded or started",
        "Its joints are not controlled; the robot collapses or stands still.",
        "load its parameters below the controller manager's namespace, with names and joints that "
        "there are",
        "Failed to load controller / Could not load controller because the type was not specified",
    ),
    Entry(
        "doctor.no-description",
        "error",
        "A node needs a robot description that is not there",
        "It ends, or publishes nothing.",
        "set robot_description before the node, in its namespace or above",
        "Could not find parameter robot_description on parameter server",
    ),
    Entry(
        "doctor.description-not-expanded",
        "error",
        "A robot description is still xacro",
        "Macros are not expanded by anyone who reads the parameter: links and joints are missing.",
        'expand it with command="$(find xacro)/xacro FILE"',
        "Error: No link elements found in urdf file / Unable to parse value [${…}]",
    ),
    Entry(
        "doctor.two-clocks",
        "error",
        "Two nodes publish /clock",
        "Time jumps between the two for every node with use_sim_time.",
        "keep one simulator, or play bags without --clock",
        "Detected jump back in time. Clearing TF buffer. / TF_OLD_DATA ignoring data from the past",
    ),
    Entry(
        "doctor.sim-time-off",
        "warning",
        "A simulator runs and use_sim_time is not true",
        "gazebo_ros sets it itself, but too late for nodes that have started: their stamps are of "
        "the wall's time.",
        'add <param name="/use_sim_time" value="true"/> at the top of the launch file',
        "Lookup would require extrapolation into the past",
    ),
    Entry(
        "doctor.sim-time-name",
        "warning",
        "use_sim_time is set under a name that nobody looks at",
        "In ROS 1 only the global /use_sim_time counts.",
        'write <param name="/use_sim_time" value="true"/>',
    ),
    Entry(
        "doctor.no-clock",
        "info",
        "use_sim_time is true and this launch has no clock",
        "That is right where the simulator is started by another launch; without one, time stands "
        "still and every node waits.",
        "nothing, when a simulator runs elsewhere; else set it to false",
        "waiting for /clock …",
    ),
    Entry(
        "doctor.paused",
        "info",
        "The simulation starts paused",
        "As the file asks for. No time passes, and nothing is published, until someone unpauses.",
        "rosservice call /gazebo/unpause_physics, or paused:=false",
    ),
    Entry(
        "doctor.joint-without-state",
        "warning",
        "Nobody publishes the state of a joint",
        "robot_state_publisher sends a moving link's tf only with its joint's state: the link and "
        "all that hangs on it have no place in RViz.",
        "start a joint_state_publisher or a joint_state_controller, or correct the topic",
        "No transform from [link] to [base_link]",
    ),
    Entry(
        "doctor.frame-two-parents",
        "warning",
        "A frame of tf gets two parents",
        "tf keeps the one that came last: the frame jumps between two places in the tree.",
        "let only one of the nodes publish the frame",
        "TF has two or more unconnected trees / frames flicker in RViz",
    ),
    Entry(
        "doctor.frame-published-twice",
        "warning",
        "Two nodes publish the same transform",
        "Their values take turns: the frame shakes when they differ.",
        "let only one of them publish it",
        "TF_REPEATED_DATA ignoring data with redundant timestamp",
    ),
    Entry(
        "doctor.frames-apart",
        "warning",
        "The tf tree falls apart",
        "Nothing can be transformed from one part to the other.",
        "publish the missing transform, or use the same name for the same frame",
        "Could not find a connection between 'odom' and 'base_link' because they are not part of "
        "the same tree. Tf has two or more unconnected trees.",
    ),
    Entry(
        "doctor.sensor-frame",
        "warning",
        "A sensor stamps its data with a frame that tf does not have",
        "RViz, SLAM and navigation drop every message of it.",
        "write the name of the sensor's link into its <frameName>",
        "MessageFilter: Dropped 100.00% of messages so far / frame does not exist",
    ),
    Entry(
        "doctor.remap-unused",
        "warning",
        "A remap is of no use",
        "None of the nodes it stands for uses the name on its left side, so nothing is renamed.",
        "write the name that the node uses",
    ),
    Entry(
        "doctor.topic-elsewhere",
        "warning",
        "Two nodes use different names for what seems to be the same topic",
        "Messages go nowhere.",
        "remap one of the names, or put both nodes into one namespace",
    ),
    Entry(
        "doctor.required-ends",
        "warning",
        "A node that ends by itself is required",
        "When a required node ends, roslaunch ends everything else.",
        "remove required from the spawner",
        "REQUIRED process [spawn_urdf-2] has died! process has finished cleanly. Initiating "
        "shutdown!",
    ),
    Entry(
        "doctor.respawn-ends",
        "warning",
        "A node that ends by itself is started again and again",
        "A model can be spawned under one name only once.",
        "remove respawn from the spawner",
        "SpawnModel: Failure - model name … already exist.",
    ),
)
