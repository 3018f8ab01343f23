"""Topics of a launch of ROS 2: what its nodes and its simulator have, as far as that is certain."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.launch_ros2.launch_file import LaunchedNode, LaunchTopics
from gazelle.doctor.launch_ros2.launch_tree import Followed, package_of
from gazelle.doctor.script_topics import TopicEnd, read_script
from gazelle.errors import GazelleError
from gazelle.graph.names import resolve
from gazelle.launch.node_commands import Executable, find_executable
from gazelle.node_specs.parameter_substitution import expanded, holds
from gazelle.node_specs.spec import Direction, NodeRole, NodeSpec
from gazelle.workspace import Workspace

__all__ = ["has_one_namespace", "may_be_simulated", "program_of", "topics_of_launch"]

# What puts nodes into namespaces, or renames their topics, from outside of them.
_AROUND = re.compile(
    r"(?:PushR(?:os|OS)Namespace|SetRemap|ComposableNode\w*)\s*\("
    r"|push[-_]ros[-_]namespace|set[-_]remap|composable_node"
)
# Simulators whose topics are none of ROS until somebody bridges them.
_BRIDGED = frozenset({"ros_gz_bridge", "ros_gz_sim", "ros_ign_bridge", "ros_ign_gazebo"})
_PARAMETER = re.compile(r"\{~?([^|{}]+)\|")


def has_one_namespace(files: Sequence[Followed]) -> bool:
    """Tell whether nodes have the names that they are given themselves."""
    return not any(_AROUND.search(item.file.text) for item in files)


def may_be_simulated(files: Sequence[Followed]) -> bool:
    """Tell whether plug-ins of the robots have their topics under the names of the robots' files.

    Not where another simulator has topics of its own, or a spawner sets a namespace.
    """
    packages = {use.name for item in files for use in item.file.packages}
    packages |= {node.package or "" for node in _nodes(files)}
    words = [word for node in _nodes(files) for word in node.arguments]
    return not packages & _BRIDGED and "-robot_namespace" not in words and None not in words


def topics_of_launch(files: Sequence[Followed], workspace: Workspace) -> LaunchTopics:
    """Return the topics of all nodes, those of simulators left out.

    Args:
        files: the launch files.
        workspace: finds programs.
    """
    ends: list[TopicEnd] = []
    others: list[str] = []
    is_whole = all(item.has_all for item in files) and not _starts_others(files, workspace)
    for node in _nodes(files):
        found = program_of(node, workspace)
        own, is_known = _ends(node, found)
        ends += own
        if not is_known:
            is_whole = is_whole and _is_view(found)
            others += [
                _resolved(target, node, renamed=False) for _, target in node.remappings or ()
            ]
    return LaunchTopics(tuple(ends), tuple(others), is_whole)


def _nodes(files: Sequence[Followed]) -> Iterator[LaunchedNode]:
    for item in files:
        yield from item.file.nodes


def _starts_others(files: Sequence[Followed], workspace: Workspace) -> bool:
    """Tell whether processes that are no nodes may have topics."""
    for item in files:
        package = package_of(item.file.path, workspace)
        is_ours = package is not None and package.is_builtin
        started = [one.text.split() for one in item.file.commands if not one.is_substitution]
        if not is_ours and any(words[:1] != ["xacro"] for words in started):
            return True
    return False


def program_of(node: LaunchedNode, workspace: Workspace) -> Executable | None:
    """Return what runs a node, None where that is not known."""
    if node.package is None or node.executable is None:
        return None
    try:
        return find_executable(
            node.package,
            node.executable,
            workspace=workspace,
            diagnostics=Diagnostics(),
            ros_version=2,
        )
    except GazelleError:
        return None


def _is_view(found: Executable | None) -> bool:
    return found is not None and found.builtin is not None and found.builtin.role is NodeRole.VIEW


def _ends(node: LaunchedNode, found: Executable | None) -> tuple[list[TopicEnd], bool]:
    """Return what a node has, and whether that is all."""
    if found is None or node.remappings is None or "--ros-args" in node.arguments:
        return [], False
    if found.builtin is not None:
        return _of_builtin(node, found.builtin)
    if found.script is None:
        return [], False
    script = read_script(found.script)
    name = _name(node)
    ends = [
        TopicEnd(name, _resolved(use.name, node), use.type, use.publishes, use)
        for use in script.uses
        if node.name is not None or not use.name.startswith("~")
    ]
    return ends, script.is_complete and len(ends) == len(script.uses)


def _of_builtin(node: LaunchedNode, spec: NodeSpec) -> tuple[list[TopicEnd], bool]:
    parameters = node.parameters
    is_given = parameters.is_complete and not parameters.files

    def value_of(name: str, default: str) -> str:
        return parameters.values.get(name.removeprefix("~")) or default

    ends, is_whole = [], spec.is_complete or spec.role is NodeRole.ENTITY_SPAWNER
    for row in spec.topics:
        asked = [*_PARAMETER.findall(row.name), row.when.strip("!~").partition("|")[0]]
        values = [parameters.values.get(name, "") for name in asked if name]
        if values and (None in values or not is_given):
            is_whole = False
        elif holds(row.when, value_of):
            topic = _resolved(expanded(row.name, value_of), node)
            gives = row.direction is Direction.GIVES
            ends.append(TopicEnd(_name(node), topic, row.type, gives))
    return ends, is_whole


def _name(node: LaunchedNode) -> str:
    name = node.name or (node.executable or "").removesuffix(".py")
    return resolve(name, _namespace(node))


def _namespace(node: LaunchedNode) -> str:
    return "/" + (node.namespace or "").strip("/")


def _resolved(name: str, node: LaunchedNode, *, renamed: bool = True) -> str:
    full = _name(node)
    written = name.replace("~/", "~", 1) if name.startswith("~/") else name
    plain = resolve(written, _namespace(node), node=full)
    if renamed:
        for source, target in node.remappings or ():
            if _resolved(source, node, renamed=False) == plain:
                return _resolved(target, node, renamed=False)
    return plain
