"""Topics: their ends in a launch, and those that a script in Python names in its source."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from gazelle.compat.python2 import is_python2, translated
from gazelle.diagnostics import SourceSpan

__all__ = [
    "ScriptTopics",
    "TopicEnd",
    "TopicUse",
    "module_texts",
    "parsed_script",
    "read_script",
    "stands_alone",
]

_PUBLISHERS = frozenset({"Publisher", "create_publisher"})
_SUBSCRIBERS = frozenset({"Subscriber", "create_subscription", "wait_for_message"})
_BROADCASTERS = frozenset(
    {"StaticTransformBroadcaster", "TransformBroadcaster", "sendTransform", "sendTransformMessage"}
)
# Whatever else may talk to topics without naming them here.
_OPAQUE = frozenset({"__import__", "eval", "exec", "exec_module", "import_module"})
_ROS_MODULES = frozenset({"rclpy", "rospy"})
_TOPIC_KEYWORDS = ("topic", "name")
_TYPE_KEYWORDS = ("msg_type", "data_class", "topic_type")
# Where a call has the topic and the type.
_ROS1_POSITIONS = (0, 1)
_ROS2_POSITIONS = (1, 0)
# message_filters.Subscriber(node, type, topic).
_FILTER_POSITIONS = (2, 1)
# rclpy.wait_for_message.wait_for_message(type, node, topic).
_ROS2_WAIT_POSITIONS = (2, 0)


class TopicUse(NamedTuple):
    """A topic that a script publishes or listens to.

    Attributes:
        name: as written.
        type: such as ``std_msgs/msg/String``; the class's name where its package is not plain,
            empty where even that is not.
        publishes: True for a publisher, False for a subscription.
        name_span, type_span: where they stand in a call.
    """

    name: str
    type: str
    publishes: bool
    name_span: SourceSpan
    type_span: SourceSpan


class TopicEnd(NamedTuple):
    """A node that publishes or listens to a topic.

    Attributes:
        node: its global name.
        topic: global, after remapping.
        type: such as ``sensor_msgs/msg/LaserScan``; a class's name alone, or empty, when no more
            is known.
        publishes: it publishes, else it listens.
        use: where a script of the user's says so, None for other nodes.
    """

    node: str
    topic: str
    type: str
    publishes: bool
    use: TopicUse | None = None


@dataclass(frozen=True, slots=True)
class ScriptTopics:
    """Topics of a script, as written in its source.

    Attributes:
        uses: each that is named plainly.
        sends_transforms: it has a broadcaster of tf.
        is_complete: these are all; False when a name is computed or code of other files may
            talk as well.
        texts: all texts in the source that are no names of these topics and no comments: services,
            parameters, parts of names.
    """

    uses: tuple[TopicUse, ...] = ()
    sends_transforms: bool = False
    is_complete: bool = True
    texts: frozenset[str] = frozenset()

    @property
    def publishes(self) -> dict[str, str]:
        """Types of what it publishes, by name as written."""
        return {use.name: use.type for use in self.uses if use.publishes}

    @property
    def listens(self) -> dict[str, str]:
        """Types of what it listens to, by name as written."""
        return {use.name: use.type for use in self.uses if not use.publishes}


def read_script(path: Path) -> ScriptTopics:
    """Read a Python node; one that cannot be read is not complete."""
    try:
        return _read(path, path.read_bytes())
    except (OSError, SyntaxError, ValueError):
        return ScriptTopics(is_complete=False)


def module_texts(tree: ast.Module) -> dict[str, str]:
    """Return the texts that names of the module stand for, each bound once."""
    found: dict[str, str | None] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign):
            for target in node.targets:
                if isinstance(target, ast.Name):
                    value = node.value
                    text = value.value if isinstance(value, ast.Constant) else None
                    is_new = target.id not in found and isinstance(text, str)
                    found[target.id] = text if is_new else None  # type: ignore[assignment]
    return {name: text for name, text in found.items() if text is not None}


def parsed_script(source: bytes) -> ast.Module:
    """Return the syntax tree of a script, which may be of Python 2.

    Raises:
        SyntaxError: it is no Python.
    """
    text = source.decode("utf-8", "replace")
    return ast.parse(translated(text) if is_python2(source) else text)


def stands_alone(tree: ast.Module, path: Path) -> bool:
    """Tell whether no other file of the user's can open topics for this one."""
    names = _imports(tree)
    uses_ros = any(name.partition(".")[0] in _ROS_MODULES for name in names)
    folders = (path.parent, path.parent.parent, path.parent.parent / "src")
    own = any(
        name.startswith(".")
        or any(
            (folder / name.partition(".")[0]).is_dir()
            or (folder / f"{name.partition('.')[0]}.py").is_file()
            for folder in folders
        )
        for name in names
    )
    return uses_ros and not own


