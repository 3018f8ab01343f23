"""Names such as ``arm::hand`` of SDF 1.7 made into models nested in models, as 1.8 wants them."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.element import SdfElement

__all__ = ["unflatten"]

_FLATTENED = frozenset({"frame", "joint", "link", "model", "gripper"})


def unflatten(model: SdfElement) -> None:
    """Move the parts of a model that bear another model's name before ``::`` into a model of it.

    Nested models come behind everything else. As in sdformat, the search stops at a nested model
    that stands in the document already.
    """
    made: list[SdfElement] = []
    pending = list(model.children)
    while pending:
        element = pending.pop(0)
        name = element.attributes.get("name", "")
        if element.name not in _FLATTENED or not name:
            continue
        prefix, found, _ = name.partition("::")
        if not found:
            if element.name == "model":
                unflatten(element)
                break
            continue
        nested = SdfElement("model", {"name": prefix}, line=element.line)
        if _move_parts(model, nested, len(prefix) + 2, skip=made):
            unflatten(nested)
            model.children.append(nested)
            made.append(nested)
            pending = [child for child in model.children if not _is_one_of(child, made)]


def _move_parts(model: SdfElement, nested: SdfElement, cut: int, *, skip: list[SdfElement]) -> bool:
    prefix = nested.attributes["name"]
    moved = False
    for element in [child for child in model.children if not _is_one_of(child, skip)]:
        name = element.attributes.get("name", "")
        belongs = bool(name) and name.startswith(prefix) and element.name in _FLATTENED
        if not belongs and element.name != "gripper":
            continue
        if name.startswith(prefix):
            element.attributes["name"] = name = name[cut:]
        if element.name == "gripper" and not _strip_gripper(element, prefix, cut):
            continue
        _strip(element.find("pose"), "relative_to", prefix, cut)
        model.children[:] = [child for child in model.children if child is not element]
        nested.children.append(element)
        moved = True
        if element.name == "frame":
            _strip(element, "attached_to", prefix, cut)
            if name == "__model__" and "attached_to" in element.attributes:
                _become_model_frame(element, nested)
        elif element.name == "link":
            for part in element.children:
                _strip_poses(part, prefix, cut)
        elif element.name == "joint":
            _strip_joint(element, prefix, cut)
    return moved


def _become_model_frame(frame: SdfElement, nested: SdfElement) -> None:
    """Say by attribute and pose of the model what its flattened frame ``__model__`` said."""
    nested.attributes["canonical_link"] = frame.attributes["attached_to"]
    nested.children.pop()
    pose = frame.find("pose")
    if pose is not None:
        nested.children.append(pose)


def _strip_joint(joint: SdfElement, prefix: str, cut: int) -> None:
    for part in joint.children:
        if part.name in ("parent", "child") and part.text.startswith(prefix):
            part.text = part.text[cut:]
        elif part.name in ("axis", "axis2"):
            _strip(part.find("xyz"), "expressed_in", prefix, cut)
        elif part.name == "sensor":
            _strip_poses(part, prefix, cut)


def _strip_poses(part: SdfElement, prefix: str, cut: int) -> None:
    _strip(part.find("pose"), "relative_to", prefix, cut)
    camera = part.find("camera")
    if camera is not None:
        _strip_poses(camera, prefix, cut)


def _strip_gripper(gripper: SdfElement, prefix: str, cut: int) -> bool:
    fingers = gripper.find_all("gripper_link")
    for finger in fingers:
        if finger.text and not finger.text.startswith(prefix):
            return False
        finger.text = finger.text[cut:]
    palm = gripper.find("palm_link")
    if palm is not None and palm.text.startswith(prefix):
        palm.text = palm.text[cut:]
    return True


def _strip(element: SdfElement | None, attribute: str, prefix: str, cut: int) -> None:
    if element is not None and element.attributes.get(attribute, "").startswith(prefix):
        element.attributes[attribute] = element.attributes[attribute][cut:]


def _is_one_of(element: SdfElement, elements: list[SdfElement]) -> bool:
    # Elements compare by content; two equal links are still two.
    return any(element is one for one in elements)
