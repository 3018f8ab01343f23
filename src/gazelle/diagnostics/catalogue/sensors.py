"""Codes of the sensors and of the scene they look at."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "sensors.unknown-submesh",
        "warning",
        "A mesh has no part of the name asked for",
        "Nothing is shown in its place; sensors do not see it.",
        "use one of the names listed, or remove <submesh> to use the whole mesh",
    ),
    Entry(
        "sensors.unusable-shape",
        "warning",
        "A height map or a polyline cannot be turned into a surface",
        "Sensors do not see it.",
        "use a greyscale image of at least 2×2 pixels, or an outline of at least three points",
    ),
    Entry(
        "sensors.unreadable-texture",
        "warning",
        "A texture cannot be read",
        "The surface is shown in its plain colour.",
        "check the path, and save the image as PNG or JPEG",
        "Texture file not found",
    ),
    Entry(
        "sensors.wide-angle-lens",
        "warning",
        "A wide-angle lens is drawn as a pinhole",
        "The picture shows the right things; straight lines stay straight, as they would not.",
        'use type="camera" with a field of view below 180 degrees, and <distortion> for its lens',
    ),
)
