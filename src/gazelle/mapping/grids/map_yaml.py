"""The YAML beside a map's picture."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.documents.files import exists, is_folder
from gazelle.documents.yaml import ProblemKind, YamlError, YamlMapping, read_yaml_file, value_of
from gazelle.mapping.grids.pixels import MapMode

__all__ = ["MapFile", "read_map_file", "report_bad_image", "report_missing_image"]

_KEYS = ("image", "mode", "resolution", "origin", "negate", "occupied_thresh", "free_thresh")
_NEEDED = tuple(key for key in _KEYS if key != "mode")


@dataclass(frozen=True, slots=True)
class MapFile:
    """What a map's YAML says.

    Attributes:
        path: of the YAML.
        image: path of the picture.
        resolution_m: side of a cell, m.
        origin: x, y (m) and yaw (rad) of the lower left corner.
        negate: white means occupied.
        occupied_thresh, free_thresh: occupancies, 0 … 1.
        mode: how grey values are read.
        image_span: where the picture is named.
    """

    path: Path
    image: Path
    resolution_m: float
    origin: tuple[float, float, float]
    negate: bool = False
    occupied_thresh: float = 0.65
    free_thresh: float = 0.196
    mode: MapMode = MapMode.TRINARY
    image_span: SourceSpan | None = None


def read_map_file(
    path: Path | str, diagnostics: Diagnostics, ros_version: int = 1
) -> MapFile | None:
    """Read a map's YAML; None when it has errors, which are all reported.

    Args:
        path: of the YAML; ``~`` is the home folder.
        diagnostics: takes the findings.
        ros_version: whose map_server's words a missing picture is told in.
    """
    path = Path(path).expanduser()
    entries = _entries(path, diagnostics)
    if entries is None:
        return None
    reader = _Reader(path, entries, diagnostics)
    reader.check_keys()
    found = MapFile(
        path=path,
        image=reader.image(),
        resolution_m=reader.number("resolution", 0.05),
        origin=reader.origin(),
        negate=reader.negate(),
        occupied_thresh=reader.number("occupied_thresh", 0.65),
        free_thresh=reader.number("free_thresh", 0.196),
        mode=reader.mode(),
        image_span=reader.span("image"),
    )
    reader.check_values(found)
    if reader.failed:
        # Otherwise whoever reads the picture tells of it.
        reader.check_image(found, ros_version)
        return None
    return found


def report_bad_image(
    path: Path, problem: str, span: SourceSpan | None, diagnostics: Diagnostics, ros_version: int
) -> None:
    """Tell that a map's picture cannot be read, in the words of its generation's map_server."""
    text, phrase = _words_of_image(path, problem, ros_version)
    diagnostics.report("map.bad-image", text, span, phrase=phrase)


def report_missing_image(
    path: Path, span: SourceSpan | None, diagnostics: Diagnostics, ros_version: int
) -> None:
    """Tell that a map's picture is not there, and which one has nearly its name."""
    folder = path.parent
    there = sorted(item.name for item in folder.iterdir()) if is_folder(folder) else []
    text, phrase = _words_of_image(path, "there is no such file", ros_version)
    fix = did_you_mean(path.name, there)
    diagnostics.report("map.no-image", text, span, fix=fix, phrase=phrase)


def _words_of_image(path: Path, problem: str, ros_version: int) -> tuple[str, str]:
    """Return what is said of a picture, and what of it people search for."""
    if ros_version == 1:
        phrase = "failed to open image file"
        return f'{phrase} "{path}": {problem}', phrase
    phrase = "Failed to load image file"
    return f"{phrase} {path} for reason: {problem}", phrase


def _entries(path: Path, diagnostics: Diagnostics) -> dict[str, tuple[Any, SourceSpan]] | None:
    """Return value and place by key."""
    span = SourceSpan(str(path))
    document = read_yaml_file(path)
    problem = document.problem
    if problem is not None and problem.kind in {ProblemKind.UNREADABLE, ProblemKind.NOT_UTF8}:
        is_text = problem.kind is ProblemKind.UNREADABLE
        reason = problem.what if is_text else "it is not a text"
        hint = "give the .yaml, not the picture" if path.suffix in (".pgm", ".png") else ""
        diagnostics.report(
            "map.unreadable", f"the map '{path}' cannot be read: {reason}", span, fix=hint
        )
        return None
    what = "it is no mapping of names to values"
    try:
        if problem is None and isinstance(document.root, YamlMapping):
            return {
                str(value_of(key)): (value_of(value), key.span)
                for key, value in document.root.pairs
            }
    except YamlError as error:
        problem = error.problem
    if problem is not None:
        what, span = problem.what, problem.span
    diagnostics.report("map.no-yaml", f"this is no YAML of a map: {what}", span)
    return None


