"""One file for each topic (CSV, Parquet, MP4), one for each image (PNG)."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable
from itertools import chain
from pathlib import Path
from typing import Any

from gazelle.bag.export.pictures import IMAGE_TYPES, picture
from gazelle.bag.export.rows import columns_of, reader_of, row_of
from gazelle.bag.storage import BagError, BagReader, Connection
from gazelle.bag.types import bag_types
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import GazelleError

__all__ = ["FORMATS", "export_bag"]

_Read = Callable[[bytes], Any]
_EXTRA = "pip install 'gazelle-sim[bags]'"


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
        and (not images or one.type_name.rpartition("/")[2] in IMAGE_TYPES)
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

    columns = columns_of(bag.messages(wanted), read)
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
    try:
        import imageio_ffmpeg
    except ImportError:
        raise BagError(f"MP4 files need imageio-ffmpeg; {_EXTRA}") from None
    path = stem.with_name(f"{stem.name}.mp4")
    items = bag.messages(lambda other: other.topic == one.topic)
    stamps = [item.stamp_ns for item in bag.messages(lambda other: other.topic == one.topic)]
    frames = (picture(read(item.data)) for item in items)
    first = next(frames, None)
    if first is None:
        return []
    size = (first.shape[1] // 2 * 2, first.shape[0] // 2 * 2)
    film = imageio_ffmpeg.write_frames(
        str(path), size, fps=rate_hz or _median_rate_hz(stamps), macro_block_size=2
    )
    film.send(None)
    for frame in chain([first], frames):
        film.send(frame[: size[1], : size[0]].tobytes())
    film.close()
    return [path]


def _median_rate_hz(stamps: list[int]) -> float:
    from itertools import pairwise
    from statistics import median

    gaps = [after - before for before, after in pairwise(stamps) if after > before]
    return 1e9 / median(gaps) if gaps else 1.0


_Writer = Callable[[BagReader, Connection, _Read, Path, float], list[Path]]
_WRITERS: dict[str, _Writer] = {"csv": _csv, "parquet": _parquet, "png": _png, "mp4": _mp4}
FORMATS = tuple(_WRITERS)
"""What bags can be exported to."""
