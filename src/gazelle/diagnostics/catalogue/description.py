"""Codes of descriptions of any format: loading, checks, inertia, meshes, materials, conversion."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

_LOAD = (
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

_CHECKS = (
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
        "robot.size-unit",
        "warning",
        "A length of a shape is in millimetres",
        "A part of a robot is longer than a house: URDF and SDF take lengths as metres.",
        "write the length in metres",
        "robot explodes or is nowhere to be seen",
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

_INERTIA = (
    Entry(
        "inertia.box",
        "warning",
        "A link's inertia does not fit the size of its shapes",
        "The box of even density with the same mass and tensor shows how large a body would have "
        "to be. No body inside the shapes can have an edge of it more than √3 times theirs; a "
        "box of less than a fifth of them is a placeholder or a wrong unit.",
        "paste the block shown",
        "robot shakes, wobbles or tips over for no reason",
    ),
    Entry(
        "inertia.center",
        "warning",
        "A link's centre of mass lies outside its shapes",
        "A body's centre of mass is inside its bounding box. CAD programs give it in the "
        "assembly's frame, or in millimetres; URDF and SDF want the link's frame and metres.",
        "paste the block shown",
        "robot tips over as soon as it is spawned",
    ),
    Entry(
        "inertia.density",
        "warning",
        "A link's mass does not fit the volume of its shapes",
        "Materials have between 20 kg/m³ (foam) and 20,000 kg/m³ (tungsten, gold).",
        "correct the mass, or the size of the shapes",
        "robot flies away, or nothing can lift it",
    ),
    Entry(
        "inertia.mass",
        "error",
        "A link's mass is not positive",
        "No physics engine can move such a body; Gazebo drops the link or refuses the model.",
        "write the mass in kilograms, greater than 0",
        "urdf2sdf: link has a non-positive mass; A link named ... has invalid inertia.",
    ),
    Entry(
        "inertia.mass-ratio",
        "warning",
        "A joint ties a heavy body to a very light one",
        "Solvers of contacts and joints converge badly when masses differ by more than 1000; the "
        "light body shakes or the joint comes apart.",
        "give the light body more mass, or fix it to its neighbour",
        "ODE Message 3: LCP internal error, s <= 0",
    ),
    Entry(
        "inertia.missing",
        "warning",
        "A moving link has no inertia",
        "Gazebo drops such a link of a URDF with all that hangs on it, and gives one of an SDF "
        "1 kg and moments of 1 kg·m².",
        "paste the block shown and correct the mass",
        "urdf2sdf: link has no <inertial> block defined, not modeled in sdf",
    ),
    Entry(
        "inertia.not-positive",
        "error",
        "A link's inertia tensor is not positive definite",
        "It takes work to turn a body about any axis, so all principal moments are greater than "
        "0. The new Gazebo refuses a negative one, and Gazebo Classic diverges; where some are 0, "
        "both go on, and this is a warning.",
        "paste the block shown",
        "A link named ... has invalid inertia.",
    ),
    Entry(
        "inertia.triangle",
        "warning",
        "A link's inertia tensor breaks the triangle inequality",
        "Each principal moment is an integral of two squared distances, so none is larger than "
        "the sum of the other two. Such a tensor often is one about the joint, not about the "
        "centre of mass, or has its axes mixed up.",
        "paste the block shown",
        "A link named ... has invalid inertia.",
    ),
    Entry(
        "inertia.units",
        "warning",
        "A link's mass, inertia or mesh is in the wrong unit",
        "URDF and SDF are in metres, kilograms and kg·m². CAD programs export millimetres, grams "
        "and g·mm²; the message names the factor that makes everything fit.",
        "multiply with the factor shown",
        "robot is gigantic, invisible, or explodes when it is spawned",
    ),
)

_MESHES = (
    Entry(
        "mesh.unreadable",
        "error",
        "A mesh file cannot be used",
        "It is missing, truncated, malformed or of a format that is not known.",
        "export the mesh again as STL, DAE, OBJ or glTF",
        "Could not load resource",
    ),
    Entry(
        "mesh.extra-bytes",
        "warning",
        "A binary STL is longer than its triangle count says",
        "The triangles promised are used, the rest is not.",
        "export the mesh again",
        "Invalid number of triangles",
    ),
    Entry(
        "mesh.missing-texture",
        "warning",
        "A texture of a mesh is missing",
        "The part is shown in its plain colour.",
        "put the picture beside the mesh file or into the model's materials/textures",
        "Unable to find file",
    ),
    Entry(
        "mesh.missing-material",
        "warning",
        "A mesh names a material that is nowhere",
        "The part is shown in the plain colour of its visual.",
        "put the .mtl file beside the .obj file",
        "Unable to find file",
    ),
    Entry(
        "mesh.incomplete",
        "warning",
        "Parts of a mesh file cannot be used",
        "The rest of the file is used.",
        "export the mesh again",
    ),
    Entry(
        "mesh.up-axis",
        "info",
        "A Collada file declares another up axis than z",
        "Gazebo and RViz do not look at <up_axis>, and robot packages rely on that.",
        "nothing, when the mesh stands as wanted; else rotate it in its <origin> or <pose>",
    ),
)

_MATERIALS = (
    Entry(
        "material.unknown",
        "warning",
        "A material's name is not known",
        "Neither the named scripts nor Gazebo's own list have it; the surface is shown in grey. "
        "Gazebo shows it white or the previous material's colour.",
        "correct the name, add the script's <uri>, or give <ambient> and <diffuse>",
        "Unable to get Material[name] for Geometry. Object will appear white",
    ),
    Entry(
        "material.plain-colour",
        "info",
        "A material of Gazebo's with a picture is shown in one colour",
        "Gazebo's pictures are not part of Gazelle; the surface gets the picture's mean look.",
        "nothing; give the visual its own texture where the picture matters",
    ),
    Entry(
        "material.script-missing",
        "warning",
        "A material script's file or folder is missing",
        "The material is looked for in the other places named and in Gazebo's own list.",
        "correct the <uri> or add the folder to GAZEBO_MODEL_PATH",
        "Could not open file[...] material script",
    ),
    Entry(
        "material.texture-missing",
        "warning",
        "A material's picture is missing",
        "The surface is shown in the material's colours alone.",
        "put the picture in the model's materials/textures folder and name that in a <uri>",
        "Cannot locate resource ... in resource group",
    ),
    Entry(
        "material.bad-script",
        "warning",
        "A material script cannot be understood",
        "Everything up to the place shown is used.",
        "check braces and numbers at the place shown",
        "ScriptCompiler - error in material script",
    ),
)

_CONVERT = (
    Entry(
        "convert.left-out",
        "warning",
        "A fact of the source has no place in the other format",
        "It is named here and in a comment at the head of the new file. Everything else is there.",
        "add it by hand where the new file's program wants it, or stay with the source's format",
    ),
    Entry(
        "convert.approximated",
        "info",
        "A fact of the source is said in other words",
        "The other format has no word for it; what is written instead means the same or nearly "
        "the same, as the message says.",
        "nothing, unless another program relies on the names",
    ),
    Entry(
        "convert.renamed",
        "info",
        "Names are written differently in the new file",
        "The other format does not allow the name. Plug-ins inside the file name the new one.",
        "use the new names in YAML and launch files",
    ),
    Entry(
        "convert.loop",
        "warning",
        "A joint closes a kinematic loop, which URDF cannot describe",
        "A URDF is a tree: every link is the child of at most one joint. The joint is left out, "
        "so what it held together comes apart.",
        "keep the robot in SDF or MJCF, or close the loop with a plug-in",
        "urdf: link '...' has multiple parent joints",
    ),
    Entry(
        "convert.several-models",
        "error",
        "A file holds several models and the other format only one",
        "A URDF is one robot.",
        "name the one that is meant with --model",
    ),
    Entry(
        "convert.file-address",
        "info",
        "A mesh or texture is named by another address",
        "ROS finds files by package:// and file://; model:// is Gazebo's own.",
        "copy the file to where the new address leads",
        "Could not load resource ... Unable to open file",
    ),
    Entry(
        "convert.sdformat",
        "warning",
        "What Gazebo's own library says while it turns a file into SDF",
        "URDF and SDF become SDF of a release the way Gazebo itself does it, with its remarks: "
        "links lumped or dropped, elements it does not know.",
        "correct the source when Gazebo shall read it as it is meant",
    ),
    Entry(
        "convert.no-links",
        "error",
        "Nothing of a robot would be left in the SDF",
        "Gazebo's library drops a link without <inertial>, and all links that hang on it, without "
        "a word. Nothing is written. Gazelle itself loads the robot with estimated inertia.",
        "give the link an <inertial> (gazelle inertia writes one), or join it to an empty root link"
        " by a fixed joint",
        "urdf2sdf: link has no <inertial> block defined, not modeled in sdf",
    ),
    Entry(
        "convert.mjcf-outside",
        "info",
        "Something that moves the robot is not part of the MJCF file",
        "Controllers, plug-ins, sensors and motors of Gazebo act on MuJoCo from outside. The file "
        "holds bodies, joints and contacts, which move as in Gazelle when nothing else acts.",
        "write actuators for the joints, or control them from Python",
    ),
    Entry(
        "convert.mjcf",
        "error",
        "MuJoCo refuses a file",
        "Its own words are part of the message.",
        "correct the file; 'python -m mujoco.viewer --mjcf=FILE' shows the same",
        "ValueError: XML Error / Error: ...",
    ),
)

ENTRIES = (*_LOAD, *_CHECKS, *_INERTIA, *_MESHES, *_MATERIALS, *_CONVERT)
