"""xacro's tags without their prefix, which the program took until ROS Melodic.

Kinetic, Lunar and Melodic warned of ``<property …>`` and worked with it; Noetic and ROS 2 pass it
through. Robots of those days are to come up, so it is taken unless the program is ROS 2's
(source: ros/xacro, branches kinetic-devel to noetic-devel).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from gazelle.description.xacro.dom import span_of
from gazelle.diagnostics import SourceSpan

__all__ = ["NEEDED_ATTRIBUTES", "OF_ROBOTS", "add_prefixes", "takes_unprefixed", "with_old_calls"]

_PREFIX = "xacro:"

NEEDED_ATTRIBUTES: Mapping[str, frozenset[str]] = {
    "arg": frozenset({"name", "default"}),
    "if": frozenset({"value"}),
    "include": frozenset({"filename"}),
    "insert_block": frozenset({"name"}),
    "macro": frozenset({"name"}),
    "property": frozenset({"name", "value"}),
    "unless": frozenset({"value"}),
}
"""What an element must have to be meant for xacro, by its name without the prefix."""

OF_ROBOTS = frozenset(
    {"gazebo", "group", "joint", "link", "material", "ros2_control", "sensor", "transmission"}
)
"""Elements of a robot that are no macro calls, also where a macro has the name."""

Old = tuple[str, SourceSpan | None]
"""A tag's name without the prefix, and where it stands."""


def takes_unprefixed(environ: Mapping[str, str]) -> bool:
    """Tell whether an environment is one in which packages of Kinetic or Melodic may run."""
    return environ.get("ROS_VERSION", "1") != "2"


def add_prefixes(root: Any, found: list[Old]) -> None:
    """Put the prefix before the tags that are xacro's, below an element of a parsed file.

    Args:
        root: the file's outermost DOM element.
        found: receives what was changed.
    """
    for element in _below(root):
        needed = NEEDED_ATTRIBUTES.get(element.tagName)
        if needed is None or not _is_meant(element, needed):
            continue
        found.append((element.tagName, span_of(element)))
        _rename(element)


def with_old_calls(
    function: Callable[..., Any], library: Any, found: list[Old]
) -> Callable[..., Any]:
    """Let the library's function for macro calls take those without the prefix.

    Files of today have macros of an element's name (``box``), which are not meant by the element.
    What is taken fits the macro's parameters, stands outside of that macro, and is the robot's
    own child unless the files are old ones by their other tags.

    Args:
        function: ``handle_macro_call``.
        library: the module.
        found: tags without the prefix up to now; receives the calls.
    """

    def call(element: Any, macros: Any, symbols: Any) -> Any:
        name = element.tagName
        if not name.startswith(_PREFIX):
            macro = None if name in OF_ROBOTS else _macro(library, name, macros, symbols)
            if macro is None or macro in library.macrostack or not _fits(element, macro):
                return False
            if (not found and not _is_top(element)) or _is_in_plugin(element):
                return False
            found.append((name, span_of(element)))
            _rename(element)
        return function(element, macros, symbols)

    return call


def _macro(library: Any, name: str, macros: Any, symbols: Any) -> Any:
    # The look-up tells of itself where every use of a name is asked for.
    verbosity, library.verbosity = library.verbosity, 0
    try:
        return library.resolve_macro(name, macros, symbols)[-1]
    except (KeyError, TypeError, AttributeError):
        return None
    finally:
        library.verbosity = verbosity


def _fits(element: Any, macro: Any) -> bool:
    """Tell whether an element has what a macro's call needs, and nothing else."""
    given = set(element.attributes.keys())
    named = {name for name in macro.params if not name.startswith("*")}
    blocks = len(macro.params) - len(named)
    elements = sum(child.nodeType == child.ELEMENT_NODE for child in element.childNodes)
    return given <= named and named - set(macro.defaultmap) <= given and blocks == elements


def _is_top(element: Any) -> bool:
    return bool(element.parentNode.tagName == "robot")


def _below(element: Any) -> Iterator[Any]:
    """Yield the elements below one, in order; what plug-ins hold has meanings of their own."""
    for child in element.childNodes:
        if child.nodeType == child.ELEMENT_NODE and child.tagName != "plugin":
            yield child
            yield from _below(child)


def _is_meant(element: Any, needed: frozenset[str]) -> bool:
    if all(map(element.hasAttribute, needed)):
        return True
    # A block: <property name="origin"><origin …/></property>.
    is_block = any(child.nodeType == child.ELEMENT_NODE for child in element.childNodes)
    return element.tagName == "property" and element.hasAttribute("name") and is_block


def _is_in_plugin(element: Any) -> bool:
    while element is not None:
        if element.nodeType == element.ELEMENT_NODE and element.tagName == "plugin":
            return True
        element = element.parentNode
    return False


def _rename(element: Any) -> None:
    element.tagName = element.nodeName = _PREFIX + element.tagName
