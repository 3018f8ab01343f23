"""What a user's Python node says of its topics, read without running it."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from gazelle.compat.python2 import is_python2, translated

__all__ = ["ScriptTopics", "read_script"]

_PUBLISHERS = frozenset({"Publisher", "create_publisher"})
_SUBSCRIBERS = frozenset({"Subscriber", "create_subscription"})
_BROADCASTERS = frozenset(
    {"StaticTransformBroadcaster", "TransformBroadcaster", "sendTransform", "sendTransformMessage"}
)
# Whatever else may talk to topics without naming them here.
_OPAQUE = frozenset({"__import__", "eval", "exec", "exec_module", "import_module"})
_ROS_MODULES = frozenset({"rclpy", "rospy"})


@dataclass(frozen=True, slots=True)
class ScriptTopics:
    """Topics of a script, as written in its source.

    Attributes:
        publishes: names with types, a type is empty when it is not plain.
        listens: the same for subscriptions.
        sends_transforms: it has a broadcaster of tf.
        is_complete: these are all; False when a name is computed or code of other files may
            talk as well.
    """

    publishes: tuple[tuple[str, str], ...] = ()
    listens: tuple[tuple[str, str], ...] = ()
    sends_transforms: bool = False
    is_complete: bool = True


@lru_cache(maxsize=64)
def read_script(path: Path) -> ScriptTopics:
    """Read a Python node; one that cannot be read is not complete."""
    try:
        source = path.read_bytes()
        text = source.decode("utf-8", "replace")
        tree = ast.parse(translated(text) if is_python2(source) else text)
    except (OSError, SyntaxError, ValueError):
        return ScriptTopics(is_complete=False)
    reader = _Reader(_constants(tree), set(_imports(tree)))
    reader.visit(tree)
    return ScriptTopics(
        tuple(dict.fromkeys(reader.publishes)),
        tuple(dict.fromkeys(reader.listens)),
        reader.sends_transforms,
        reader.is_complete and _stands_alone(tree, path),
    )


class _Reader(ast.NodeVisitor):
    def __init__(self, constants: dict[str, str], imports: set[str]) -> None:
        self._constants = constants
        self._imports = imports
        self.publishes: list[tuple[str, str]] = []
        self.listens: list[tuple[str, str]] = []
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
        is_ros2 = called.startswith("create_")
        words = {item.arg: item.value for item in node.keywords if item.arg}
        places = (1, 0) if is_ros2 else (0, 1)
        given: list[ast.expr | None] = []
        for place, keys in zip(
            places, (("topic", "name"), ("msg_type", "data_class")), strict=True
        ):
            found = next((words[key] for key in keys if key in words), None)
            given.append(node.args[place] if place < len(node.args) else found)
        name = self._text(given[0])
        if name is None:
            self.is_complete = False
            return
        kind = _called(given[1]) if given[1] is not None else ""
        target = self.publishes if called in _PUBLISHERS else self.listens
        target.append((name, kind))

    def _text(self, node: ast.expr | None) -> str | None:
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            return node.value
        return self._constants.get(node.id) if isinstance(node, ast.Name) else None


def _called(node: ast.expr | None) -> str:
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


def _constants(tree: ast.Module) -> dict[str, str]:
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


def _imports(tree: ast.Module) -> list[str]:
    names = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names.append("." * node.level + (node.module or ""))
    return names


def _stands_alone(tree: ast.Module, path: Path) -> bool:
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
