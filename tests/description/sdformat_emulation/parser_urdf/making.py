"""Small robot descriptions for the tests of the conversion."""

from __future__ import annotations

from gazelle.description.sdformat_emulation import Release, SdfElement
from gazelle.description.sdformat_emulation.parser_urdf import urdf_to_sdf
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics

__all__ = ["BOX", "converted", "joint", "link", "remarks_of", "robot"]

BOX = '<geometry><box size="0.1 0.2 0.3"/></geometry>'
_TENSOR = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'


def link(name: str, inside: str = "", mass: str | None = "1") -> str:
    """Return a link; `mass` in kg, None for one without ``<inertial>``."""
    inertial = f'<inertial><mass value="{mass}"/>{_TENSOR}</inertial>' if mass is not None else ""
    return f'<link name="{name}">{inertial}{inside}</link>'


def joint(kind: str, parent: str, child: str, inside: str = "") -> str:
    """Return a joint called PARENT_CHILD."""
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    limit = '<limit effort="1" velocity="2"/>' if kind in ("revolute", "prismatic") else ""
    return f'<joint name="{parent}_{child}" type="{kind}">{ends}{inside or limit}</joint>'


def robot(*parts: str) -> Tag:
    """Return a ``<robot>`` with these parts."""
    root = parse_xml(f'<robot name="r">{"".join(parts)}</robot>', "r.urdf", Diagnostics())
    assert root is not None
    return root


def converted(*parts: str, release: Release = Release.V12) -> SdfElement:
    """Return the model that a robot of these parts becomes."""
    sdf = urdf_to_sdf(robot(*parts), release=release)
    assert sdf is not None
    assert (sdf.name, sdf.attributes) == ("sdf", {"version": "1.7"})
    return sdf.children[0]


def remarks_of(*parts: str, release: Release = Release.V12) -> list[str]:
    """Return what the library says about a robot of these parts."""
    remarks: list[str] = []
    urdf_to_sdf(robot(*parts), release=release, remarks=remarks)
    return remarks
