"""Codes of map files."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "map.unreadable",
        "error",
        "The YAML of a map cannot be read",
        "A map is a YAML that names a picture; map_server is given the YAML.",
        "give the path of the .yaml that map_saver wrote",
        "Map_server could not open",
    ),
    Entry(
        "map.no-yaml",
        "error",
        "The YAML of a map cannot be understood",
        "Nothing is loaded. map_server ends with an exception of yaml-cpp here.",
        "write `key: value` lines as map_saver does: image, resolution, origin, negate, "
        "occupied_thresh, free_thresh",
        "map_server exception: yaml-cpp: error",
    ),
    Entry(
        "map.bad-value",
        "error",
        "A value of a map's YAML is missing or cannot be used",
        "Sizes and places of a map come from its YAML, so nothing is guessed.",
        "such as `resolution: 0.05`, `origin: [-10.0, -10.0, 0.0]`, `negate: 0`, "
        "`occupied_thresh: 0.65`, `free_thresh: 0.196`",
        "The map does not contain a resolution tag or it is invalid.",
    ),
    Entry(
        "map.unknown-key",
        "warning",
        "A map's YAML has a key that means nothing",
        "map_server does not look at it either, so what it should do does not happen.",
        "remove it, or correct its name",
    ),
    Entry(
        "map.odd-resolution",
        "warning",
        "The cells of a map are oddly large or small",
        "`resolution` is in metres per cell: 0.05 for 5 cm. A wrong one scales the whole map, and "
        "localisation cannot match any scan with it.",
        "give the metres per cell that the map was made with, 0.05 for most",
    ),
    Entry(
        "map.no-image",
        "error",
        "The picture of a map is not there",
        "`image` counts from the folder of the YAML. map_saver writes the name as it was given, "
        "so maps that were moved, or saved by a relative path, name the wrong place.",
        "put the picture beside the YAML and write only its name, such as `image: map.pgm`",
        "failed to open image file",
    ),
    Entry(
        "map.bad-image",
        "error",
        "The picture of a map cannot be read",
        "PGM, PNG, BMP and other common pictures are read.",
        "save the map anew, or export the picture as PGM or PNG",
        "failed to open image file",
    ),
)
