"""Parameters of ros2_control: the files that the plug-in and the spawners name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.control.parameter_sources.ros2_parameter_file import NodeSection, read_parameter_file
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.parameters.trees import flattened, nested
from gazelle.ros_arguments import (
    PARAM,
    PARAMS_FILE,
    REMAP,
    RosArgumentError,
    RosToken,
    read_tokens,
    rule_of,
    yaml_value,
)

__all__ = ["FileSource", "RosArguments", "read_ros_arguments"]


_END = "--"


@dataclass(frozen=True, slots=True)
class RosArguments:
    """Rules, files and values of one node.

    Attributes:
        remappings: names to use instead, in order.
        files: of ``--params-file``.
        values: of ``-p``, by the parameter's name with dots.
        strange: words that are none of these.
    """

    remappings: tuple[tuple[str, str], ...] = ()
    files: tuple[str, ...] = ()
    values: Mapping[str, Any] = field(default_factory=dict)
    strange: tuple[str, ...] = ()


def read_ros_arguments(arguments: Iterable[str]) -> RosArguments:
    """Read the words of a node's command line; each may hold several, parted by spaces.

    A rule without ``-r`` before it counts as one, and ``node:`` before a rule's name is left out.
    """
    rules: list[tuple[str, str]] = []
    files: list[str] = []
    values: dict[str, Any] = {}
    strange: list[str] = []
    parts = (part for text in arguments for part in text.split() if part != _END)
    for word in read_tokens(parts):
        found = word if word.option else RosToken(REMAP, word.written, "")
        if found.option == PARAMS_FILE and found.value is not None:
            files.append(found.value)
            continue
        try:
            _, name, value = rule_of(found)
        except RosArgumentError:
            name = ""
        if found.option == REMAP and name:
            rules.append((name, value))
        elif found.option == PARAM and name:
            values[name] = yaml_value(value) if value else ""
        else:
            strange += [part for part in (found.written, found.value) if part]
    return RosArguments(tuple(rules), tuple(files), values, tuple(strange))


class FileSource:
    """Reads parameters of nodes below a namespace; later files and `set` override earlier ones.

    Args:
        files: parameter files.
        namespace: of the controller manager, absolute.
        diagnostics: receives what is wrong in the files.
        manager: the controller manager's node name.
        overrides: parameters by node name (without namespace), nested or with dots.
    """

    def __init__(
        self,
        files: Iterable[Path],
        namespace: str,
        diagnostics: Diagnostics,
        *,
        manager: str = "controller_manager",
        overrides: Mapping[str, Mapping[str, Any]] | None = None,
    ) -> None:
        self.namespace = "/" + namespace.strip("/") if namespace.strip("/") else ""
        self._diagnostics = diagnostics
        self._manager = manager
        self._sections: list[NodeSection] = []
        # What a spawner names for one controller says nothing of the others.
        self._named: dict[str, list[NodeSection]] = {}
        self._remappings: dict[str, tuple[tuple[str, str], ...]] = {}
        self._overrides = {name: nested(tree) for name, tree in (overrides or {}).items()}
        for path in files:
            self.add_file(path)

    def add_file(self, path: Path) -> None:
        """Read one more file."""
        self.add_sections(read_parameter_file(path, self._diagnostics))

    def add_sections(self, sections: Iterable[NodeSection]) -> None:
        """Take in what was read of a file already."""
        self._sections += sections

    def controllers(self) -> tuple[str, ...]:
        """Return the names with a type, in the manager's own parameters or their own."""
        own = [name for name, tree in self.manager_tree().items() if _has_type(tree)]
        nodes = [section.node.rpartition("/")[2] for section in self._sections]
        names = dict.fromkeys([*own, *nodes, *self._overrides])
        return tuple(name for name in names if self.controller_type(name) is not None)

    def controller_type(self, controller: str) -> str | None:
        """Return ``<controller>.type`` of the manager, or ``type`` of the controller's node."""
        tree = self.manager_tree().get(controller)
        found = tree.get("type") if isinstance(tree, Mapping) else None
        if found is None and controller != self._manager and "*" not in controller:
            found = self.tree(controller).get("type")
        return None if found is None else str(found)

    def tree(self, controller: str) -> Mapping[str, Any]:
        """Return what all matching sections say, merged in the order of the files."""
        merged: dict[str, Any] = {}
        for section in self._matching(controller):
            _merge(merged, nested(section.values))
        _merge(merged, self._overrides.get(controller, {}))
        return merged

    def manager_tree(self) -> Mapping[str, Any]:
        """Return the parameters of the controller manager's node."""
        return self.tree(self._manager)

    def set(self, controller: str, key: str, value: Any) -> None:
        """Override one parameter."""
        node = controller or self._manager
        _merge(self._overrides.setdefault(node, {}), nested({key: value}))

    def take_named(self, controller: str) -> None:
        """Read what a spawner told the manager of a controller.

        That is its ``params_file`` and the words of its ``node_options_args``, whose rules are
        `remappings` then. Values of those words go before all files.
        """
        own = self.manager_tree().get(controller)
        if not isinstance(own, Mapping):
            return
        files, arguments = (_listed(own.get(key)) for key in ("params_file", "node_options_args"))
        given = read_ros_arguments(arguments)
        self._named[controller] = [
            section
            for file in (*files, *given.files)
            for section in read_parameter_file(Path(file), self._diagnostics)
        ]
        for key, value in given.values.items():
            self.set(controller, key, value)
        self._remappings[controller] = given.remappings
        if given.strange:
            text = f"--controller-ros-args of '{controller}': '{' '.join(given.strange)}' has no"
            self._diagnostics.report("parameter.bad-value", f"{text} effect")

    def remappings(self, controller: str) -> tuple[tuple[str, str], ...]:
        """Return the rules for a controller's names, of what `take_named` has read."""
        return self._remappings.get(controller, ())

    def full_name(self, controller: str, key: str) -> str:
        """Return the name within the controller's node."""
        return key

    def span(self, controller: str, key: str) -> SourceSpan | None:
        """Return where the value that counts stands."""
        if key in {name for name, _ in flattened(self._overrides.get(controller, {}))}:
            return None
        for section in reversed(self._matching(controller)):
            if key in section.spans:
                return section.spans[key]
        return None

    def strangers(self) -> tuple[str, ...]:
        """Return the nodes of the files when none of them is in the namespace, else nothing."""
        sections = [*self._sections, *(one for named in self._named.values() for one in named)]
        nodes = [section.node for section in sections]
        for section in sections:
            if section.matches(f"{self.namespace}/{section.node.rpartition('/')[2]}"):
                return ()
        return tuple(dict.fromkeys(nodes))

    def _matching(self, node: str) -> list[NodeSection]:
        full = f"{self.namespace}/{node}"
        sections = (*self._sections, *self._named.get(node, ()))
        return [section for section in sections if section.matches(full)]


def _listed(value: Any) -> list[str]:
    return [value] if isinstance(value, str) else [str(one) for one in value or ()]


def _has_type(tree: Any) -> bool:
    return isinstance(tree, Mapping) and isinstance(tree.get("type"), str)


def _merge(target: dict[str, Any], source: Mapping[str, Any]) -> None:
    for key, value in source.items():
        known = target.get(key)
        if isinstance(known, dict) and isinstance(value, Mapping):
            _merge(known, value)
        else:
            target[key] = nested(value) if isinstance(value, Mapping) else value
