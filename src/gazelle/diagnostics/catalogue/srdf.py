"""Codes of SRDF files."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "srdf.double-name",
        "warning",
        "An SRDF names two groups or states alike",
        "Of groups the first counts, of states the last, as in MoveIt.",
        "rename or remove one of them",
        "A group named '...' already exists. Not adding.",
    ),
    Entry(
        "srdf.empty-group",
        "warning",
        "A planning group has no joints",
        "Nothing in it leads to a joint; every request for it fails.",
        "add a <chain>, <joint>, <link> or <group> that exists",
        "must have at least one valid joint",
    ),
    Entry(
        "srdf.group-ring",
        "error",
        "Planning groups hold each other",
        "A group cannot be part of itself. It and all groups that hold it are left out.",
        "remove one of the inner <group> elements",
        "has unsatisfied subgroups",
    ),
    Entry(
        "srdf.missing-attribute",
        "warning",
        "An element of an SRDF lacks an attribute",
        "srdfdom prints an error and leaves the element out; so does Gazelle.",
        "add the attribute",
        "is not specified",
    ),
    Entry(
        "srdf.no-chain",
        "warning",
        "A chain's links are not connected",
        "The two links belong to different trees, or one of them to none.",
        "name two links with joints between them, the one nearer to the base first",
        "do not form a chain",
    ),
    Entry(
        "srdf.no-robot",
        "error",
        "The file is no SRDF",
        "An SRDF's outermost element is <robot>.",
        'write <robot name="..."> around everything',
        "Could not find the 'robot' element in the xml file",
    ),
    Entry(
        "srdf.robot-name",
        "warning",
        "SRDF and URDF are about different robots",
        "MoveIt compares the two names, prints an error and goes on; so does Gazelle.",
        "give both <robot> elements the same name",
        "Semantic description is not specified for the same robot as the URDF",
    ),
    Entry(
        "srdf.spheres",
        "info",
        "Spheres of an SRDF have no effect",
        "Collisions are checked with the links' own shapes.",
        "nothing: the shapes are more exact",
        idle=True,
    ),
    Entry(
        "srdf.fixed-state",
        "warning",
        "A named state gives a fixed joint a position",
        "A fixed joint has none. MoveIt writes a line to its log and goes on.",
        "remove the <joint> from the <group_state>",
        "The model for joint '...' requires 0 variable values",
    ),
    Entry(
        "srdf.state-outside-limits",
        "warning",
        "A named state lies outside a joint's limits",
        "A plan to it is refused, and a robot that stands there cannot start.",
        "change the value, or the joint's limits",
        "Joint '...' from the starting state is outside bounds",
    ),
    Entry(
        "srdf.virtual-joint",
        "warning",
        "A virtual joint has an unknown type",
        "There are fixed, planar and floating ones.",
        'write type="fixed", "planar" or "floating"',
        "Assuming 'fixed' instead",
    ),
)
