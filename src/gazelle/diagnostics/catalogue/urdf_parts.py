"""Codes of URDF's shapes, materials, ``<gazebo>`` blocks and transmissions."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

_SHAPES = (
    Entry(
        "urdf.origin-twice",
        "warning",
        "An <origin> gives its rotation twice",
        "quat_xyzw is used.",
        "remove rpy or quat_xyzw",
    ),
    Entry(
        "urdf.geometry-missing",
        "error",
        "A visual or collision has no shape",
        "It is left out.",
        "add <geometry> with a <box>, <cylinder>, <sphere>, <capsule> or <mesh>",
        "Could not parse collision element for Link",
    ),
    Entry(
        "urdf.geometry-unknown",
        "error",
        "A shape is not known",
        "The visual or collision is left out.",
        "use <box>, <cylinder>, <sphere>, <capsule> or <mesh>",
        "Unknown geometry type",
    ),
    Entry(
        "urdf.geometry-incomplete",
        "error",
        "A shape lacks its size or file",
        "The visual or collision is left out.",
        "add the missing attribute",
        "shape must have a size, radius, length or filename attribute",
    ),
    Entry(
        "urdf.bad-size",
        "warning",
        "A shape's size is zero, negative or out of this world",
        "A length of 0 is 0.0001 m, as in Gazebo. Others are left out, for physics would abort.",
        "write sizes greater than 0, in metres",
        "Setting box shape's z to zero / Box shape does not support negative size",
    ),
    Entry(
        "urdf.mesh-missing",
        "warning",
        "A visual's mesh file does not exist",
        "The visual cannot be seen; everything else works.",
        "correct the address, or source the workspace that has the package",
        "Could not load resource",
    ),
    Entry(
        "urdf.collision-mesh-missing",
        "warning",
        "A collision's mesh file does not exist",
        "That part of the link touches nothing: the robot may sink or pass through things.",
        "correct the address, or source the workspace that has the package",
        "Unable to find file",
    ),
    Entry(
        "urdf.file-note",
        "warning",
        "A file was found, but not as written",
        "It works here and will fail elsewhere.",
        "write the address exactly as the file is called",
    ),
    Entry(
        "urdf.material-no-name",
        "error",
        "A material of the robot has no name",
        "No visual can refer to it.",
        'write <material name="…">',
        "Material must contain a name attribute",
    ),
    Entry(
        "urdf.duplicate-material",
        "error",
        "Two materials have the same name",
        "ROS refuses such a file; the first one counts.",
        "rename or remove one of them",
        "material is not unique.",
    ),
    Entry(
        "urdf.material-empty",
        "warning",
        "A material of the robot says nothing",
        "It has neither <color> nor <texture>.",
        'add <color rgba="r g b a"/>',
    ),
    Entry(
        "urdf.material-undefined",
        "warning",
        "A visual names a material that nobody defined",
        "The shape keeps its own look.",
        'define it: <material name="…"><color rgba="r g b a"/></material>',
        "material undefined.",
    ),
    Entry(
        "urdf.bad-rgba",
        "error",
        "A colour is not four numbers",
        "It is not used.",
        'write <color rgba="r g b a"/>, each from 0 to 1',
        "has malformed color rgba values",
    ),
    Entry(
        "urdf.rgba-range",
        "warning",
        "A colour leaves the range from 0 to 1",
        "It is clipped; people often write 0 to 255.",
        "divide by 255",
    ),
    Entry(
        "urdf.texture-missing",
        "warning",
        "A texture file does not exist",
        "The plain colour is shown.",
        "correct the address",
        "Could not load resource",
    ),
)

_GAZEBO = (
    Entry(
        "urdf.gazebo-reference",
        "warning",
        "A <gazebo reference> names nothing",
        "The whole block has no effect. Gazebo is silent about it.",
        "correct the name of the link or joint",
    ),
    Entry(
        "urdf.gazebo-material",
        "warning",
        "A Gazebo material is not known",
        "The shapes keep the look that URDF or the mesh gives them.",
        "use one of Gazebo's names, such as Gazebo/Grey",
        "Unable to find material",
    ),
    Entry(
        "urdf.gazebo-no-collision",
        "info",
        "Contact values for a link that has no collision",
        "They act on collisions; there is none.",
        "add a <collision> to the link, or remove the values",
    ),
    Entry(
        "urdf.gazebo-no-axis",
        "warning",
        "A spring on a joint that has no axis",
        "Fixed and floating joints have none.",
        "move the values to a revolute or prismatic joint",
    ),
    Entry(
        "urdf.gazebo-no-effect",
        "info",
        "A Gazebo word that has no effect",
        "Gazebo Classic itself ignores it, or it belongs to ODE's solver.",
        "remove it when convenient",
        idle=True,
    ),
    Entry(
        "urdf.gazebo-named-shape",
        "info",
        "Gazebo would pass over a named visual or collision",
        "sdformat applies <gazebo reference> values only to shapes whose name holds the link's "
        "name, or that have no name. Gazelle applies them to all.",
        "remove the shape's name, or put the link's name into it, to get the same in Gazebo",
    ),
    Entry(
        "urdf.old-controller",
        "info",
        "A plug-in in the syntax of 2011",
        "Gazebo 1.0 replaced <controller:name plugin=…> by <plugin>; it is read as such.",
        'write <plugin name="…" filename="…">',
    ),
    Entry(
        "urdf.transmission-incomplete",
        "warning",
        "A transmission lacks its type or joint",
        "It is left out.",
        "add <type>transmission_interface/SimpleTransmission</type> and a <joint>",
        "No type tag found in transmission",
    ),
    Entry(
        "urdf.transmission-joint",
        "warning",
        "A transmission names a joint that does not exist",
        "No controller can drive it.",
        "correct the joint's name",
    ),
)

ENTRIES = (*_SHAPES, *_GAZEBO)