@lru_cache(maxsize=64)
def _read(path: Path, source: bytes) -> ScriptTopics:
    tree = parsed_script(source)
    reader = _Reader(path, module_texts(tree), dict(_imported(tree)))
    reader.visit(tree)
    return ScriptTopics(
        tuple(reader.uses),
        reader.sends_transforms,
        reader.is_complete and stands_alone(tree, path),
        frozenset(_texts(tree)) - {use.name for use in reader.uses},
    )


class _Reader(ast.NodeVisitor):
    def __init__(self, path: Path, constants: dict[str, str], imported: dict[str, str]) -> None:
        self._path = path
        self._constants = constants
        self._imported = imported
        self.uses: list[TopicUse] = []
        self.sends_transforms = False
        self.is_complete = True

    def visit_Call(self, node: ast.Call) -> None:
        name = _called(node.func)
        if name in _PUBLISHERS | _SUBSCRIBERS:
            self._topic(node, name)
        elif name in _BROADCASTERS:
            self.sends_transforms = True
        elif name in _OPAQUE or name == "SimpleActionClient" or name.endswith("ActionServer"):
            self.is_complete = False
        self.generic_visit(node)

    def _topic(self, node: ast.Call, called: str) -> None:
        keywords = {item.arg: item.value for item in node.keywords if item.arg}
        at_topic, at_type = _positions(node, called)
        topic = _given(node, at_topic, keywords, _TOPIC_KEYWORDS)
        kind = _given(node, at_type, keywords, _TYPE_KEYWORDS)
        name = self._text(topic)
        if name is None or topic is None:
            self.is_complete = False
            return
        name_span, type_span = self._span(topic), self._span(kind or node)
        is_publisher = called in _PUBLISHERS
        use = TopicUse(name, self._type(kind), is_publisher, name_span, type_span)
        self.uses.append(use)

    def _text(self, node: ast.expr | None) -> str | None:
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            return node.value
        return self._constants.get(node.id) if isinstance(node, ast.Name) else None

    def _type(self, node: ast.expr | None) -> str:
        """Return the type that a class means, by what is imported."""
        dotted = _dotted(node)
        first, _, rest = dotted.partition(".")
        full = self._imported.get(first, first) + (f".{rest}" if rest else "")
        package, _, name = full.partition(".msg.")
        if name and "." not in name and "." not in package:
            return f"{package}/msg/{name}"
        return "" if full.startswith("rospy.") else dotted.rpartition(".")[2]

    def _span(self, node: ast.expr) -> SourceSpan:
        same = node.end_lineno == node.lineno
        length = (node.end_col_offset or 0) - node.col_offset if same else 0
        return SourceSpan(str(self._path), node.lineno, node.col_offset + 1, length)


def _positions(node: ast.Call, called: str) -> tuple[int, int]:
    if called.startswith("create_"):
        return _ROS2_POSITIONS
    if called == "wait_for_message":
        is_ros2 = len(node.args) > 2 and isinstance(node.args[1], ast.Name | ast.Attribute)
        return _ROS2_WAIT_POSITIONS if is_ros2 else _ROS1_POSITIONS
    third = node.args[2] if len(node.args) > 2 else None
    is_filter = isinstance(third, ast.Constant) and isinstance(third.value, str)
    return _FILTER_POSITIONS if is_filter else _ROS1_POSITIONS


def _given(
    node: ast.Call, position: int, keywords: dict[str, ast.expr], names: tuple[str, ...]
) -> ast.expr | None:
    if position < len(node.args):
        return node.args[position]
    return next((keywords[name] for name in names if name in keywords), None)


def _called(node: ast.expr | None) -> str:
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


def _dotted(node: ast.expr | None) -> str:
    if isinstance(node, ast.Attribute):
        owner = _dotted(node.value)
        return f"{owner}.{node.attr}" if owner else ""
    return node.id if isinstance(node, ast.Name) else ""


def _texts(tree: ast.Module) -> Iterator[str]:
    said = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in said:
            yield node.value


def _imported(tree: ast.Module) -> Iterator[tuple[str, str]]:
    """Yield names of the module with the full names of what they were imported as."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                first = alias.name.partition(".")[0]
                yield (alias.asname, alias.name) if alias.asname else (first, first)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            for alias in node.names:
                yield alias.asname or alias.name, f"{node.module}.{alias.name}"


def _imports(tree: ast.Module) -> list[str]:
    names = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names.append("." * node.level + (node.module or ""))
    return names
