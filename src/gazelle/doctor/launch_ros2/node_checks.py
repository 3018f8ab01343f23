"""Nodes of a launch: executables, controllers that spawners name, one clock for all."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from pathlib import Path

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, nearest_names
from gazelle.doctor.launch_ros2.launch_file import LaunchedNode
from gazelle.doctor.launch_ros2.launch_tree import Followed, located
from gazelle.doctor.packages.dependency_checks import is_slip
from gazelle.doctor.packages.python_name_checks import check_names
from gazelle.doctor.packages.source import SourcePackage
from gazelle.doctor.parameters.controllers import controllers_in
from gazelle.doctor.parameters.parameter_file import layout_of, read_document
from gazelle.documents import read_text_limited
from gazelle.node_specs.registry import builtin_executables
from gazelle.node_specs.unavailable_packages import missing_node
from gazelle.workspace import Package, Workspace
from gazelle.workspace.entry_points import console_scripts
from gazelle.workspace.environment_paths import BUILTIN
from gazelle.workspace.static_python import parse_python

__all__ = [
    "check_clocks",
    "check_executables",
    "check_node_keywords",
    "check_programs",
    "check_spawners",
    "starts_simulator",
]

_SPAWNERS = frozenset({"spawner", "spawner.py"})
_SPAWNER_VALUES = frozenset(
    {"-c", "--controller-manager", "-p", "--param-file", "-n", "--namespace", "-t",
     "--controller-type", "--controller-manager-timeout", "--switch-timeout",
     "--service-call-timeout", "--controller-ros-args", "-u", "--load-only"}
)  # fmt: skip
# Nodes that stamp or compare times; others run on any clock.
_TIMED = frozenset(
    {
        "amcl", "async_slam_toolbox_node", "behavior_server", "bt_navigator", "cartographer_node",
        "controller_server", "ekf_node", "joint_state_publisher", "map_server", "move_group",
        "navsat_transform_node", "planner_server", "recoveries_server", "robot_state_publisher",
        "rviz2", "smoother_server", "sync_slam_toolbox_node", "ukf_node", "waypoint_follower",
    }
)  # fmt: skip
_SIMULATOR_PACKAGES = frozenset({"gazebo_ros", "ros_gz_sim", "ros_ign_gazebo"})
_SIMULATOR_WORDS = ("gazebo", "gzserver", "gz sim", "ign gazebo")
_CLOCK = "use_sim_time"
_ENTRY = "generate_launch_description"
_MAX_PARAMETER_FILES = 20


def check_executables(
    files: Sequence[Followed], workspace: Workspace, diagnostics: Diagnostics
) -> None:
    """Report executables that their package does not have."""
    for node in _nodes(files):
        package = workspace.packages.get(node.package or "")
        if package is None or node.executable is None:
            continue
        if package.is_builtin:
            _check_builtin(node, package, diagnostics)
        elif package.prefix is None:
            _check_own(node, package, diagnostics)


def check_node_keywords(files: Sequence[Followed], diagnostics: Diagnostics) -> None:
    """Report arguments that nodes do not take."""
    for item in files:
        for one in item.file.unknown_keywords:
            text = f"{one.action}() got an unexpected keyword argument '{one.name}'"
            diagnostics.report("launch_ros2.keyword", text, one.span, fix=one.hint)


def _configured(workspace: Workspace) -> tuple[str, ...]:
    """Return the controllers that parameter files of the user's packages configure."""
    names: dict[str, None] = {}
    for package in workspace.user_packages:
        files = sorted((package.path / "config").glob("*.yaml"))
        for path in files[:_MAX_PARAMETER_FILES]:
            document = read_document(path, Diagnostics())
            if document is not None:
                found = controllers_in(document, layout_of(document))
                names.update(dict.fromkeys(item.name for item in found))
    return tuple(names)


