"""Robot descriptions for C++: judged as urdfdom judges them, and read into elements."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb
from gazelle.description.urdfdom_emulation.model import urdfdom_verdict
from gazelle.description.urdfdom_emulation.tinyxml import Element, parse_tinyxml

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__ = ["read_urdf"]


@verb("description/urdf")
def read_urdf(host: HostContext, request: dict[str, Any]) -> dict[str, Any]:
    """Return the elements of ``<robot>``, or why it is none.

    Args:
        host: is not asked.
        request: the description's ``text``.
    """
    text = request["text"]
    verdict = urdfdom_verdict(text)
    if verdict.robot is None:
        problem = "\n".join(str(remark) for remark in verdict.remarks)
        return {"problem": problem or "the text is no robot description"}
    robot = next(one for one in parse_tinyxml(text) if one.name == "robot")
    return {"problem": "", "robot": _row(robot)}


def _row(element: Element) -> dict[str, Any]:
    return {
        "name": element.name,
        "attributes": element.attributes,
        "children": [_row(child) for child in element.children],
    }
