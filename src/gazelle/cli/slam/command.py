"""The command line of ``gazelle slam``."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import Progress

from gazelle.bag import BagError
from gazelle.cli.slam.bag_log import read_bag_log
from gazelle.diagnostics import Diagnostics, SourceSpan, render
from gazelle.mapping.grids import write_map
from gazelle.mapping.logs import (
    LogRecord,
    duration_s,
    read_log,
    stamp_problem,
    write_carmen,
    write_tum,
)
from gazelle.mapping.logs.log_formats import is_carmen
from gazelle.mapping.relative_pose_error import align, read_relations, relation_errors
from gazelle.mapping.slam import Slam, SlamResult

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Map a log.

    Returns:
        0 when a map was written, 1 when the log holds nothing to map.
    """
    options = _parser().parse_args(argv)
    console = Console(stderr=True)
    diagnostics = Diagnostics()
    try:
        records = list(_records(options, diagnostics))
    except (BagError, OSError) as error:
        message = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        span = SourceSpan(options.file)
        fix = "look whether the file is there, whole and yours to read; copy it again"
        text = f"it cannot be read: {message}"
        diagnostics.report("mapping.log-unreadable", text, span, fix=fix)
        records = []
    if not records and not diagnostics.errors:
        diagnostics.report(
            "mapping.no-scans", "no scan could be placed by odometry", SourceSpan(options.file)
        )
    if diagnostics.errors:
        render(diagnostics)
        return 1
    if problem := stamp_problem([record.scan.stamp_ns for record in records]):
        diagnostics.report("mapping.stamps", problem, SourceSpan(options.file))
    engine, took_s = _mapped(records, console)
    result = engine.result(options.resolution)
    _write(options, records, result)
    _tell(records, result, took_s)
    if options.relations:
        _judge(Path(options.relations), result, diagnostics)
    render(diagnostics)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle slam",
        description="Make a map and a trajectory of a log: a bag, a CARMEN log, a numpy archive.",
    )
    parser.add_argument("file", help="the log")
    parser.add_argument("-o", "--output", default="map", help="stem of what is written (map)")
    parser.add_argument("--resolution", type=_positive, default=0.05, help="side of a cell, m")
    parser.add_argument("--relations", default="", help="known relations, to measure the error")
    parser.add_argument("--scan", default="", help="topic of the scans of a bag")
    parser.add_argument("--odom-frame", default="odom", help="odometry's frame in a bag (odom)")
    parser.add_argument("--base-frame", default="", help="the robot's frame in a bag")
    parser.add_argument(
        "--carmen", action="store_true", help="write the log anew with the mapped poses, too"
    )
    return parser


def _positive(word: str) -> float:
    value = float(word)
    if not 0 < value < 10:
        raise argparse.ArgumentTypeError(f"{word} is no side of a cell, metres")
    return value


def _records(options: argparse.Namespace, diagnostics: Diagnostics) -> Iterator[LogRecord]:
    path = Path(options.file)
    if path.is_dir() or not (path.suffix == ".npz" or is_carmen(path)):
        return read_bag_log(
            path, diagnostics,
            topic=options.scan, odom=options.odom_frame, base=options.base_frame,
        )  # fmt: skip
    return read_log(path, diagnostics)


def _mapped(records: list[LogRecord], console: Console) -> tuple[Slam, float]:
    engine, start_s = Slam(), time.perf_counter()
    with Progress(console=console, transient=True) as progress:
        task = progress.add_task("mapping", total=len(records))
        for record in records:
            engine.add(*record)
            progress.advance(task)
        progress.update(task, description="matching all scans once more")
        engine.finish()
    return engine, time.perf_counter() - start_s


def _write(options: argparse.Namespace, records: list[LogRecord], result: SlamResult) -> None:
    written = [str(path) for path in write_map(result.grid, options.output)]
    path = Path(f"{options.output}.tum")
    write_tum(path, result.stamps_ns, result.trajectory)
    written.append(str(path))
    if options.carmen:
        path = Path(f"{options.output}.log")
        write_carmen(path, records, result.trajectory)
        written.append(str(path))
    print(f"wrote {', '.join(written)}")


def _tell(records: list[LogRecord], result: SlamResult, took_s: float) -> None:
    stamps = result.stamps_ns
    lasted_s = duration_s(stamps.tolist())
    steps = np.diff(result.trajectory[:, :2], axis=0)
    way_m = float(np.hypot(steps[:, 0], steps[:, 1]).sum())
    speed = f", {lasted_s / took_s:.0f} times real time" if lasted_s > 0 else ""
    print(
        f"{len(records)} scans, {way_m:.0f} m driven, {result.loops} loop closures; map of "
        f"{result.grid.width} × {result.grid.height} cells of {result.grid.resolution_m:g} m; "
        f"{took_s:.1f} s, {1e3 * took_s / len(records):.1f} ms a scan{speed}"
    )


def _judge(path: Path, result: SlamResult, diagnostics: Diagnostics) -> None:
    """Print the errors against known relations."""
    try:
        relations = read_relations(path, diagnostics)
    except OSError as error:
        span = SourceSpan(str(path))
        text = f"relations cannot be read: {error.strerror}"
        diagnostics.report("mapping.log-unreadable", text, span)
        return
    first, second, relative = align(relations, result.stamps_ns / 1e9)
    if not len(first):
        print(f"none of {len(relations.first_s)} relations has the times of two scans of this log")
        return
    errors = relation_errors(result.trajectory, first, second, relative)
    left = len(relations.first_s) - len(first)
    print(f"{errors}" + (f" ({left} relations have no scans at their times)" if left else ""))
