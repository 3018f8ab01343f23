"""Bags into files that other programs read: CSV, Parquet, PNG, MP4."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable
from io import BytesIO
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.bag.storage import BagError, BagMessage, BagReader, Connection, Encoding
from gazelle.bag.types import bag_types, message_class
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import GazelleError
from gazelle.interfaces import Duration, Time, TypeStore, from_cdr, from_ros1
from gazelle.interfaces.stamps import seconds_of
from gazelle.sensors.film_files import FilmError, open_film

__all__ = ["FORMATS", "export_bag", "picture", "reader_of", "row_of"]

_IMAGE_TYPES = ("Image", "CompressedImage")
_CHANNELS = {"rgb8": "RGB", "bgr8": "BGR", "rgba8": "RGBA", "bgra8": "BGRA"}
_GREY = {"mono8": np.uint8, "8UC1": np.uint8, "mono16": np.uint16, "16UC1": np.uint16}
_BAYER = ("bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8")
_TIME = "time_s"
_MAX_ARRAY = 64
_Read = Callable[[bytes], Any]
_EXTRA = "pip install 'gazelle-sim[bags]'"
_Writer = Callable[[BagReader, Connection, _Read, Path, float], list[Path]]


def picture(message: Any) -> Any:
    """Return an image message as an array ``(height, width, 3)`` of bytes.

    Depth (``32FC1``, metres) and 16 bit become grey from the nearest (black) to the farthest.

    Raises:
        BagError: the encoding is not known, or the data are too short.
    """
    if hasattr(message, "format"):
        from PIL import Image

        return np.asarray(Image.open(BytesIO(bytes(message.data))).convert("RGB"))
    height, width, step = message.height, message.width, message.step
    data = np.frombuffer(bytes(message.data), np.uint8)
    if len(data) < height * step:
        raise BagError(f"an image of {height} rows of {step} bytes holds only {len(data)} bytes")
    rows = data[: height * step].reshape(height, step)
    encoding = message.encoding
    if encoding in _CHANNELS:
        order = _CHANNELS[encoding]
        found = rows[:, : width * len(order)].reshape(height, width, len(order))
        return found[..., [order.index(letter) for letter in "RGB"]]
    if encoding in _BAYER:
        return _grey(rows[:, :width])
    if encoding in _GREY:
        values = _values(rows, width, np.dtype(_GREY[encoding]), message.is_bigendian)
        return _grey(values if values.dtype == np.uint8 else _stretched(values))
    if encoding == "32FC1":
        return _grey(_stretched(_values(rows, width, np.dtype(np.float32), message.is_bigendian)))
    raise BagError(f"images of encoding '{encoding}' are not drawn")


def reader_of(connection: Connection, types: TypeStore) -> Callable[[bytes], Any]:
    """Return the function that reads a connection's messages.

    Args:
        connection: of a bag.
        types: of the bag.

    Raises:
        NotFoundError: nothing defines the type.
    """
    kind = message_class(connection, types)
    if connection.encoding is Encoding.ROS1:
        return lambda data: from_ros1(kind, data)
    return lambda data: from_cdr(kind, data)


def row_of(stamp_ns: int, message: Any) -> dict[str, Any]:
    """Return the values of a message by column; arrays longer than 64 by their length only."""
    row: dict[str, Any] = {_TIME: stamp_ns / 1e9}
    _flatten("", message, row)
    return row


def _columns_of(messages: Iterable[BagMessage], read: Callable[[bytes], Any]) -> list[str]:
    """Return the columns that any of the messages has, in the order they come up."""
    columns: dict[str, None] = {_TIME: None}
    for one in messages:
        columns.update(dict.fromkeys(row_of(one.stamp_ns, read(one.data))))
    return list(columns)


def export_bag(
    bag: BagReader,
    folder: Path,
    form: str,
    *,
    topics: Iterable[str] = (),
    rate_hz: float = 0.0,
    diagnostics: Diagnostics,
) -> list[Path]:
    """Write the topics of a bag into files; returns them.

    Args:
        bag: where they come from.
        folder: where they go; it is made.
        form: ``csv``, ``parquet``, ``png`` or ``mp4``; the last two for images only.
        topics: which, all that fit by default.
        rate_hz: of films; the median of the images by default.
        diagnostics: told of topics that cannot be read.

    Raises:
        BagError: a topic is not there, no topic fits, or a library is missing.
    """
    types = bag_types(bag.connections).store
    chosen = _chosen(bag, set(topics), images=form in ("png", "mp4"))
    folder.mkdir(parents=True, exist_ok=True)
    files: list[Path] = []
    for topic, one in chosen.items():
        stem = folder / topic.strip("/").replace("/", "_")
        try:
            files += _WRITERS[form](bag, one, reader_of(one, types), stem, rate_hz)
        except BagError:
            raise
        except GazelleError as error:
            text = f"topic {topic} ({one.type_name}) is left out: {error}"
            diagnostics.report("bag.not-converted", text, SourceSpan(str(bag.path)))
    return files


def _values(rows: Any, width: int, kind: np.dtype[Any], big: int) -> Any:
    size = kind.itemsize
    packed = np.ascontiguousarray(rows[:, : width * size])
    return packed.view(kind.newbyteorder(">" if big else "<"))


def _stretched(values: Any) -> Any:
    values = values.astype(np.float64)
    good = values[np.isfinite(values)]
    low, high = (good.min(), good.max()) if good.size else (0.0, 1.0)
    scaled = (np.nan_to_num(values, nan=high, posinf=high, neginf=low) - low) / max(
        high - low, 1e-9
    )
    return (255 * scaled).astype(np.uint8)


def _grey(values: Any) -> Any:
    return np.repeat(values.astype(np.uint8)[..., None], 3, axis=2)


def _flatten(name: str, value: Any, row: dict[str, Any]) -> None:
    if isinstance(value, Time | Duration):
        row[name] = value.to_sec()
    elif isinstance(value, str | bool | int | float | np.generic):
        row[name] = value.item() if isinstance(value, np.generic) else value
    elif isinstance(value, bytes | bytearray | memoryview | list | tuple | np.ndarray):
        if len(value) > _MAX_ARRAY or isinstance(value, bytes | bytearray | memoryview):
            row[f"{name}.length"] = len(value)
            return
        for index, item in enumerate(value):
            _flatten(f"{name}.{index}", item, row)
    else:
        fields = [item.name for item in type(value).FIELDS]
        if fields == ["sec", "nanosec"]:
            row[name] = seconds_of(value)
            return
        for field in fields:
            own = getattr(value, field, None)
            if own is not None:
                _flatten(f"{name}.{field}" if name else field, own, row)


def _chosen(bag: BagReader, topics: set[str], *, images: bool) -> dict[str, Connection]:
    known = {one.topic: one for one in bag.connections}
    if missing := sorted(topics - known.keys()):
        raise BagError(
            f"{bag.path}: there is no topic {missing[0]}, but {', '.join(sorted(known))}"
        )
    found = {
        topic: one
        for topic, one in known.items()
        if (not topics or topic in topics)
        and (not images or one.type_name.rpartition("/")[2] in _IMAGE_TYPES)
    }
    if not found:
        what = "images (sensor_msgs/Image or CompressedImage)" if images else "messages"
        raise BagError(f"{bag.path}: no topic holds {what}")
    return found


def _rows(
    bag: BagReader, one: Connection, read: _Read
) -> tuple[list[str], Iterable[dict[str, Any]]]:

    def wanted(other: Connection) -> bool:
        return other.topic == one.topic

    columns = _columns_of(bag.messages(wanted), read)
    return columns, (row_of(item.stamp_ns, read(item.data)) for item in bag.messages(wanted))


def _csv(bag: BagReader, one: Connection, read: _Read, stem: Path, _rate_hz: float) -> list[Path]:
    columns, rows = _rows(bag, one, read)
    path = stem.with_name(f"{stem.name}.csv")
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        writer.writerows(rows)
    return [path]


def _parquet(
    bag: BagReader, one: Connection, read: _Read, stem: Path, _rate_hz: float
) -> list[Path]:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise BagError(f"Parquet files need pyarrow; {_EXTRA}") from None
    columns, rows = _rows(bag, one, read)
    held = list(rows)
    table = pyarrow.table({name: [row.get(name) for row in held] for name in columns})
    path = stem.with_name(f"{stem.name}.parquet")
    pyarrow.parquet.write_table(table, path)
    return [path]


def _png(bag: BagReader, one: Connection, read: _Read, stem: Path, _rate_hz: float) -> list[Path]:
    from PIL import Image

    files = []
    stem.mkdir(parents=True, exist_ok=True)
    for item in bag.messages(lambda other: other.topic == one.topic):
        seconds, rest = divmod(item.stamp_ns, 1_000_000_000)
        files.append(stem / f"{seconds}.{rest:09d}.png")
        Image.fromarray(picture(read(item.data))).save(files[-1])
    return files


def _mp4(bag: BagReader, one: Connection, read: _Read, stem: Path, rate_hz: float) -> list[Path]:
    path = stem.with_name(f"{stem.name}.mp4")
    items = bag.messages(lambda other: other.topic == one.topic)
    stamps = [item.stamp_ns for item in bag.messages(lambda other: other.topic == one.topic)]
    frames = (picture(read(item.data)) for item in items)
    first = next(frames, None)
    if first is None:
        return []
    size = (first.shape[1], first.shape[0])
    try:
        with open_film(path, size, rate_hz or _median_rate_hz(stamps)) as film:
            for frame in chain([first], frames):
                film.add(frame)
    except FilmError as error:
        raise BagError(str(error)) from None
    return [path]


def _median_rate_hz(stamps: list[int]) -> float:
    from itertools import pairwise
    from statistics import median

    gaps = [after - before for before, after in pairwise(stamps) if after > before]
    return 1e9 / median(gaps) if gaps else 1.0


_WRITERS: dict[str, _Writer] = {"csv": _csv, "parquet": _parquet, "png": _png, "mp4": _mp4}
FORMATS = tuple(_WRITERS)
"""What bags can be exported to."""
