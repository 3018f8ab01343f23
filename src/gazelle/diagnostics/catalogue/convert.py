"""Codes of converting descriptions into other formats."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
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
