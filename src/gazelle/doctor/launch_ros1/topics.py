"""Which topics the nodes of a launch use: tables for known nodes, reading for users' scripts."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from gazelle.compat.python2 import is_python2, translated
from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.graph.names import resolve
from gazelle.node_specs.parameter_substitution import ValueOf, expanded, holds
from gazelle.node_specs.registry import node_specs
from gazelle.node_specs.spec import Direction, Interface, NodeSpec
from gazelle.node_specs.unavailable_packages import Sends, what_it_sends

__all__ = [
    "BuiltinTopics",
    "KnownNode",
    "NodeTopics",
    "ScriptTopics",
    "builtin_topics",
    "read_script",
    "topics_of",
]

_EKF = frozenset({"ekf_localization_node", "ekf_node"})
_PUBLISHERS = frozenset({"Publisher", "create_publisher"})
_SUBSCRIBERS = frozenset({"Subscriber", "create_subscription"})
_BROADCASTERS = frozenset(
    {"StaticTransformBroadcaster", "TransformBroadcaster", "sendTransform", "sendTransformMessage"}
)
# Whatever else may talk to topics without naming them here.
_OPAQUE = frozenset({"__import__", "eval", "exec", "exec_module", "import_module"})
_ROS_MODULES = frozenset({"rclpy", "rospy"})
_JOINT_STATE = "sensor_msgs/msg/JointState"


@dataclass(frozen=True, slots=True)
class BuiltinTopics:
    """What one node has.

    Attributes:
        publishes, listens: types by global topic, after remapping; a type may be empty.
        written: names before remapping that its code uses, global.
        transforms: parent and child of each it sends; None when they cannot be told.
        joints: whose states it sends; None when they cannot be told.
        is_complete: there are no further topics.
    """

    publishes: Mapping[str, str]
    listens: Mapping[str, str]
    written: frozenset[str]
    transforms: tuple[tuple[str, str], ...] | None
    joints: frozenset[str] | None
    is_complete: bool


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


@dataclass(frozen=True, slots=True)
class KnownNode:
    """A node that sends no joint states, or known ones.

    Attributes:
        transforms: parent and child of each it sends; None when they cannot be told.
    """

    transforms: tuple[tuple[str, str], ...] | None = ()


@dataclass(frozen=True, slots=True)
class NodeTopics:
    """Topics of one node by global name, with types; a type may be empty.

    Attributes:
        node: whose.
        publishes, listens: after remapping.
        written: names before remapping that its code uses, global.
        is_complete: the node surely uses no others.
        known: what is known of joint states and tf of a node whose topics are not.
        joints: whose states a built-in node sends, where it always sends the same.
    """

    node: LaunchedNode
    publishes: Mapping[str, str]
    listens: Mapping[str, str]
    written: frozenset[str]
    is_complete: bool = True
    known: KnownNode | None = None
    joints: frozenset[str] = frozenset()


def builtin_topics(node: LaunchedNode, launched: Launched) -> BuiltinTopics | None:
    """Return what a built-in node has; None for other nodes."""
    spec = node.executable.builtin if node.executable is not None else None
    if spec is None:
        return None

    def value_of(name: str, default: str) -> str:
        full = name if name.startswith("~") else node.resolve(name)
        full = resolve(full, node.program.namespace, node=node.full_name)
        has_own = launched.parameters.has(full)
        return str(launched.parameters.get(full)) if has_own else default

    rows = [row for row in spec.topics if holds(row.when, value_of)]
    others = (*spec.services, *spec.actions)
    names = [expanded(row.name, value_of) for row in (*rows, *others)]
    return BuiltinTopics(
        _by_topic(_of(rows, Direction.GIVES), node, spec, value_of),
        _by_topic(_of(rows, Direction.TAKES), node, spec, value_of),
        frozenset(_global(name, node) for name in (*names, *spec.namespaces)),
        _transforms(spec, node, launched, value_of),
        None if spec.joints is None else frozenset(expanded(one, value_of) for one in spec.joints),
        spec.is_complete,
    )


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


def topics_of(launched: Launched, starts: Mapping[str, DryStart]) -> tuple[NodeTopics, ...]:
    """Return what is known of every node's topics.

    Args:
        launched: the launch.
        starts: simulators that came up, by global name of their node.
    """
    return tuple(_topics(node, launched, starts) for node in launched.nodes)


def _of(rows: Iterable[Interface], direction: Direction) -> list[Interface]:
    return [row for row in rows if row.direction is direction]


def _by_topic(
    rows: Iterable[Interface], node: LaunchedNode, spec: NodeSpec, value_of: ValueOf
) -> dict[str, str]:
    return {_remapped(expanded(row.name, value_of), node, spec): row.type for row in rows}


def _remapped(name: str, node: LaunchedNode, spec: NodeSpec) -> str:
    """Return the global name of a topic; a namespace that is remapped by itself comes first."""
    first, _, rest = name.partition("/")
    return node.resolve(f"{node.resolve(first)}/{rest}" if first in spec.namespaces else name)


def _global(name: str, node: LaunchedNode) -> str:
    return resolve(name, node.program.namespace, node=node.full_name)


def _transforms(
    spec: NodeSpec, node: LaunchedNode, launched: Launched, value_of: ValueOf
) -> tuple[tuple[str, str], ...] | None:
    if spec.executable in _EKF:
        return _filtered(node, launched)
    if spec.frames is None:
        return None
    return tuple(
        (expanded(row.parent, value_of).strip("/"), expanded(row.child, value_of).strip("/"))
        for row in spec.frames
        if holds(row.when, value_of)
    )


def _filtered(node: LaunchedNode, launched: Launched) -> tuple[tuple[str, str], ...]:
    """Return what a filter of robot_localization sends, by REP 105 from its world frame."""

    def frame(name: str, default: str) -> str:
        return str(launched.private(node, name, default)).strip("/")

    if launched.private(node, "publish_tf", True) is False:
        return ()
    odom = frame("odom_frame", "odom")
    world = frame("world_frame", odom)
    base = frame("base_link_frame", "base_link")
    return ((world, odom if world == frame("map_frame", "map") else base),)


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
        keywords = {item.arg: item.value for item in node.keywords if item.arg}
        positions = (1, 0) if is_ros2 else (0, 1)
        given: list[ast.expr | None] = []
        for position, keys in zip(
            positions, (("topic", "name"), ("msg_type", "data_class")), strict=True
        ):
            found = next((keywords[key] for key in keys if key in keywords), None)
            given.append(node.args[position] if position < len(node.args) else found)
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


def _topics(node: LaunchedNode, launched: Launched, starts: Mapping[str, DryStart]) -> NodeTopics:
    match node.role:
        case Role.SIMULATOR:
            return _of_simulator(node, starts.get(node.full_name))
        case Role.SCRIPT if node.file is not None:
            script = read_script(node.file)
            return _named(node, dict(script.publishes), dict(script.listens), script.is_complete)
        case Role.JOINT_STATES:
            sources = launched.private(node, "source_list", [])
            names = sources if isinstance(sources, list) else []
            listens = {name: _JOINT_STATE for name in names if isinstance(name, str)}
            return _named(node, {"joint_states": _JOINT_STATE}, listens)
        case Role.RELAY:
            return _of_relay(node)
    builtin = builtin_topics(node, launched)
    if builtin is not None:
        return NodeTopics(
            node,
            builtin.publishes,
            builtin.listens,
            builtin.written,
            builtin.is_complete,
            KnownNode(builtin.transforms) if builtin.joints is not None else None,
            builtin.joints or frozenset(),
        )
    known = _elsewhere(node)
    return NodeTopics(node, {}, {}, frozenset(), is_complete=False, known=known)


def _elsewhere(node: LaunchedNode) -> KnownNode | None:
    """Return what is known of a node of ROS that is not here; None when it may send anything.

    All of its topics are not listed, so nothing is said of remaps and topics.
    """
    package = [spec for spec in node_specs() if spec.package == node.spec.package]
    if package and all(spec.frames == () and spec.joints == () for spec in package):
        # A program that its package does not have: none of its others sends anything.
        return KnownNode()
    match what_it_sends(node.spec.package, node.spec.type):
        case Sends.NOTHING:
            return KnownNode()
        case Sends.TRANSFORMS:
            return KnownNode(None)
        case Sends.ANYTHING:
            return None


def _named(
    node: LaunchedNode,
    publishes: Mapping[str, str],
    listens: Mapping[str, str],
    is_complete: bool = True,
) -> NodeTopics:
    namespace, own = node.program.namespace, node.full_name
    written = frozenset(resolve(name, namespace, node=own) for name in (*publishes, *listens))
    return NodeTopics(
        node,
        {node.resolve(name): kind for name, kind in publishes.items()},
        {node.resolve(name): kind for name, kind in listens.items()},
        written,
        is_complete,
    )


def _of_relay(node: LaunchedNode) -> NodeTopics:
    argv = [word for word in node.program.argv if word != "messages"]
    if not argv:
        return NodeTopics(node, {}, {}, frozenset(), is_complete=False)
    last = argv[-1]
    is_number = last.replace(".", "", 1).isdigit()
    target = last if len(argv) > 1 and not is_number else f"{argv[0]}_{node.spec.type}"
    return _named(node, {target: ""}, {argv[0]: ""})


def _of_simulator(node: LaunchedNode, start: DryStart | None) -> NodeTopics:
    if start is None:
        return NodeTopics(node, {}, {}, frozenset(), is_complete=False)
    own = start.node
    return NodeTopics(node, own.offered, own.heard, frozenset(own.asked))
