"""What a camera sees behind everything."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Scene

__all__ = ["background_colours"]

_SKY = (
    # sine of the elevation; red, green, blue in 0…255
    (-1.000, (150, 150, 135)),
    (-0.200, (170, 170, 155)),
    (-0.127, (180, 182, 169)),
    (-0.095, (186, 191, 185)),
    (-0.064, (189, 196, 199)),
    (0.000, (189, 199, 217)),
    (0.062, (182, 195, 223)),
    (0.125, (173, 188, 224)),
    (0.185, (163, 179, 222)),
    (0.244, (153, 169, 217)),
    (0.300, (143, 160, 212)),
    (0.354, (135, 152, 207)),
    (0.600, (105, 122, 190)),
    (1.000, (78, 96, 172)),
)
_SKY_ROWS = 257


def background_colours(scene: Scene) -> NDArray[np.float32]:
    """Return the background from straight down to straight up, (rows, 3) float32 in 0…1.

    Rows are equal steps of the sine of the elevation. Without a sky there is one row: the
    scene's background colour. The sky is cloudless, in the mean colours over all azimuths that
    recorded pictures of Gazebo Classic's default sky show.
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
