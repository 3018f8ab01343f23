"""Codes of the SDF reader."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "sdf.empty",
        "error",
        "The document holds nothing to load",
        "An SDF file holds at least one <world>, <model>, <light> or <actor> inside <sdf>.",
        "wrap the content in <sdf version='1.6'> … </sdf>",
        "Error reading element <sdf>",
    ),
    Entry(
        "sdf.version",
        "info",
        "The SDF version is missing, older than 1.4 or newer than 1.12",
        "The file is read all the same; words that this version does not have are named.",
        "write the version the file was made for, such as <sdf version='1.6'>",
        "sdf has a bad version or no version attribute",
    ),
    Entry(
        "sdf.bad-value",
        "warning",
        "A value makes no sense here",
        "The value named in the message is used instead, and the rest of the file is read.",
        "correct the value",
    ),
    Entry(
        "sdf.not-simulated",
        "info",
        "An element is known and has no effect in Gazelle",
        "It is legal SDF; nothing that robots measure here depends on it.",
        "nothing to do",
        idle=True,
    ),
    Entry(
        "sdf.plugin-not-loaded",
        "warning",
        "A plug-in stands where none is loaded",
        "Worlds, models and sensors have plug-ins; those of links are passed over by every Gazebo, "
        "those of visuals act on its window only.",
        "move the <plugin> into the <model>, <world> or <sensor> it is for",
    ),
    Entry(
        "sdf.extension",
        "info",
        "An element of a private namespace",
        "Elements with a prefix belong to one program; Gazelle uses those it knows by name and "
        "keeps the rest for plug-ins.",
        "nothing to do",
        quiet=True,
    ),
    Entry(
        "sdf.model-without-link",
        "error",
        "A model has no link",
        "A model is made of links; without one there is nothing to show or move.",
        "add at least one <link name='…'> with a <collision> and a <visual>",
        "A model must have at least one link.",
    ),
    Entry(
        "sdf.missing-model",
        "warning",
        "An included model is not on this machine",
        "The rest of the world is loaded without it. Gazelle never downloads models by itself; "
        "Gazebo may hang here while it asks a model server.",
        "put the model's folder into a folder named in GAZEBO_MODEL_PATH (or GZ_SIM_RESOURCE_PATH),"
        " for instance: export GAZEBO_MODEL_PATH=~/models:$GAZEBO_MODEL_PATH",
        "Unable to find uri[model://...]; Unable to find model; "
        "edit the url in ~/.ignition/fuel/config.yaml",
    ),
    Entry(
        "sdf.include-cycle",
        "error",
        "Models include each other in a circle",
        "Read to the end this would never finish; the include that closes the circle is left out.",
        "remove one of the includes of the chain",
    ),
    Entry(
        "sdf.model-config",
        "warning",
        "A model.config is incomplete",
        "The file names the model's SDF files, their versions and its author.",
        "add <sdf version='1.6'>model.sdf</sdf>",
        "Unable to find model.config / manifest",
    ),
    Entry(
        "sdf.missing-file",
        "warning",
        "A mesh or image file is missing",
        "The rest of the model is loaded; the shape is neither seen nor touched.",
        "correct the <uri> or put the file where the message says it was looked for",
        "No mesh specified / Unable to find file[...]",
    ),
    Entry(
        "sdf.bad-geometry",
        "warning",
        "A <geometry> cannot be used",
        "The collision or visual is left out; a length of 0 alone is 0.0001 m, as in Gazebo.",
        "give it one of box, sphere, cylinder, capsule, cone, ellipsoid, plane, mesh, polyline, "
        "heightmap",
        "Invalid geometry / Unable to create geometry / Setting box shape's z to zero",
    ),
    Entry(
        "sdf.duplicate-name",
        "error",
        "Two things in one scope have the same name",
        "References by name would be ambiguous. The first one is kept.",
        "rename one of them",
        "link with name[...] already exists. / Non-unique name detected",
    ),
    Entry(
        "sdf.duplicate-shape",
        "warning",
        "Two collisions or visuals of a link have the same name",
        "Gazebo loads both. Contact sensors and plug-ins that name a collision mean one of them; "
        "here the second one gets a name of its own.",
        "rename one of them",
        "Non-unique name detected",
    ),
    Entry(
        "sdf.bad-inertia",
        "error",
        "A link's mass or inertia is impossible",
        "The mass must be positive, the tensor positive definite, and no principal moment larger "
        "than the sum of the other two. What is used instead stands in the message. Gazebo refuses "
        "such a world or moves the link in impossible ways.",
        "compute the tensor from the shape, or leave <inertia> out",
        "A link named ... has invalid inertia.",
    ),
    Entry(
        "sdf.auto-inertia",
        "warning",
        "Mass properties cannot be computed from the collisions",
        "Mass 1 and inertia 1 are used, SDF's defaults.",
        "give a density and at least one collision with a volume, or write the inertia",
        "Inertial Calculation",
    ),
    Entry(
        "sdf.unknown-joint-type",
        "error",
        "A joint's type is not known",
        "The joint is left out.",
        "write one of revolute, continuous, prismatic, fixed, ball, universal, screw, revolute2, "
        "gearbox",
        "Attribute joint type of [...] is an invalid joint type.",
    ),
    Entry(
        "sdf.bad-joint",
        "error",
        "A joint's parent or child cannot be found",
        "The joint is left out.",
        "name a link, frame or nested model of this model; 'world' is allowed as parent only",
        "Child frame with name[...] specified by joint with name[...] not found in model",
    ),
    Entry(
        "sdf.unknown-frame",
        "error",
        "A frame that a pose or axis refers to does not exist",
        "The default frame is used instead.",
        "name a link, joint, frame or nested model of the same model, or __model__",
        "relative_to name[...] does not match a nested model, link, joint, or frame name",
    ),
    Entry(
        "sdf.frame-cycle",
        "error",
        "Frames depend on each other in a circle",
        "None of them has a place; the default frame is used where the circle closes.",
        "make one of them relative to __model__",
        "PoseRelativeToGraph cycle found / FrameAttachedToGraph cycle",
    ),
    Entry(
        "sdf.unknown-sensor-type",
        "warning",
        "A sensor's type is not known",
        "The sensor is left out.",
        "correct the type",
        "Attribute sensor type of [...] is an invalid sensor type.",
    ),
    Entry(
        "sdf.sensor-not-simulated",
        "info",
        "A sensor kind is known and not simulated",
        "The sensor is listed and publishes nothing.",
        "remove the sensor or use one of the simulated kinds",
    ),
    Entry(
        "sdf.unknown-light-type",
        "warning",
        "A light's type is not known",
        "It shines as a point light.",
        "write one of point, directional, spot",
        "light type is invalid",
    ),
    Entry(
        "sdf.actor",
        "info",
        "Actors are not simulated",
        "An animated person collides with nothing in Gazebo and is left out here.",
        "put a model where the person stands when sensors must see it",
    ),
    Entry(
        "sdf.state",
        "info",
        "A saved <state> is applied in part",
        "Gazelle takes over the poses of models, jointless links and lights; velocities and joint "
        "positions start from the description.",
        "remove the <state> to start from the description",
    ),
    Entry(
        "sdf.no-model",
        "error",
        "The file holds no model (or no world)",
        "It was opened as one.",
        "open it as what it is, or name another file",
        "Unable to read file / SDF does not contain a model",
    ),
)
