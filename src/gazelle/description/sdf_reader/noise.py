"""SDF ``<noise>`` in the syntax of 1.5 and later, and the IMU's of 1.4."""

from __future__ import annotations

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_float
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean
from gazelle.noise import NOISE_TYPES, Noise

__all__ = ["read_axis_noises", "read_noise", "read_noise_of"]

Noise3 = tuple[Noise, Noise, Noise]
_AXES = ("x", "y", "z")


def read_noise(tag: Tag | None, context: ReadContext) -> Noise:
    """Return the noise of a ``<noise>`` element; none when it is absent.

    The type stands in an attribute (1.5 and later) or in a child (cameras, lidars and 1.4).
    """
    if tag is None:
        return Noise()
    kind = (tag.attributes.get("type") or tag.text_of("type", default="none")).strip()
    if kind not in NOISE_TYPES:
        message = f"noise type '{kind}' is not known; there is no noise here"
        fix = did_you_mean(kind, NOISE_TYPES) or "write one of: " + ", ".join(NOISE_TYPES)
        context.diagnostics.report("sdf.bad-value", message, tag.span, fix=fix)
        return Noise(span=tag.span)
    return Noise(
        type=kind,
        mean=child_float(tag, "mean", 0.0, context),
        stddev=_not_negative(tag, "stddev", context),
        bias_mean=child_float(tag, "bias_mean", 0.0, context),
        bias_stddev=_not_negative(tag, "bias_stddev", context),
        dynamic_bias_stddev=_not_negative(tag, "dynamic_bias_stddev", context),
        dynamic_bias_correlation_time_s=_not_negative(
            tag, "dynamic_bias_correlation_time", context
        ),
        precision=child_float(tag, "precision", 0.0, context),
        span=tag.span,
    )


def read_noise_of(tag: Tag | None, *path: str, context: ReadContext) -> Noise:
    """Return the noise of the ``<noise>`` reached by these child names."""
    return read_noise(tag.find(*path, "noise") if tag is not None else None, context)


def read_axis_noises(tag: Tag | None, context: ReadContext) -> Noise3:
    """Return the noises of the x, y and z children, such as those of ``<angular_velocity>``."""
    x, y, z = (read_noise_of(tag, axis, context=context) for axis in _AXES)
    return x, y, z


def _not_negative(tag: Tag, name: str, context: ReadContext) -> float:
    value = child_float(tag, name, 0.0, context)
    if value < 0.0:
        found = tag.find(name) or tag
        message = f"<{name}> is negative ({value:g}); {-value:g} is used"
        context.diagnostics.report("sdf.bad-value", message, found.span, fix="write it without -")
        return -value
    return value
