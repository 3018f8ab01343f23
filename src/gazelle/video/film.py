"""Drawing recordings: frames at exact simulated times, into films and pictures."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics
from gazelle.recording import Recording
from gazelle.sensors.camera import render
from gazelle.sensors.film_files import open_film
from gazelle.sensors.ray_scene import RayScene
from gazelle.sensors.view_image import lit_world
from gazelle.video.cameras import AutomaticCamera, Camera, PlacedCamera
from gazelle.video.ground_grid import GroundGrid, grid_step_m

__all__ = ["Shooting", "film_frames", "write_picture", "write_video"]

_SIZE_PX = (640, 400)
_RATE_HZ = 25.0
_MIN_PX, _MAX_PX = 16, 8192


@dataclass(frozen=True, slots=True)
class Shooting:
    """How a film is made of a recording.

    Attributes:
        size_px: width and height.
        fps: frames per second of the film.
        speed: simulated seconds per second of the film.
        start_s: how much of the recording is left out at its start, simulated.
        duration_s: how much of it is shown, simulated; None for all.
    """

    size_px: tuple[int, int] = _SIZE_PX
    fps: float = _RATE_HZ
    speed: float = 1.0
    start_s: float = 0.0
    duration_s: float | None = None

    def times_ns(self, recording: Recording) -> tuple[int, ...]:
        """Return the simulated time of each frame, one at least.

        Raises:
            ValueError: a number is out of range.
        """
        width, height = self.size_px
        if min(width, height) < _MIN_PX or max(width, height) > _MAX_PX:
            raise ValueError(
                f"a film of {width}x{height} pixels is not possible: {_MIN_PX} to {_MAX_PX} do"
            )
        for name, value in (("fps", self.fps), ("speed", self.speed)):
            if not 0.0 < value < math.inf:
                raise ValueError(f"{name} must be a number above 0, not {value:g}")
        first = recording.start_ns + round(self.start_s * 1e9)
        last = recording.end_ns
        if self.duration_s is not None:
            last = min(last, first + round(self.duration_s * 1e9))
        if self.start_s < 0.0 or first > last:
            raise ValueError(
                f"the film is to begin {self.start_s:g} s after the recording's start, which "
                f"holds {recording.duration_s:g} s"
            )
        period_ns = 1e9 * self.speed / self.fps
        # The film lasts as long as what it shows: the moment at its end is the next film's.
        count = max(1, math.ceil((last - first) / period_ns - 1e-6))
        return tuple(first + round(number * period_ns) for number in range(count))


_USUAL = Shooting()


def film_frames(
    recording: Recording,
    camera: Camera | None = None,
    shooting: Shooting = _USUAL,
    *,
    diagnostics: Diagnostics | None = None,
) -> Iterator[NDArray[np.uint8]]:
    """Yield the frames of a film, (H, W, 3), red, green and blue.

    Args:
        recording: what happened.
        camera: `AutomaticCamera` when None.
        shooting: size, rate, speed and part.
        diagnostics: receives what was found about meshes.

    Raises:
        EmbreeError: Embree cannot be loaded.
        NotFoundError: what the camera looks at or sits on is not there.
        ValueError: a number of `shooting` is out of range.
    """
    times_ns = shooting.times_ns(recording)
    placed = (camera or AutomaticCamera()).place(recording, shooting.size_px)
    yield from _drawn(recording, placed, times_ns, diagnostics)


def write_video(  # noqa: PLR0913 - users give all by keyword
    recording: Recording,
    path: str | os.PathLike[str],
    *,
    camera: Camera | None = None,
    size_px: tuple[int, int] = _SIZE_PX,
    fps: float = _RATE_HZ,
    speed: float = 1.0,
    start_s: float = 0.0,
    duration_s: float | None = None,
    progress: Callable[[int, int], None] = lambda _done, _of: None,
) -> Path:
    """Draw a film: animated WebP, or with the extra ``bags`` MP4 and WebM.

    Equal recordings give the same WebP, byte by byte. Ctrl-C ends the film early; what is drawn
    by then is kept.

    Args:
        recording: what happened.
        path: where to; its suffix says which.
        camera: `AutomaticCamera` when None.
        size_px: width and height.
        fps: frames per second.
        speed: simulated seconds per second of the film.
        start_s: how much is left out at the start, simulated seconds.
        duration_s: how much is shown, simulated seconds; None for all.
        progress: called with the number of frames done and of all.

    Raises:
        FilmError: there is no such kind of film, or its library is missing.
        NotFoundError: what the camera looks at or sits on is not there.
        ValueError: a number is out of range.
    """
    shooting = Shooting(size_px, fps, speed, start_s, duration_s)
    count = len(shooting.times_ns(recording))
    target = Path(path)
    with open_film(target, size_px, fps) as film:
        progress(0, count)
        for frame in film_frames(recording, camera, shooting):
            film.add(frame)
            progress(film.count, count)
    return target


def write_picture(
    recording: Recording,
    path: str | os.PathLike[str],
    *,
    time_s: float | None = None,
    camera: Camera | None = None,
    size_px: tuple[int, int] = (800, 500),
) -> Path:
    """Draw one moment into a PNG or WebP file, or whatever else Pillow writes.

    Args:
        recording: what happened.
        path: where to.
        time_s: simulated seconds since the recording's start; its end when None.
        camera: `AutomaticCamera` when None.
        size_px: width and height.

    Raises:
        NotFoundError: what the camera looks at or sits on is not there.
        ValueError: Pillow does not write such files.
    """
    from PIL import Image

    end_ns, start_ns = recording.end_ns, recording.start_ns
    time_ns = end_ns if time_s is None else start_ns + round(time_s * 1e9)
    placed = (camera or AutomaticCamera()).place(recording, size_px)
    (frame,) = _drawn(recording, placed, (time_ns,), None)
    target = Path(path)
    Image.fromarray(frame).save(target)
    return target


def _drawn(
    recording: Recording,
    camera: PlacedCamera,
    times_ns: tuple[int, ...],
    diagnostics: Diagnostics | None,
) -> Iterator[NDArray[np.uint8]]:
    found = Diagnostics() if diagnostics is None else diagnostics
    stretch, scene = None, None
    grid = GroundGrid(camera.spec, grid_step_m(camera.distance_m))
    for time_ns in times_ns:
        now = recording.stretch_at(time_ns)
        if scene is None:
            scene = RayScene(lit_world(now.world), diagnostics=found)
        elif now is not stretch:
            scene.rebuild(lit_world(now.world))
        stretch = now
        scene.update(now.moment(time_ns))
        pose = camera.pose_at(time_ns)
        record = render(scene, camera.spec, pose, antialias=True, want_depth=True)
        assert record.rgb is not None and record.depth_m is not None
        if now.world.scene.grid:
            grid.draw(record.rgb, record.depth_m, pose)
        yield record.rgb
