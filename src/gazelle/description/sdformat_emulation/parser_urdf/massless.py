"""What sdformat 14 says of a link without mass, which it leaves out with all that hangs on it."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.robot import Joint, Link

__all__ = ["warn_of_massless"]

# sdformat's LINK_INERTIA_INVALID.
_CODE = 19
_PAGE = "http://sdformat.org/tutorials?tut=sdformat_urdf_extensions"


def warn_of_massless(link: Link, is_without_inertial: bool, console: Console) -> None:
    """Add the warnings about a link.

    Args:
        link: the one left out.
        is_without_inertial: it has no ``<inertial>`` at all, not one without mass.
        console: receives them.
    """
    lack = (
        "no <inertial> block defined"
        if is_without_inertial
        else "a mass value of less than or equal to zero"
    )
    said = [
        f"urdf2sdf: link[{link.name}] has {lack}. Please ensure this link has a valid mass to "
        "prevent any missing links or joints in the resulting SDF model."
    ]
    above = link.joint_above
    if above is not None:
        said += [_lumping_helps("parent", above)] if above.kind == "fixed" else []
        said.append(f"urdf2sdf: parent joint[{above.name}] ignored.")
    below = [one.joint_above for one in link.children if one.joint_above is not None]
    if below:
        said += [_lumping_helps("child", one) for one in below if one.kind == "fixed"]
        said.append(f"urdf2sdf: [{len(below)}] child joints ignored.")
        said.append(f"urdf2sdf: [{len(below)}] child links ignored.")
    console.warning("massless", "\n".join(map(_coded, said)))
    console.warning("left out", _coded(f"urdf2sdf: link[{link.name}] is not modeled in sdf."))


def _lumping_helps(which: str, joint: Joint) -> str:
    return (
        "urdf2sdf: allowing joint lumping by removing any <disableFixedJointLumping> or "
        f"<preserveFixedJoint> gazebo tag on fixed {which} joint[{joint.name}], as well as "
        "ensuring that ParserConfig::URDFPreserveFixedJoint is false, could help resolve this "
        f"warning. See {_PAGE} for more information about this behavior."
    )


def _coded(text: str) -> str:
    return f"Error Code {_CODE}: Msg: {text}"