def check_programs(files: Sequence[Followed], diagnostics: Diagnostics) -> None:
    """Report names that a launch file's Python does not define, and one that returns nothing."""
    for item in files:
        path = item.file.path
        if path.suffix != ".py" or path.is_relative_to(BUILTIN):
            continue
        try:
            tree = parse_python(read_text_limited(path))
        except (OSError, SyntaxError, UnicodeDecodeError):
            continue  # told where it is read
        check_names(tree, str(path), diagnostics, code="launch_ros2.name")
        for node in tree.body:
            if isinstance(node, ast.FunctionDef) and node.name == _ENTRY and not _returns(node):
                text = f"{_ENTRY}() returns nothing: nothing is launched"
                span = SourceSpan(str(path), node.lineno, node.col_offset + 1)
                last = node.body[-1]
                made = isinstance(last, ast.Expr) and isinstance(last.value, ast.Call)
                fix = "write: return LaunchDescription([…])"
                if made:
                    span = SourceSpan(str(path), last.lineno, last.col_offset + 1)
                    fix = "write return before it"
                diagnostics.report("launch_ros2.returns-nothing", text, span, fix=fix)


def _returns(function: ast.FunctionDef) -> bool:
    return any(
        isinstance(node, ast.Return) and node.value is not None for node in ast.walk(function)
    )


def check_spawners(
    files: Sequence[Followed],
    parameter_files: Sequence[Path],
    workspace: Workspace,
    diagnostics: Diagnostics,
) -> None:
    """Report controllers that are spawned and configured nowhere.

    Robots name files of parameters, too. Where the launch has none, those of the workspace are
    looked at: a name that is a slip for one of them was to be that.
    """
    managers = [node for node in _nodes(files) if node.executable == "ros2_control_node"]
    if not all(node.parameters.is_complete for node in managers):
        return
    known: list[str] = []
    for path in parameter_files:
        document = read_document(path, Diagnostics())
        if document is not None:
            known += [item.name for item in controllers_in(document, layout_of(document))]
    spawned = [(node, name) for node in _nodes(files) for name in _spawned(node)]
    everywhere = _configured(workspace) if spawned and not known else ()
    for node, name in spawned:
        last = name.rpartition("/")[2]
        slip = next((one for one in everywhere if is_slip(last, one)), "")
        if slip and last not in everywhere:
            text = f"the spawner asks for controller '{name}', which no parameter file of the "
            text += f"workspace configures (The 'type' param was not defined for '{name}')"
            hint = f"did you mean '{slip}'?"
            diagnostics.report(
                "launch_ros2.controller-missing", text, node.place_of(name), fix=hint
            )
        if known and last not in known:
            text = f"the spawner asks for controller '{name}', which none of the parameter files "
            text += f"of this launch configures: they have {', '.join(dict.fromkeys(known))} "
            text += f"(The 'type' param was not defined for '{name}')"
            hint = did_you_mean(name, known)
            diagnostics.report(
                "launch_ros2.controller-missing", text, node.place_of(name), fix=hint
            )


def check_clocks(files: Sequence[Followed], diagnostics: Diagnostics) -> None:
    """Report nodes on the wall clock beside a simulator."""
    if not starts_simulator(files):
        return
    if any(_CLOCK in item.file.sets_parameters for item in files):
        return
    late = [node for node in _nodes(files) if _is_timed(node) and not _has_clock(node)]
    if not late:
        return
    names = list(dict.fromkeys(node.name or node.executable or "" for node in late))
    has, they_run = ("has", "it runs") if len(names) == 1 else ("have", "they run")
    text = f"a simulator is started, and {', '.join(names)} {has} no {_CLOCK} that is true: "
    text += f"{they_run} on the wall clock beside "
    text += "nodes on simulated time (Lookup would require extrapolation into the past)"
    fix = f"parameters=[…, {{'{_CLOCK}': True}}]"
    diagnostics.report("launch_ros2.clocks", text, late[0].span, fix=fix)


def starts_simulator(files: Sequence[Followed]) -> bool:
    """Tell whether a launch starts a simulator."""
    return any(_starts_simulator(item) for item in files)


