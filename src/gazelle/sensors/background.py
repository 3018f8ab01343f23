"""What a camera sees behind everything."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Scene

__all__ = ["background_colours"]

_SKY = (
    # height above the horizon as sine of the elevation; red, green, blue in 0…255
    (-1.0, (150, 148, 132)),
    (-0.14, (164, 163, 148)),
    (0.0, (184, 187, 176)),
    (0.05, (193, 200, 203)),
    (0.10, (195, 205, 222)),
    (0.17, (187, 201, 229)),
    (0.26, (172, 188, 228)),
    (0.33, (159, 176, 223)),
    (0.40, (144, 161, 215)),
    (0.70, (104, 122, 190)),
    (1.0, (82, 100, 172)),
)
_SKY_ROWS = 257


def background_colours(scene: Scene) -> NDArray[np.float32]:
    """Return the background from straight down to straight up, (rows, 3) float32 in 0…1.

    Rows are equal steps of the sine of the elevation. Without a sky there is one row: the
    scene's background colour. The sky is a clear morning's, in the colours that Gazebo Classic's
    default sky has between its clouds.
    """
    if not scene.sky:
        return np.array([scene.background[:3]], np.float32)
    heights = np.linspace(-1.0, 1.0, _SKY_ROWS)
    known = [height for height, _ in _SKY]
    channels = [
        np.interp(heights, known, [colour[channel] / 255.0 for _, colour in _SKY])
        for channel in range(3)
    ]
    return np.ascontiguousarray(np.stack(channels, axis=1), np.float32)
