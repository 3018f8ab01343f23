"""Codes of meshes and mass properties."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
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
