"""Codes of the materials' reader."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
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
