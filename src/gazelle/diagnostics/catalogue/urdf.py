"""Codes of robots, links, joints and inertia in URDF; phrases are those of ROS and Gazebo."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

_ROBOT = (
    Entry(
        "urdf.no-robot",
        "error",
        "The file is no robot description",
        "A URDF's outermost element is <robot>; nothing of the file is used.",
        'start the file with <robot name="…">',
        "Could not find the 'robot' element in the xml file",
    ),
    Entry(
        "urdf.no-robot-name",
        "error",
        "The robot has no name",
        "ROS refuses such a file.",
        'write <robot name="…">',
        "No name given for the robot.",
    ),
    Entry(
        "urdf.version",
        "error",
        "The version of URDF is not known",
        "ROS refuses such a file.",
        'remove the version attribute or write version="1.0"',
        "Invalid 'version' specified; only version 1.0 is currently supported",
    ),
    Entry(
        "urdf.no-links",
        "error",
        "The robot has no links",
        "There is nothing to simulate.",
        'add a <link name="base_link"/>',
        "No link elements found in urdf file",
    ),
    Entry(
        "urdf.sensor-ignored",
        "info",
        "A <sensor> stands directly under <robot>",
        "Nobody ever read this part of URDF. Gazebo's sensors stand in <gazebo reference>.",
        'move it into <gazebo reference="link"> and write it as SDF',
    ),
)

_TREE = (
    Entry(
        "urdf.link-no-name",
        "error",
        "A link has no name",
        "No joint can refer to it; it is left out.",
        'write <link name="…">',
        "No name given for the link.",
    ),
    Entry(
        "urdf.duplicate-link",
        "error",
        "Two links have the same name",
        "Joints could not tell them apart; the first one counts.",
        "rename one of them",
        "link is not unique.",
    ),
    Entry(
        "urdf.joint-no-name",
        "error",
        "A joint has no name",
        "No controller could refer to it; it is left out.",
        'write <joint name="…" type="…">',
        "unnamed joint found",
    ),
    Entry(
        "urdf.duplicate-joint",
        "error",
        "Two joints have the same name",
        "Controllers could not tell them apart; the first one counts.",
        "rename one of them",
        "joint is not unique.",
    ),
    Entry(
        "urdf.joint-ends",
        "error",
        "A joint lacks its parent or child",
        "It joins nothing and is left out.",
        'add <parent link="…"/> and <child link="…"/>',
        "is missing a parent and/or child link specification.",
    ),
    Entry(
        "urdf.parent-missing",
        "error",
        "A joint's parent link does not exist",
        "The robot would fall apart; no model is made.",
        "correct the name or add the link",
        "Failed to build tree: parent link of joint not found.",
    ),
    Entry(
        "urdf.child-missing",
        "error",
        "A joint's child link does not exist",
        "No model is made.",
        "correct the name or add the link",
        "Failed to build tree: child link of joint not found",
    ),
    Entry(
        "urdf.two-parents",
        "error",
        "A link is the child of two joints",
        "URDF describes a tree. check_urdf is silent. The joint whose name comes last counts, as "
        "in urdfdom; the other one is left out.",
        "remove one joint; close loops with an SDF joint in a <gazebo> block",
    ),
    Entry(
        "urdf.two-roots",
        "error",
        "More than one link has no parent",
        "A robot is one tree; parts without a joint to it would be lost.",
        "join the loose links to the robot",
        "Failed to find root link: Two root links found",
    ),
    Entry(
        "urdf.loop",
        "error",
        "Joints form a loop",
        "Without an end there is no root to start from.",
        "remove one joint of the loop",
        "Failed to find root link: No root link found. The robot xml is not a valid tree.",
    ),
    Entry(
        "urdf.world-link",
        "warning",
        "The link 'world' carries shapes or mass",
        "A root link called 'world' is the world itself; what hangs on it directly is not built.",
        "move the shapes to a link of their own, joined to world by a fixed joint",
    ),
)

_JOINT = (
    Entry(
        "urdf.joint-no-type",
        "error",
        "A joint has no type",
        "It is left out.",
        'write type="revolute", "continuous", "prismatic", "fixed", "floating" or "planar"',
        "has no type, check to see if it's a reference.",
    ),
    Entry(
        "urdf.joint-type",
        "error",
        "A joint's type is not known",
        "It is left out.",
        'write type="revolute", "continuous", "prismatic", "fixed", "floating" or "planar"',
        "Joint has no known type",
    ),
    Entry(
        "urdf.zero-axis",
        "error",
        "A joint's axis has no direction",
        "check_urdf is silent; Gazebo divides by its length and the robot vanishes.",
        'write a direction such as <axis xyz="0 0 1"/>',
        "The norm of the axis vector cannot be zero",
    ),
    Entry(
        "urdf.limit-missing",
        "error",
        "A revolute or prismatic joint has no limits",
        "ROS refuses such a file.",
        'add <limit lower="…" upper="…" effort="…" velocity="…"/>, or make it continuous',
        "but it does not specify limits",
    ),
    Entry(
        "urdf.limit-incomplete",
        "error",
        "A limit lacks effort or velocity",
        "ROS refuses such a file.",
        'write <limit lower="…" upper="…" effort="…" velocity="…"/>',
        "joint limit: no effort",
    ),
    Entry(
        "urdf.limit-order",
        "warning",
        "A joint's lower limit is above the upper",
        "The two are exchanged; Gazebo would lock or shake the joint.",
        "exchange lower and upper",
    ),
    Entry(
        "urdf.limit-no-range",
        "warning",
        "A joint's limits leave no range",
        "Lower and upper are equal (both are 0 when they are not written): it cannot move.",
        'write lower and upper, or use type="fixed"',
    ),
    Entry(
        "urdf.effort-zero",
        "warning",
        "A joint's effort limit is 0",
        "The value is kept: no motor can move the joint. Gazebo does the same without a word.",
        "write the largest torque (N·m) or force (N) of the motor",
    ),
    Entry(
        "urdf.velocity-zero",
        "warning",
        "A joint's velocity limit is 0",
        "The value is kept: controllers that obey limits hold the joint still.",
        "write the highest speed in rad/s or m/s",
    ),
    Entry(
        "urdf.dynamics-empty",
        "error",
        "A <dynamics> says nothing",
        "ROS refuses such a file.",
        'write damping="…" or friction="…", or remove the element',
        "joint dynamics element specified with no damping and no friction",
    ),
    Entry(
        "urdf.dynamics-negative",
        "warning",
        "Damping or friction is negative",
        "It would drive the joint instead of braking it; 0 is used.",
        "write a number that is 0 or more",
    ),
    Entry(
        "urdf.mimic-no-joint",
        "error",
        "A <mimic> does not say whom to follow",
        "ROS refuses such a file.",
        'write <mimic joint="…"/>',
        "joint mimic: no mimic joint specified",
    ),
    Entry(
        "urdf.mimic-unknown",
        "warning",
        "A <mimic> follows a joint that cannot lead",
        "The joint moves freely. ROS and Gazebo Classic are silent.",
        "correct the joint's name",
    ),
    Entry(
        "urdf.safety-incomplete",
        "error",
        "A <safety_controller> lacks k_velocity",
        "ROS refuses such a file.",
        'add k_velocity="…"',
        "joint safety: no k_velocity",
    ),
)

_INERTIA = (
    Entry(
        "urdf.inertial-incomplete",
        "error",
        "An <inertial> lacks mass or inertia",
        "check_urdf drops it with a message, Gazebo then drops the link with all that hangs on it.",
        "give <mass value> and all of ixx, ixy, ixz, iyy, iyz, izz",
        "Could not parse inertial element for Link",
    ),
    Entry(
        "urdf.negative-mass",
        "error",
        "A mass is negative",
        "check_urdf is silent; no physics engine can move such a body.",
        "write the mass in kilograms, greater than 0",
        "urdf2sdf: link has a non-positive mass",
    ),
    Entry(
        "urdf.no-inertia",
        "warning",
        "A moving link has no mass",
        "Gazebo drops the link and everything that hangs on it. Here it stays, with mass and "
        "inertia estimated from its shapes at 1000 kg/m³.",
        "paste the block shown and correct the mass",
        "urdf2sdf: link has no <inertial> block defined, not modeled in sdf",
    ),
    Entry(
        "urdf.zero-inertia",
        "warning",
        "A moving link has mass but no inertia",
        "It would turn without resistance and the simulation would diverge. The inertia is "
        "estimated from its shapes.",
        "paste the block shown",
        "A link has invalid inertia.",
    ),
    Entry(
        "urdf.bad-inertia",
        "warning",
        "An inertia tensor is impossible",
        "No body has a negative principal moment, or one greater than the sum of the other two. "
        "The nearest possible tensor is used; ROS passes it on and Gazebo may diverge.",
        "take the tensor from the CAD program about the centre of mass, in kg·m²",
        "A link has invalid inertia.",
    ),
)

ENTRIES = (*_ROBOT, *_TREE, *_JOINT, *_INERTIA)
