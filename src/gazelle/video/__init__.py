"""Films and pictures of recordings, drawn by the ray tracer: the same for the same recording.

Example:
    >>> from gazelle.recording import record
    >>> from gazelle.video import FollowCamera, write_video
    >>> with record(sim) as recorder:
    ...     sim.run(seconds=10)
    >>> write_video(recorder.recording, "drive.webp", camera=FollowCamera())
"""

from __future__ import annotations

from gazelle.sensors.film_files import FILM_SUFFIXES, FilmError
from gazelle.video.cameras import (
    AutomaticCamera,
    Camera,
    FixedCamera,
    FollowCamera,
    SensorCamera,
)
from gazelle.video.film import Shooting, film_frames, write_picture, write_video

__all__ = [
    "FILM_SUFFIXES",
    "AutomaticCamera",
    "Camera",
    "FilmError",
    "FixedCamera",
    "FollowCamera",
    "SensorCamera",
    "Shooting",
    "film_frames",
    "write_picture",
    "write_video",
]
