"""Unknown elements and attributes of an SDF document, and known ones without effect."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.known_elements import ELEMENTS
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean

__all__ = ["check_elements", "report_plugin_of"]

_ANY_ATTRIBUTE_PREFIXES = ("xmlns", "xsi:")
# Where people write plug-ins that are not loaded, why not, and what to do.
# What sdformat writes for a plug-in that has no file; Gazebo passes over it.
_NO_PLUGIN = "__default__"
_PLUGIN_PLACES = {
    "link": (
        "no Gazebo loads plug-ins of links",
        "move the <plugin> into the <model>, or into a <sensor> when it reads one",
    ),
    "visual": ("it would change what Gazebo's window shows", "nothing to do"),
}


def check_elements(root: Tag, context: ReadContext) -> None:
    """Report what SDF does not know below `root`, each name and place once.

    Args:
        root: an element that the table knows, such as ``<sdf>``, ``<model>`` or ``<sensor>``.
        context: receives ``xml.unknown-tag``, ``xml.unknown-attribute``, ``sdf.not-simulated``,
            ``sdf.plugin-not-loaded`` and ``sdf.extension``.
    """
    checker = _Checker()
    if root.name in ELEMENTS:
        checker.visit(root, root.name)
    checker.report(context)


def report_plugin_of(plugin: Tag, kind: str, context: ReadContext, again: str = "") -> None:
    """Report a plug-in of a link or visual, which no Gazebo loads or nobody here would see."""
    why, fix = _PLUGIN_PLACES[kind]
    name = plugin.attributes.get("filename", "")
    message = f"plug-in '{name}' in <{kind}> is not loaded: {why}{again}"
    context.diagnostics.report("sdf.plugin-not-loaded", message, plugin.span, fix=fix)


class _Key(NamedTuple):
    """What is wrong, with which kind of parent, and the name that is not known."""

    what: str
    kind: str
    parent: str
    name: str


class _Checker:
    """Collects by kind, parent and name, so that a hundred equal mistakes give one message."""

    def __init__(self) -> None:
        self._first: dict[_Key, Tag] = {}
        self._count: Counter[_Key] = Counter()

    def visit(self, tag: Tag, kind: str) -> None:
        """Look at an element of this kind and at everything below it."""
        element = ELEMENTS[kind]
        if element.free:
            return
        for name in tag.attributes:
            if name not in element.attributes and not name.startswith(_ANY_ATTRIBUTE_PREFIXES):
                what = "extension" if ":" in name else "unknown-attribute"
                self._note(_Key(what, kind, tag.name, name), tag)
        for child in tag.children:
            self._child(tag, kind, child)

    def _child(self, tag: Tag, kind: str, child: Tag) -> None:
        element = ELEMENTS[kind]
        if child.name in element.children:
            self.visit(child, element.children[child.name])
        elif child.name == "plugin" and _says_nothing(child, kind):
            return
        elif child.name == "plugin" and kind in _PLUGIN_PLACES:
            self._note(_Key("plugin", kind, tag.name, child.attributes.get("filename", "")), child)
        elif child.name in element.without_effect:
            self._note(_Key("not-simulated", kind, tag.name, child.name), child)
        else:
            what = "extension" if ":" in child.name else "unknown-tag"
            self._note(_Key(what, kind, tag.name, child.name), child)

    def _note(self, key: _Key, place: Tag) -> None:
        self._first.setdefault(key, place)
        self._count[key] += 1

    def report(self, context: ReadContext) -> None:
        """Report each finding at its first place, with the number of the others."""
        for key, place in self._first.items():
            _report(key, self._count[key] - 1, place, context)


def _says_nothing(plugin: Tag, kind: str) -> bool:
    """Tell whether a plug-in is not to be loaded, or only has the camera that is read."""
    if plugin.attributes.get("filename") == _NO_PLUGIN:
        return True
    return kind == "gui" and plugin.find("camera_pose") is not None


def _report(key: _Key, more: int, place: Tag, context: ReadContext) -> None:
    name, parent, element = key.name, key.parent, ELEMENTS[key.kind]
    again = f" (and {more} more in this file)" if more else ""
    if key.what == "unknown-tag":
        message = f"<{name}> is not known inside <{parent}>; it has no effect{again}"
        fix = did_you_mean(name, element.names)
        context.diagnostics.report("xml.unknown-tag", message, place.span, fix=fix)
    elif key.what == "unknown-attribute":
        message = f"attribute '{name}' is not known on <{parent}>; it has no effect{again}"
        fix = did_you_mean(name, element.attributes)
        context.diagnostics.report("xml.unknown-attribute", message, place.span, fix=fix)
    elif key.what == "extension":
        message = f"'{name}' in <{parent}> belongs to a private extension; it has no effect{again}"
        context.diagnostics.report("sdf.extension", message, place.span)
    elif key.what == "plugin":
        report_plugin_of(place, key.kind, context, again)
    else:
        message = f"<{name}> in <{parent}> is legal and not simulated{again}"
        context.diagnostics.report("sdf.not-simulated", message, place.span)