def _nodes(files: Sequence[Followed]) -> Iterator[LaunchedNode]:
    for item in files:
        yield from item.file.nodes


def _check_builtin(node: LaunchedNode, package: Package, diagnostics: Diagnostics) -> None:
    known = [*builtin_executables(package.name), *package.executable_names]
    name = node.executable or ""
    absent = missing_node(package.name, name)
    if known and name not in known and (absent or nearest_names(name, known)):
        text = (
            f"package '{package.name}' has no executable '{name}' (executable '{name}' not found "
        )
        text += "on the libexec directory)"
        hint = absent or did_you_mean(name, known)
        diagnostics.report("launch_ros2.executable-missing", text, node.place_of(name), fix=hint)


def _check_own(node: LaunchedNode, package: Package, diagnostics: Diagnostics) -> None:
    source = SourcePackage(package)
    name = node.executable or ""
    known = set(_built(source)) | set(console_scripts(package.path))
    if source.build_type == "ament_python":
        is_there = name in known
    else:
        known |= {Path(item).name for item in _programs(source)}
        is_there = name in known
    if is_there or (not source.is_ros2) or _is_hidden(source):
        return
    text = f"package '{package.name}' has no executable '{name}' (executable '{name}' not found on "
    text += f"the libexec directory '…/lib/{package.name}')"
    files = package.find_executables(name)
    if files and name != files[0].name and files[0].name in known:
        text += f"; Gazelle takes '{files[0].name}'"
    elif files:
        text += f"; '{files[0].relative_to(package.path)}' is not installed to there"
    hint = did_you_mean(name, known)
    if not hint and known:
        hint = f"it has {', '.join(sorted(known)[:8])}"
    diagnostics.report("launch_ros2.executable-missing", text, node.place_of(name), fix=hint)


def _is_hidden(source: SourcePackage) -> bool:
    """Tell whether executables may come from commands that were not read."""
    if source.build_type == "ament_python":
        return source.setup is None or source.setup.error is not None
    rules = source.rules
    return rules is None or bool(rules.unread) or not all(rule.is_known for rule in rules.rules)


def _built(source: SourcePackage) -> Iterator[str]:
    if source.lists is not None:
        yield from source.lists.executables()


def _programs(source: SourcePackage) -> Iterator[str]:
    rules = source.rules
    for rule in rules.rules if rules is not None else ():
        if f"lib/{source.package.name}" not in rule.destination:
            continue
        if not rule.is_folder:
            yield rule.renamed or rule.source
            continue
        yield from (name for name in source.files if rule.target(name) is not None)


def _spawned(node: LaunchedNode) -> Iterator[str]:
    if node.package != "controller_manager" or node.executable not in _SPAWNERS:
        return
    is_value = False
    for word in node.arguments:
        if word is not None and not is_value and word and not word.startswith("-"):
            yield word.strip("/")
        is_value = word is None or word in _SPAWNER_VALUES


def _starts_simulator(item: Followed) -> bool:
    file = item.file
    if any(node.package in _SIMULATOR_PACKAGES for node in file.nodes):
        return True
    if any(use.name in _SIMULATOR_PACKAGES for use in file.packages):
        return True
    return any(
        command.text.startswith(_SIMULATOR_WORDS)
        for command in file.commands
        if not command.is_substitution
    )


def _is_timed(node: LaunchedNode) -> bool:
    return node.executable in _TIMED


def _has_clock(node: LaunchedNode) -> bool:
    parameters = node.parameters
    if not parameters.is_complete or "--ros-args" in node.arguments or None in node.arguments:
        return True
    if _CLOCK in parameters.values:
        value = parameters.values[_CLOCK]
        return value is None or value.lower() == "true"
    return any(_CLOCK in _text(located(path) or Path(path)) for path in parameters.files)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        # A file that is not there is told elsewhere; what it would say is not known.
        return _CLOCK
