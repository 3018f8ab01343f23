"""The keys by which hector's plug-ins describe their errors."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.parameters import Parameter
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader

if TYPE_CHECKING:
    from gazelle.sensors import DriftModel

__all__ = ["ErrorSource", "error_parameters", "read_model"]

Array = NDArray[np.float64]
_PER_HOUR = 1.0 / 3600.0


def error_parameters(
    unit: str, *, axes: int = 3, prefix: str = "", aside: str = ""
) -> tuple[Parameter, ...]:
    """Return the rows of a table: ``offset``, ``drift`` … or ``velocityOffset`` … with a prefix.

    Args:
        unit: of what is measured.
        axes: 3 for vectors, 1 for a number.
        prefix: before the names.
        aside: added to the meanings.
    """

    def row(name: str, default: float, meaning: str, unit: str) -> Parameter:
        key = prefix + name[0].upper() + name[1:] if prefix else name
        if axes == 1:
            return Parameter(key, "number", default, meaning + aside, unit)
        return Parameter(key, "vector", (default,) * 3, meaning + aside, unit)

    return (
        row("offset", 0.0, "constant error", unit),
        row("drift", 0.0, "sigma of the slowly moving error", unit),
        row("driftFrequency", _PER_HOUR, "how fast it moves", "Hz"),
        row("gaussianNoise", 0.0, "sigma of the white noise", unit),
        row("scaleError", 1.0, "factor on the true value", ""),
    )


def read_model(
    parameters: PluginReader, *, axes: int = 3, prefix: str = "", gaussian_noise: float = 0.0
) -> DriftModel:
    """Read the keys of `error_parameters`; a `gaussian_noise` other than 0 replaces theirs."""
    from gazelle.sensors import DriftModel

    def values(name: str) -> tuple[float, ...]:
        key = prefix + name[0].upper() + name[1:] if prefix else name
        return (parameters.number(key),) if axes == 1 else parameters.vector(key)

    return DriftModel(
        offset=values("offset"),
        drift=values("drift"),
        gaussian_noise=(gaussian_noise,) * axes if gaussian_noise else values("gaussianNoise"),
        drift_frequency_hz=values("driftFrequency"),
        scale_error=values("scaleError"),
    )


class ErrorSource:
    """Adds the errors of one quantity; a reset of the world starts them over."""

    def __init__(self, context: PluginContext, model: DriftModel, name: str) -> None:
        """Seed from the world's seed and the names of model, plug-in and quantity."""
        self._engine, self._seed, self._model = context.host.engine, context.host.seed, model
        self._name = f"{context.model.name}::{context.plugin.name}/{name}"
        self._last_ns = self._engine.time_ns
        self._restart()
        context.resources.on_reset(self._restart)

    @property
    def drift(self) -> Array:
        """The slowly moving error as it is now, (axes,), in the quantity's unit; can be set."""
        return self._noise.drift

    @drift.setter
    def drift(self, value: Array) -> None:
        self._noise.drift = value

    @property
    def bias(self) -> Array:
        """Drift and offset together, (axes,), in the quantity's unit."""
        return np.add(self._noise.drift, self._model.offset)

    def apply(self, values: Array, velocity_error: Array | None = None) -> Array:
        """Return (N,) values with errors.

        Args:
            values: true values.
            velocity_error: moves the drift on from here, per second since the last call.
        """
        dt_s = (self._engine.time_ns - self._last_ns) * 1e-9
        self._last_ns = self._engine.time_ns
        noisy = self._noise.apply(values, dt_s=dt_s)
        if velocity_error is not None:
            self._noise.drift = self._noise.drift + dt_s * velocity_error
        return noisy

    def _restart(self) -> None:
        from gazelle.sensors import noise_stream

        self._noise = noise_stream(self._model, self._seed, self._name)
        self._last_ns = self._engine.time_ns
