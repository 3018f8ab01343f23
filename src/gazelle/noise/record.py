"""What SDF says of a noise."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.diagnostics import SourceSpan

__all__ = ["NO_NOISE", "Noise"]


@dataclass(frozen=True, slots=True)
class Noise:
    """SDF ``<noise>``: `type` is one of `gazelle.noise.NOISE_TYPES`."""

    type: str = "none"
    mean: float = 0.0
    stddev: float = 0.0
    bias_mean: float = 0.0
    bias_stddev: float = 0.0
    dynamic_bias_stddev: float = 0.0
    dynamic_bias_correlation_time_s: float = 0.0
    precision: float = 0.0
    span: SourceSpan | None = None


NO_NOISE = Noise()
