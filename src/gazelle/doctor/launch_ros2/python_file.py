"""Launch files in Python, followed without running them."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path, PurePath
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.launch_ros2.launch_file import (
    Argument,
    Command,
    Include,
    LaunchedNode,
    LaunchFile,
    Parameters,
    UnknownKeyword,
    Use,
)
from gazelle.doctor.launch_ros2.substitutions import Substitutions
from gazelle.workspace import Workspace
from gazelle.workspace.static_python import UNKNOWN, Call, Evaluator, parse_python, syntax_problem

__all__ = ["read_python_file"]

_MAX_DEPTH = 12
_ENTRY = "generate_launch_description"
_NODES = frozenset({"Node", "LifecycleNode", "ComposableNodeContainer"})
_OLD_KEYWORDS = frozenset({"node_executable", "node_name", "node_namespace"})
_FOLDER_CALLS = frozenset(
    {"get_package_share_directory", "get_package_share_path", "get_package_prefix"}
)
_JOINS = frozenset({"join", "joinpath"})
_TESTS = frozenset({"exists", "isfile"})


def read_python_file(
    path: Path,
    given: Mapping[str, str | None],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
) -> LaunchFile | None:
    """Read a launch file; None (and an error reported) when it is no Python.

    Args:
        path: the file.
        given: launch arguments from outside, None for values that are not known.
        workspace: finds packages.
        diagnostics: receives errors of syntax.
    """
    text = ""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
        tree = parse_python(text)
    except (OSError, SyntaxError) as error:
        problem = syntax_problem(text, error)
        message = f"the launch file is not Python 3: {problem.message}"
        span = SourceSpan(str(path), problem.line, problem.column)
        diagnostics.report("launch_ros2.unreadable", message, span, fix=problem.fix)
        return None
    if not any(
        isinstance(node, ast.FunctionDef) and node.name == _ENTRY for node in ast.walk(tree)
    ):
        message = f"the file has no {_ENTRY}(): it is no launch file"
        diagnostics.report("launch_ros2.unreadable", message, SourceSpan(str(path)))
        return None
    # Twice: functions that are followed where they are named may ask for arguments that are
    # declared further down.
    first = _Reader(path, text, Substitutions(path, given, workspace), workspace)
    first.follow(tree)
    again = Substitutions(path, given, workspace, first.file.arguments)
    reader = _Reader(path, text, again, workspace)
    reader.follow(tree)
    reader.file.computes_uses = any(_is_computed_use(node) for node in ast.walk(tree))
    return reader.file


class _Reader:
    def __init__(
        self, path: Path, text: str, substitutions: Substitutions, workspace: Workspace
    ) -> None:
        self.file = LaunchFile(path, text=text)
        self._values = substitutions
        self._workspace = workspace
        self._wrapped: set[int] = set()
        self._asked: list[Call] = []
        self._tested: set[str] = set()
        self._performed_calls: set[int] = set()

    def follow(self, tree: ast.Module) -> None:
        functions: dict[str, Callable[..., Any]] = {
            "get_package_share_directory": self._folder,
            "get_package_share_path": lambda name: PurePath(self._folder(name)),
        }
        evaluator = Evaluator(
            self.file.path,
            self.file.path.parent,
            functions=functions,
            methods={"perform": self._performed, "find": self._found},
        )
        evaluator.run(tree)
        evaluator.call_function(_ENTRY)
        self._wrapped = {
            id(inner)
            for call in evaluator.calls
            if call.name == "ParameterValue"
            for inner in (call.get("value", 0),)
        }
        self._performed_calls = {
            id(inner) for call in evaluator.calls for inner in _inside([call.owner, *_given(call)])
        } | {id(call) for call in self._asked}
        # Files that are asked about first may be missing.
        self._tested = {
            call.arguments[0]
            for call, _ in evaluator.computed
            if call.name in _TESTS and call.arguments and isinstance(call.arguments[0], str)
        }
        for call, outcome in evaluator.computed:
            self._take_computed(call, outcome)
        for call in evaluator.calls:
            self._take(call)

    def _folder(self, name: str) -> Any:
        found = self._workspace.packages.get(name)
        return UNKNOWN if found is None else str(found.path)

    def _performed(self, call: Call) -> Any:
        self._asked.append(call)
        value = self._values.text(call)
        return UNKNOWN if value is None else value

    def _found(self, call: Call) -> Any:
        value = self._values.text(call) if call.name == "FindPackageShare" else None
        return UNKNOWN if value is None else value

    def _span(self, call: Call) -> SourceSpan:
        node = call.node
        same = node.end_lineno == node.lineno
        length = (node.end_col_offset or 0) - node.col_offset if same else 0
        return SourceSpan(str(self.file.path), node.lineno, node.col_offset + 1, length)

    def _span_of_file(self, call: Call) -> SourceSpan:
        """Return where the last text of a path stands: its file."""
        texts = [
            node
            for node in ast.walk(call.node)
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and "." in node.value
        ]
        if not texts:
            return self._span(call)
        last = max(texts, key=lambda node: (node.lineno, node.col_offset))
        length = (last.end_col_offset or 0) - last.col_offset
        return SourceSpan(str(self.file.path), last.lineno, last.col_offset + 1, length)

    def _take_computed(self, call: Call, outcome: Any) -> None:
        if call.name in _FOLDER_CALLS and call.arguments and isinstance(call.arguments[0], str):
            self.file.packages.append(Use(call.arguments[0], self._span(call)))
        elif call.name in _JOINS and isinstance(outcome, str) and PurePath(outcome).suffix:
            if outcome in self._tested:
                return
            self.file.paths.append(Use(outcome, self._span_of_file(call)))

    def _take(self, call: Call) -> None:
        takers: dict[str, Callable[[Call], None]] = {
            "DeclareLaunchArgument": self._declare,
            "LaunchConfiguration": self._use,
            "FindPackageShare": self._find,
            "FindPackagePrefix": self._find,
            "PathJoinSubstitution": self._join,
            "IncludeLaunchDescription": self._include,
            "ExecuteProcess": self._process,
            "Command": self._command,
            "check_output": self._run,
            "open": self._open,
            "process_file": self._process_file,
            "run": self._run,
            "SetParameter": self._set_parameter,
            "SetLaunchConfiguration": self._set,
            "SetParametersFromFile": self._set_parameter,
        }
        if call.name in _NODES:
            self._node(call)
        elif call.name in takers:
            takers[call.name](call)

    def _declare(self, call: Call) -> None:
        name = call.get("name", 0)
        if isinstance(name, str):
            value = call.get("default_value", 1)
            text = self._values.text(value)
            required = "default_value" not in call.keywords and len(call.arguments) < 2
            self.file.arguments.append(Argument(name, text, required, self._span(call)))

    def _set(self, call: Call) -> None:
        name = call.get("name", 0)
        if isinstance(name, str):
            text = self._values.text(call.get("value", 1))
            self.file.arguments.append(Argument(name, text, False, self._span(call)))

    def _use(self, call: Call) -> None:
        name = call.get("variable_name", 0)
        # One that is only kept in a variable is never asked for its value.
        is_asked = id(call) in self._performed_calls
        if isinstance(name, str) and call.get("default", 1) is None and is_asked:
            self.file.uses.append(Use(name, self._span(call)))

    def _find(self, call: Call) -> None:
        name = self._values.text(call.get("package", 0))
        if name is not None:
            self.file.packages.append(Use(name, self._span(call)))

    def _join(self, call: Call) -> None:
        path = self._values.text(call)
        if path is not None and PurePath(path).suffix:
            self.file.paths.append(Use(path, self._span_of_file(call)))

    def _set_parameter(self, call: Call) -> None:
        name = self._values.text(call.get("name", 0))
        self.file.sets_parameters.add(name if name is not None else "use_sim_time")

    def _include(self, call: Call) -> None:
        source = call.get("launch_description_source", 0)
        inner = source.get("launch_file_path", 0) if isinstance(source, Call) else source
        pairs = call.get("launch_arguments", default=())
        pairs = list(pairs.items()) if isinstance(pairs, dict) else pairs
        values: dict[str, str | None] = {}
        for pair in pairs if isinstance(pairs, list | tuple) else ():
            if isinstance(pair, list | tuple) and len(pair) == 2:
                name = self._values.text(pair[0])
                if name is not None:
                    values[name] = self._values.text(pair[1])
        path = self._values.text(inner)
        self.file.includes.append(Include(path, values, self._span(call)))

    def _process(self, call: Call) -> None:
        words = call.get("cmd", default=())
        texts = [self._values.text(item) for item in words] if isinstance(words, list) else []
        text = " ".join(item if item is not None else "…" for item in texts)
        self.file.commands.append(Command(text, self._span(call)))

    def _command(self, call: Call) -> None:
        words = call.get("command", 0)
        text = self._values.begin(words)
        wrapped = id(call) in self._wrapped
        self.file.commands.append(Command(text, self._span(call), True, wrapped))

    def _open(self, call: Call) -> None:
        path = self._values.text(call.get("file", 0))
        if path is not None:
            self.file.opened.add(path)

    def _run(self, call: Call) -> None:
        """Take ``subprocess.run(["xacro", …])`` for what it is."""
        words = call.get("args", 0)
        if call.function.startswith("subprocess.") and isinstance(words, list):
            texts = [self._values.text(item) for item in words]
            text = " ".join(item if item is not None else "…" for item in texts)
            self.file.commands.append(Command(text, self._span(call)))

    def _process_file(self, call: Call) -> None:
        path = self._values.text(call.get("input_file_name", 0))
        mappings = call.get("mappings", default={})
        if path is None or not isinstance(mappings, dict):
            return
        pairs = ((key, self._values.text(value)) for key, value in mappings.items())
        words = " ".join(f"{key}:={value}" for key, value in pairs if value is not None)
        self.file.commands.append(Command(f"xacro {path} {words}", self._span(call)))

    def _node(self, call: Call) -> None:
        words = call.get("arguments", default=[])
        texts = [self._values.text(item) for item in words] if isinstance(words, list) else [None]
        self.file.nodes.append(
            LaunchedNode(
                self._values.text(call.get("package")),
                self._values.text(call.get("executable", default=call.get("node_executable"))),
                self._values.text(call.get("name", default=call.get("node_name"))),
                self._values.text(call.get("namespace", default=call.get("node_namespace"))),
                self._parameters(call.get("parameters", default=[])),
                tuple(texts),
                self._span(call),
                self._places(call),
                self._remappings(call),
            )
        )
        self._take_keywords(call)

    def _remappings(self, call: Call) -> tuple[tuple[str, str], ...] | None:
        namespace = call.get("namespace", default=call.get("node_namespace", default=""))
        rows = call.get("remappings", default=[])
        if self._values.text(namespace) is None or not isinstance(rows, list | tuple):
            return None
        pairs = []
        for row in rows:
            texts = [self._values.text(one) for one in row] if isinstance(row, list | tuple) else []
            known = [text for text in texts if text is not None]
            if len(known) != 2:
                return None
            pairs.append((known[0], known[1]))
        return tuple(pairs)

    def _take_keywords(self, call: Call) -> None:
        # The whole launch system comes with it, which a look at a robot does not need.
        from gazelle.launch.ros2.launch_ros import actions
        from gazelle.launch.ros2.launch_ros.actions.node_keywords import unknown_keywords

        kind: type = getattr(actions, call.name, actions.Node)
        names = [name for name in call.keywords if name not in _OLD_KEYWORDS]
        places: dict[str | None, ast.expr | ast.keyword] = {
            one.arg: one for one in call.node.keywords
        }
        for name, hint in unknown_keywords(kind, names):
            at = places.get(name, call.node)
            span = SourceSpan(str(self.file.path), at.lineno, at.col_offset + 1, len(name))
            self.file.unknown_keywords.append(UnknownKeyword(call.name, name, span, hint))

    def _places(self, call: Call) -> dict[str, SourceSpan]:
        """Return where each text stands that a call is given."""
        found = [
            node
            for node in ast.walk(call.node)
            if isinstance(node, ast.Constant) and isinstance(node.value, str)
        ]
        file = str(self.file.path)
        return {
            text: SourceSpan(file, node.lineno, node.col_offset + 1, len(text) + 2)
            for node in reversed(found)
            if (text := str(node.value))
        }

    def _parameters(self, rows: Any) -> Parameters:
        values: dict[str, str | None] = {}
        files: list[str] = []
        complete = isinstance(rows, list | tuple)
        for row in rows if isinstance(rows, list | tuple) else ():
            if isinstance(row, dict):
                complete = complete and all(isinstance(key, str) for key in row)
                values |= {
                    key: self._values.text(v) for key, v in row.items() if isinstance(key, str)
                }
                continue
            if isinstance(row, Call) and row.name == "ParameterFile":
                row = row.get("param_file", 0)  # noqa: PLW2901
            text = self._values.text(row)
            if text is None:
                complete = False
            else:
                files.append(text)
        return Parameters(values, tuple(files), complete)


def _is_computed_use(node: ast.AST) -> bool:
    """Tell a ``LaunchConfiguration`` of a name that is not written out, and the like."""
    if isinstance(node, ast.Attribute):
        return node.attr == "launch_configurations"
    if not isinstance(node, ast.Call):
        return False
    called = node.func.attr if isinstance(node.func, ast.Attribute) else ast.unparse(node.func)
    given = [*node.args[:1], *(one.value for one in node.keywords if one.arg == "variable_name")]
    is_written = any(isinstance(one, ast.Constant) for one in given)
    return called == "LaunchConfiguration" and not is_written


def _given(call: Call) -> list[Any]:
    return [*call.arguments, *call.keywords.values()]


def _inside(value: Any, depth: int = 0) -> Iterator[Call]:
    """Yield the calls in a value, those in the arguments of calls too."""
    if depth > _MAX_DEPTH:
        return
    if isinstance(value, Call):
        yield value
    elif isinstance(value, list | tuple):
        for item in value:
            yield from _inside(item, depth + 1)
    elif isinstance(value, dict):
        yield from _inside(list(value.values()), depth + 1)
