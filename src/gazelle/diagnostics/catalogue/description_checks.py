"""Codes of the checks of a model that has been read."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "robot.camera-on-optical-frame",
        "warning",
        "A camera looks along the wrong axis of an optical frame",
        "Gazebo's cameras look along x of their link. An optical frame has z forward (REP 103 and "
        "145), so a sensor on it looks to the right.",
        "put the sensor on the camera's body and name the optical frame as frameName",
        "camera image is rotated by 90 degrees",
    ),
    Entry(
        "robot.caster-friction",
        "info",
        "A part that slides on the ground has a high friction",
        "A fixed ball or skid that carries weight brakes with its friction. Gazebo's default is 1.",
        "give it mu1 and mu2 of 0.01",
        "robot turns slower than commanded",
    ),
    Entry(
        "robot.collision-apart",
        "warning",
        "A collision stands beside what is seen",
        "The two have different origins; often one <origin> was forgotten.",
        "give collision and visual the same origin",
        "robot collides with invisible obstacles",
    ),
    Entry(
        "robot.contact-depth",
        "warning",
        "A contact lets a link sink in",
        "minDepth is the depth below which nothing is corrected, maxVel the highest speed of the "
        "correction.",
        "write minDepth 0.001 and maxVel 0.1",
        "robot sinks into the ground",
    ),
    Entry(
        "robot.damped-contact",
        "info",
        "A contact's damping outweighs its stiffness",
        "ODE computes ERP = h·kp / (h·kp + kd): with a large kd next to nothing of a penetration "
        "is corrected in a step.",
        "use kd of 1 to 100",
        "robot sinks into the ground slowly",
    ),
    Entry(
        "robot.joint-held",
        "warning",
        "Damping or friction of a joint is more than its motor can overcome",
        "The effort limit cuts every command; what is left after friction and damping decides how "
        "fast the joint moves.",
        "lower damping and friction, or raise the effort limit",
        "joint moves very slowly or not at all",
    ),
    Entry(
        "robot.lumped-collision",
        "warning",
        "A contact sensor watches a collision by a name that Gazebo changes",
        "Gazebo merges links behind fixed joints and renames their collisions to "
        "PARENT_fixed_joint_lump__CHILD_collision. Here both names are understood.",
        "write the name shown, or preserve the fixed joint",
        "contact sensor publishes empty states",
    ),
    Entry(
        "robot.lumped-frame",
        "info",
        "Gazebo would put another link's name into a plug-in",
        "Gazebo merges links behind fixed joints and writes the remaining link into bodyName and "
        "frameName. Here the link is kept, with its frame.",
        "preserve the fixed joint, to get the same in Gazebo",
    ),
    Entry(
        "robot.lumped-name",
        "warning",
        "A name is used that Gazebo would not have",
        "Gazebo merges links behind fixed joints: link and joint do not exist any more. Here they "
        "are kept.",
        "add <preserveFixedJoint>true</preserveFixedJoint> to the joint",
        "body_name does not exist; couldn't get joint element",
    ),
    Entry(
        "robot.lumped-value",
        "warning",
        "A value for a link would act on another one in Gazebo",
        "Gazebo merges links behind fixed joints; the last value wins for the whole body.",
        "move the value to the link that remains, or preserve the fixed joint",
        "multiple inconsistent <gravity> exists due to fixed joint reduction",
    ),
    Entry(
        "robot.mesh-unit",
        "warning",
        "A mesh is in the wrong unit",
        "STL files have no unit; CAD programs write millimetres, URDF and SDF read metres.",
        'write scale="0.001 0.001 0.001" into the <mesh>',
        "robot is gigantic or invisible",
    ),
    Entry(
        "robot.optical-frame-not-turned",
        "warning",
        "An optical frame does not have optical axes",
        "Images and clouds use z forward, x right, y down. A frame called optical must be turned "
        "by roll -π/2 and yaw -π/2 against the camera's body.",
        'write rpy="-1.5708 0 -1.5708" into the origin of its joint',
        "point cloud is rotated in RViz",
    ),
    Entry(
        "robot.preserved-massless",
        "warning",
        "A preserved fixed joint has a link without mass",
        "Gazebo drops links without mass. Lumping saves them, by merging them with one that has "
        "mass; preserving the joint takes that away.",
        "remove <preserveFixedJoint>, or give the link a small mass",
        "urdf2sdf: link has no <inertial> block defined, not modeled in sdf",
    ),
    Entry(
        "robot.root-inertia",
        "info",
        "The root link has an inertia",
        "KDL's trees have no place for it. Simulation is not concerned.",
        "add an empty root link with a fixed joint",
        "The root link has an inertia specified in the URDF, but KDL does not support a root link "
        "with an inertia.",
    ),
    Entry(
        "robot.self-overlap",
        "warning",
        "Links that collide with each other start inside each other",
        "The engine parts them with force as soon as time runs.",
        "make the collisions smaller, or remove <self_collide>",
        "robot explodes or jitters when it is spawned",
    ),
    Entry(
        "robot.size-mismatch",
        "warning",
        "Collision and visual of a link have very different sizes",
        "One of them has the wrong unit or scale.",
        "correct size or scale",
        "robot cannot pass through doors it seems to fit",
    ),
    Entry(
        "robot.soft-contact",
        "warning",
        "A contact is too soft for the weight on it",
        "A contact is a spring of kp N/m; the robot's weight presses it in.",
        "raise kp, or leave it out",
        "robot sinks into the ground",
    ),
    Entry(
        "robot.start-outside-limits",
        "info",
        "A joint starts outside its limits",
        "Models are spawned with all joints at 0 unless told otherwise; the limit then pushes.",
        "give a start position: spawn_model … -J joint value",
        "robot jumps when it is spawned",
    ),
    Entry(
        "robot.wheel-axes-opposed",
        "warning",
        "The axes of a left and a right wheel point against each other",
        "Drives give both wheels the same speed to go straight on; both axes have to point to "
        "the left.",
        "turn one axis around",
        "robot spins instead of driving straight",
    ),
    Entry(
        "robot.wheel-axis",
        "warning",
        "A wheel does not turn about its own axis",
        "The joint's axis and the axis of the wheel's cylinder differ. A URDF cylinder stands "
        "along z, an <axis> that is left out is x.",
        "write the cylinder's axis into <axis>",
        "wheels wobble, robot does not move",
    ),
    Entry(
        "robot.wheel-box",
        "warning",
        "A wheel is a box",
        "Only cylinders, spheres and round meshes roll.",
        "use a <cylinder> for the collision",
        "robot hops or bumps while it drives",
    ),
    Entry(
        "robot.wheel-in-the-air",
        "warning",
        "A drive wheel does not reach the ground",
        "The weight rests on other parts: a chassis or caster that is too low, or a centre of mass "
        "beyond the wheels.",
        "let the wheels be the lowest collisions",
        "wheels spin but robot does not move",
    ),
    Entry(
        "robot.wheel-off-centre",
        "warning",
        "A wheel turns beside its centre",
        "The joint's frame is not on the axis of the wheel's cylinder.",
        "move the joint's origin to the wheel's centre",
        "robot hops or bumps while it drives",
    ),
    Entry(
        "robot.wheel-without-collision",
        "warning",
        "A wheel has no collision",
        "Only collisions touch the ground.",
        "copy the visual's shape into a <collision>",
        "robot falls through the ground or lies on its belly",
    ),
)
