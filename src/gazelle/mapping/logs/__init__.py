"""Logs of robots as files: CARMEN's, and numpy archives; trajectories out."""

from __future__ import annotations

from gazelle.mapping.logs.carmen import read_carmen
from gazelle.mapping.logs.log_formats import LogRecord, read_log
from gazelle.mapping.logs.log_record import duration_s, stamp_problem
from gazelle.mapping.logs.numpy_archive import read_archive
from gazelle.mapping.logs.trajectory_files import write_carmen, write_tum

__all__ = [
    "LogRecord",
    "duration_s",
    "read_archive",
    "read_carmen",
    "read_log",
    "stamp_problem",
    "write_carmen",
    "write_tum",
]
