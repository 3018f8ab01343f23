"""Verbs of calibrations of cameras, as files of YAML hold them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb
from gazelle.errors import GazelleError

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__ = ["CalibrationError"]

_MATRICES = {
    "K": ("camera_matrix", 3, 3),
    "D": ("distortion_coefficients", 1, 0),
    "R": ("rectification_matrix", 3, 3),
    "P": ("projection_matrix", 3, 4),
}


class CalibrationError(GazelleError):
    """A text is no calibration of a camera."""


@verb("camera_calibration/parse")
def parse(host: HostContext, request: dict[str, Any]) -> dict[str, Any]:
    """Return what a text says: names, size, and the numbers of D, K, R and P.

    Raises:
        CalibrationError: it is no calibration.
    """
    from gazelle.documents.yaml import YAML_1_1, load_yaml

    del host
    tree = load_yaml(request["text"], YAML_1_1)
    if not isinstance(tree, dict):
        raise CalibrationError("a camera's calibration is a table of YAML")
    found: dict[str, Any] = {
        "camera_name": str(tree.get("camera_name", "unknown")),
        "distortion_model": str(tree.get("distortion_model", "plumb_bob")),
    }
    for key in ("image_width", "image_height"):
        if not isinstance(tree.get(key), int):
            raise CalibrationError(f"{key} is missing in the calibration, or is no whole number")
        found[key] = tree[key]
    for letter, (name, rows, columns) in _MATRICES.items():
        found[letter] = _numbers(tree, name, rows * columns)
    return found


@verb("camera_calibration/text")
def text(host: HostContext, request: dict[str, Any]) -> str:
    """Return the text of a calibration."""
    del host
    lines = [f"{key}: {request[key]}" for key in ("image_width", "image_height", "camera_name")]
    for letter, (name, rows, columns) in _MATRICES.items():
        values = request[letter]
        if letter == "D":
            lines.append(f"distortion_model: {request['distortion_model']}")
        data = ", ".join(repr(float(value)) for value in values)
        lines += [f"{name}:", f"  rows: {rows}", f"  cols: {columns or len(values)}"]
        lines.append(f"  data: [{data}]")
    return "\n".join(lines) + "\n"


def _numbers(tree: dict[str, Any], name: str, count: int) -> list[float]:
    matrix = tree.get(name)
    data = matrix.get("data") if isinstance(matrix, dict) else None
    if not isinstance(data, list) or not all(isinstance(item, int | float) for item in data):
        raise CalibrationError(f"{name} has no list of numbers as its data")
    if count and len(data) != count:
        raise CalibrationError(f"{name} has {len(data)} numbers, not {count}")
    return [float(item) for item in data]
