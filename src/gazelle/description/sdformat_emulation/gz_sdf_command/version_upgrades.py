"""Documents of older SDF versions rewritten to a release's version, rule by rule.

``upgrades.txt`` holds the rules of each step, nested as the elements they apply to; ``//name``
means every descendant of that name. Rules of inner elements come first. A place is ``a/b@c``:
attribute ``c`` of element ``b`` in ``a``.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Console

__all__ = ["upgrade"]

_FLATTENED = frozenset({"frame", "joint", "link", "model", "gripper"})


def upgrade(root: SdfElement, version: tuple[int, int], console: Console) -> bool:
    """Rewrite a document in place to a version and say so in its attribute ``version``.

    Args:
        root: ``<sdf version="…">``.
        version: the one wanted.
        console: hears of deprecated elements and of versions without a way there.

    Returns:
        False when there is no way from the document's version; it is read as it is then.
    """
    wanted = "{}.{}".format(*version)
    current = original = root.attributes["version"]
    root.attributes["version"] = wanted
    while current != wanted:
        step = _steps().get(current)
        if step is None:
            break
        current, rules = step
        _apply(root, rules, console)
    if current != wanted:
        console.error("convert", f"Unable to convert from SDF version {original} to {wanted}")
    return current == wanted


def _unflatten(model: SdfElement) -> None:
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
                _unflatten(element)
                break
            continue
        nested = SdfElement("model", {"name": prefix}, line=element.line)
        if _move_parts(model, nested, len(prefix) + 2, skip=made):
            _unflatten(nested)
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


@dataclass(slots=True)
class _Rules:
    """What is done to one element: `inner` first, then `actions` in order."""

    inner: list[tuple[str, _Rules]] = field(default_factory=list)
    actions: list[tuple[str, ...]] = field(default_factory=list)


@cache
def _steps() -> dict[str, tuple[str, _Rules]]:
    text = (files(__package__) / "upgrades.txt").read_text(encoding="utf-8")
    steps: dict[str, tuple[str, _Rules]] = {}
    for block in text.split("== ")[1:]:
        title, *lines = block.splitlines()
        old, new = title.split()
        steps[old] = (new, _rules_in(lines))
    return steps


def _rules_in(lines: list[str]) -> _Rules:
    open_rules = [_Rules()]
    for line in lines:
        depth = len(line) - len(line.lstrip(" "))
        del open_rules[depth + 1 :]
        token = line.strip()
        if token.startswith(":"):
            open_rules[-1].actions.append(tuple(token[1:].split(" ")))
        else:
            rules = _Rules()
            open_rules[-1].inner.append((token, rules))
            open_rules.append(rules)
    return open_rules[0]


def _apply(element: SdfElement, rules: _Rules, console: Console) -> None:
    for action in rules.actions:
        if action[0] == "deprecated":
            _warn_of_deprecated(element, action[1], console)
    for name, inner in rules.inner:
        if name.startswith("//"):
            _apply_below(element, name[2:], inner, console)
        else:
            for child in element.find_all(name):
                _apply(child, inner, console)
    for action in rules.actions:
        _act(element, *action)


def _apply_below(element: SdfElement, name: str, rules: _Rules, console: Console) -> None:
    # What is inside plug-ins and elements of other namespaces is the user's own.
    if element.name == "plugin" or ":" in element.name:
        return
    for child in element.children:
        if child.name == name:
            _apply(child, rules, console)
        _apply_below(child, name, rules, console)


def _act(element: SdfElement, action: str, *tokens: str) -> None:
    if action == "rename":
        _rename(element, tokens[0], tokens[1])
    elif action in ("move", "copy"):
        _move(element, tokens[0], tokens[1], keeps=action == "copy")
    elif action == "map":
        _map(element, *tokens)
    elif action == "add":
        element.add(tokens[0], " ".join(tokens[1:]))
    elif action == "remove":
        element.children[:] = [child for child in element.children if child.name != tokens[0]]
    elif action == "remove_empty":
        name = tokens[0].removeprefix("@")
        if element.attributes.get(name) == "":
            del element.attributes[name]
    elif action == "unflatten":
        _unflatten(element)


def _rename(element: SdfElement, source: str, target: str) -> None:
    name, _, attribute = source.partition("@")
    child = element.find(name) if name else element
    if child is None:
        return
    value = child.attributes.get(attribute) if attribute else child.text or None
    if value is None:
        return
    renamed = SdfElement(target, text=value, line=child.line)
    if name:
        element.children[:] = [renamed if one is child else one for one in element.children]
    else:
        del element.attributes[attribute]
        element.children.append(renamed)


def _move(element: SdfElement, source: str, target: str, *, keeps: bool) -> None:
    path, _, attribute = source.partition("@")
    holder = _descend(element, path.split("/")[:-1]) if path else element
    if holder is None:
        return
    to_path, _, to_attribute = target.partition("@")
    names = to_path.split("/") if to_path else []
    receiver = _descend(element, names if to_attribute else names[:-1], makes=True)
    assert receiver is not None
    if attribute:
        if attribute in holder.attributes:
            value = holder.attributes.pop(attribute)
            receiver.attributes[to_attribute] = value
        return
    moved = holder.find(path.split("/")[-1])
    if moved is None:
        return
    if to_attribute:
        if not moved.text:
            return
        receiver.attributes[to_attribute] = moved.text
    else:
        clone = copy.deepcopy(moved)
        clone.name = names[-1]
        receiver.children.append(clone)
    if not keeps:
        holder.children[:] = [child for child in holder.children if child is not moved]


def _map(element: SdfElement, source: str, values: str, target: str, results: str) -> None:
    found = element.find(source)
    tokens, meanings = values.split(","), results.split(",")
    if found is None or found.text not in tokens:
        return
    # The last result counts for all values behind it.
    meaning = meanings[min(tokens.index(found.text), len(meanings) - 1)]
    *names, last = target.split("/")
    receiver = _descend(element, names, makes=True)
    if receiver is not None:
        receiver.attributes[last.removeprefix("@")] = meaning


def _descend(element: SdfElement, names: list[str], *, makes: bool = False) -> SdfElement | None:
    """Return the element at the end of a path, made where it is missing if `makes`."""
    for name in names:
        child = element.find(name)
        if child is None:
            if not makes:
                return None
            child = element.add(name)
        element = child
    return element


def _warn_of_deprecated(element: SdfElement, path: str, console: Console) -> None:
    text = ""
    found = element
    for depth, name in enumerate(path.split("/")):
        child = found.find(name)
        if child is not None:
            text += (">\n" if text else "") + "  " * depth + f"<{name}"
            found = child
        elif name in found.attributes:
            text += f" {name}='{found.attributes[name]}'"
            break
    console.warn("deprecated", f"Deprecated SDF Values in original file:\n{text}\n")
