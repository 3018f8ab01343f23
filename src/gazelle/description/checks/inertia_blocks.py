"""Mass properties as the blocks of URDF and SDF, ready to be pasted."""

from __future__ import annotations

from gazelle.geometry import MassProperties

__all__ = ["inertial_block", "sdf_block", "urdf_block"]

_WORDS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def urdf_block(body: MassProperties) -> str:
    """Return URDF's ``<inertial>``; the tensor's axes are those of the link."""
    moments = " ".join(
        f'{word}="{_shown(value)}"' for word, value in zip(_WORDS, body.inertia_kg_m2, strict=True)
    )
    return (
        "<inertial>\n"
        f'  <origin xyz="{_point(body)}" rpy="0 0 0"/>\n'
        f'  <mass value="{_shown(body.mass_kg)}"/>\n'
        f"  <inertia {moments}/>\n"
        "</inertial>"
    )


def sdf_block(body: MassProperties) -> str:
    """Return SDF's ``<inertial>``; the tensor's axes are those of the link."""
    moments = "\n".join(
        f"    <{word}>{_shown(value)}</{word}>"
        for word, value in zip(_WORDS, body.inertia_kg_m2, strict=True)
    )
    return (
        "<inertial>\n"
        f"  <pose>{_point(body)} 0 0 0</pose>\n"
        f"  <mass>{_shown(body.mass_kg)}</mass>\n"
        f"  <inertia>\n{moments}\n  </inertia>\n"
        "</inertial>"
    )


def inertial_block(body: MassProperties, source_format: str) -> str:
    """Return the block of ``urdf`` or ``sdf``."""
    return urdf_block(body) if source_format == "urdf" else sdf_block(body)


def _point(body: MassProperties) -> str:
    return " ".join(_shown(value) for value in body.center_m)


def _shown(value: float) -> str:
    """Nine digits: with fewer, a thin plate's tensor can break the triangle inequality."""
    return f"{value:.9g}" if abs(value) > 1e-15 else "0"
