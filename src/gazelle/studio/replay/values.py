"""Topics of a replay as tables: a column for each field, numbers in steps, texts in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from gazelle.bag.export import row_of
from gazelle.interfaces.poses import pose_of_transform
from gazelle.recording import TopicTrack
from gazelle.studio.replay.packing import Pack

__all__ = ["topic_tables"]

_SHORTEST_GAP_NS = 38_000_000
_TF_GAP_NS = 95_000_000
_MOST_COLUMNS = 300
_MOST_CHARACTERS = 400
_STEPS = 2**16
_WHOLE = 2**31
_TIME = "time_s"
_TF = frozenset({"tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"})

Values = dict[str, Any]
_Row = tuple[int, Values]


def topic_tables(tracks: Sequence[TopicTrack], start_ns: int, pack: Pack) -> list[Values]:
    """Return a table for each topic that has a message; 25 rows a second at most.

    Args:
        tracks: what came.
        start_ns: time 0 of the replay.
        pack: takes the arrays.
    """
    tables = []
    for track in tracks:
        rows = list(_rows_of(track))
        if not rows:
            continue
        times_us = np.array([(time_ns - start_ns) // 1000 for time_ns, _ in rows])
        names = list(dict.fromkeys(name for _, row in rows for name in row))[:_MOST_COLUMNS]
        columns = [_column(name, [row.get(name) for _, row in rows], pack) for name in names]
        tables.append(
            {
                "name": track.name,
                "type": track.type_name.replace("/msg/", "/"),
                "count": len(track.messages),
                "times": pack.integers(times_us, 2),
                "columns": columns,
            }
        )
    return tables


def _rows_of(track: TopicTrack) -> Iterator[_Row]:
    if track.type_name in _TF:
        yield from _tf_rows(track)
        return
    last_ns = -(2**62)
    for time_ns, message in zip(track.times_ns.tolist(), track.messages, strict=True):
        if time_ns - last_ns >= _SHORTEST_GAP_NS:
            last_ns = time_ns
            row = row_of(time_ns, message)
            del row[_TIME]
            yield time_ns, row


def _tf_rows(track: TopicTrack) -> Iterator[_Row]:
    """Yield where each frame is in its parent; a message holds some of them only."""
    state: Values = {}
    last_ns = -(2**62)
    for time_ns, message in zip(track.times_ns.tolist(), track.messages, strict=True):
        for one in message.transforms:
            pose = pose_of_transform(one.transform)
            name = f"{one.header.frame_id} → {one.child_frame_id}"
            x, y, z = pose.position_m
            state |= {f"{name}.x": x, f"{name}.y": y, f"{name}.z": z}
            state[f"{name}.yaw"] = pose.xy_yaw[2]
        if time_ns - last_ns >= _TF_GAP_NS:
            last_ns = time_ns
            yield time_ns, dict(state)


def _column(name: str, cells: list[Any], pack: Pack) -> Values:
    if all(isinstance(cell, bool | int | float) for cell in cells):
        return {"name": name, **_numbers([float(cell) for cell in cells], cells, pack)}
    words = [_word(cell) for cell in cells]
    if len(set(words)) == 1:
        return {"name": name, "text": words[0]}
    known = list(dict.fromkeys(words))
    places = {word: place for place, word in enumerate(known)}
    return {"name": name, "words": known, "at": pack.integers(np.array([places[w] for w in words]))}


def _numbers(values: list[float], cells: list[Any], pack: Pack) -> Values:
    numbers = np.array(values)
    good = np.isfinite(numbers)
    if not good.any():
        return {"text": _word(cells[0])}
    value: Values = {}
    if not good.all():
        value["gaps"] = np.flatnonzero(~good).tolist()
        numbers = np.where(good, numbers, numbers[good][0])
    low, high = float(numbers.min()), float(numbers.max())
    if low == high:
        return {**value, "number": low}
    are_whole = all(isinstance(cell, int) for cell in cells) and high - low < _WHOLE
    step = 1.0 if are_whole else (high - low) / _STEPS
    if not math.isfinite(step) or step <= 0.0:
        return {"text": "beyond all measure"}
    return {
        **value,
        "low": low,
        "step": step,
        "at": pack.integers(np.rint((numbers - low) / step)),
    }


def _word(cell: Any) -> str:
    if cell is None:
        return ""
    text = str(cell)
    rest = len(text) - _MOST_CHARACTERS
    return text if rest <= 0 else f"{text[:_MOST_CHARACTERS]}… (and {rest} characters)"
