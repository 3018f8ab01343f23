"""The error model of hector_gazebo_plugins' sensors: scale, offset, drift and noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

__all__ = ["DriftModel", "DriftNoise"]

Array = NDArray[np.float64]
_HOUR_S = 3600.0


@dataclass(frozen=True, slots=True)
class DriftModel:
    """Parameters, one value per axis, in the unit of what is measured.

    Attributes:
        offset: constant error.
        drift: sigma of the slowly moving error.
        drift_frequency_hz: how fast it moves; the default is one over an hour.
        gaussian_noise: sigma of the white noise.
        scale_error: factor on the true value.
    """

    type: ClassVar[str] = "hector_drift"

    offset: tuple[float, ...]
    drift: tuple[float, ...]
    gaussian_noise: tuple[float, ...]
    drift_frequency_hz: tuple[float, ...] = (1.0 / _HOUR_S,) * 3
    scale_error: tuple[float, ...] = (1.0, 1.0, 1.0)

    @property
    def variances(self) -> Array:
        """Drift and noise together, squared, (N,) by axis, as hector's covariances have them."""
        return np.square(self.drift) + np.square(self.gaussian_noise)


class DriftNoise:
    """``scale · value + offset + drift + N(0, noise)``.

    Over dt the drift becomes ``exp(-dt f) · drift + dt · N(0, sqrt(2 f) σ)``; it begins as
    N(0, σ). Source: hector_gazebo_plugins, sensor_model.h.

    Attributes:
        model: its parameters.
        drift: the present drift, (N,).
    """

    is_silent = False

    def __init__(self, model: DriftModel, random: np.random.Generator) -> None:
        """Draw the first drift."""
        self.model = model
        self._random = random
        self.drift: Array = self._random.standard_normal(len(model.drift)) * np.array(model.drift)

    def apply(self, values: Array, *, dt_s: float = 0.0) -> Array:
        """Return the (N,) values with error; `dt_s` is the time since the last call."""
        model, count = self.model, len(self.drift)
        frequency = np.array(model.drift_frequency_hz[:count])
        step = self._random.standard_normal(count) * np.sqrt(2 * frequency) * np.array(model.drift)
        self.drift = np.exp(-dt_s * frequency) * self.drift + dt_s * step
        white = self._random.standard_normal(count) * np.array(model.gaussian_noise)
        scale = np.array(model.scale_error[:count])
        return np.asarray(values * scale + np.array(model.offset) + self.drift + white)