class _Reader:
    """Takes values out of a map's YAML and tells of every one that cannot be used."""

    def __init__(
        self, path: Path, entries: dict[str, tuple[Any, SourceSpan]], diagnostics: Diagnostics
    ) -> None:
        self.failed = False
        self._path = path
        self._entries = entries
        self._diagnostics = diagnostics

    def span(self, key: str) -> SourceSpan:
        """Return where a value stands, else the file."""
        return self._entries[key][1] if key in self._entries else SourceSpan(str(self._path))

    def check_keys(self) -> None:
        """Tell of keys that are missing and of keys that nobody reads."""
        for key in _NEEDED:
            if key not in self._entries:
                self._wrong(key, f"the map does not contain the tag '{key}'")
        for key, (_value, span) in self._entries.items():
            if key not in _KEYS:
                text = f"'{key}' means nothing in a map's YAML and is not read"
                self._diagnostics.report(
                    "map.unknown-key", text, span, fix=did_you_mean(key, _KEYS)
                )

    def number(self, key: str, default: float) -> float:
        """Return a finite number."""
        if key not in self._entries:
            return default
        value = _as_number(self._entries[key][0])
        if value is None:
            self._wrong(key, f"'{key}' is {self._entries[key][0]!r}, not a number")
            return default
        return value

    def origin(self) -> tuple[float, float, float]:
        """Return x, y and yaw."""
        value = self._entries.get("origin", ([0.0, 0.0, 0.0], None))[0]
        numbers = [_as_number(item) for item in value] if isinstance(value, list) else []
        if len(numbers) != 3 or None in numbers:
            self._wrong("origin", f"'origin' is {value!r}, not [x, y, yaw]")
            return 0.0, 0.0, 0.0
        x, y, yaw = (number or 0.0 for number in numbers)
        return x, y, yaw

    def negate(self) -> bool:
        """Return whether white means occupied."""
        value = self._entries.get("negate", (0, None))[0]
        if value not in (0, 1):
            self._wrong("negate", f"'negate' is {value!r}, it is 0 or 1")
        return value == 1

    def mode(self) -> MapMode:
        """Return how grey values are read."""
        value = self._entries.get("mode", ("trinary", None))[0]
        names = [mode.value for mode in MapMode]
        if value not in names:
            self._wrong("mode", f"Invalid mode tag {value!r}; there are {', '.join(names)}")
            return MapMode.TRINARY
        return MapMode(value)

    def image(self) -> Path:
        """Return the path of the picture, which counts from the YAML."""
        value = self._entries.get("image", ("map.pgm", None))[0]
        if not isinstance(value, str) or not value:
            self._wrong("image", f"'image' is {value!r}, not the name of a picture")
            return self._path
        return self._path.parent / Path(value).expanduser()

    def check_image(self, found: MapFile, ros_version: int) -> None:
        """Tell of a picture that is not there."""
        if "image" in self._entries and not exists(found.image):
            report_missing_image(found.image, found.image_span, self._diagnostics, ros_version)

    def check_values(self, found: MapFile) -> None:
        """Tell of values that a map cannot have."""
        resolution = found.resolution_m
        if resolution <= 0:
            self._wrong("resolution", f"'resolution' is {resolution:g} m, it must be above 0")
        elif not 0.001 <= resolution <= 10:
            text = f"a cell of this map is {resolution:g} m wide, which no robot's map is"
            self._diagnostics.report("map.odd-resolution", text, self.span("resolution"))
        for key in ("occupied_thresh", "free_thresh"):
            if not 0 <= getattr(found, key) <= 1:
                self._wrong(key, f"'{key}' is {getattr(found, key):g}, it lies in 0 … 1")
        if found.free_thresh > found.occupied_thresh:
            text = f"'free_thresh' {found.free_thresh:g} is above 'occupied_thresh' "
            self._wrong("free_thresh", f"{text}{found.occupied_thresh:g}")

    def _wrong(self, key: str, message: str) -> None:
        self.failed = True
        self._diagnostics.report("map.bad-value", message, self.span(key))


def _as_number(value: Any) -> float | None:
    """Return a finite number, also one that YAML 1.1 takes for a text such as ``1e-2``."""
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return None
    try:
        number = float(value)
    except (OverflowError, ValueError):
        return None
    return number if math.isfinite(number) else None
