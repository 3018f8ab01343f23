"""Every argument that a drop-in takes is read, told of, or named here with the reason."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import gazelle.compat

ROOT = Path(gazelle.compat.__file__).parent

_SOCKETS = (
    "sockets are not what messages travel by here, so their buffers and delays change nothing"
)
_HOOK = "a hook that the user's class overrides; its own answer does not depend on it"
_LOCAL = "the original's own machinery, for which nothing here waits or searches"
_FINDER = "Python's import system calls it so"
_SAME = "the answer is the same whatever is said, in the original as well or by its documentation"

# What is taken and never read: file and function, arguments, why that misleads nobody.
UNREAD: dict[str, tuple[str, str]] = {
    "actionlib/server.py nop_cb": ("goal_handle", _HOOK),
    "rosbag.py Bag.__init__": ("allow_unindexed skip_index", "bags are read with or without"),
    "command_modules/rosnode.py get_api_uri": ("skip_cache", "nothing is kept"),
    "command_modules/rosnode.py rosnode_ping": ("max_count skip_cache", "one look is an answer"),
    "command_modules/rosnode.py rosnode_ping_all": ("skip_cache", "nothing is kept"),
    "command_modules/rostopic.py get_topic_list": (
        "master",
        "it tells itself when it was of another graph",
    ),
    "diagnostic_updater/tasks.py DiagnosticTaskVector.addedTaskCallback": ("task", _HOOK),
    "dynamic_reconfigure/parameter_generator.py ParameterGenerator.generate": (
        "nodename",
        "the module is found in the package that the file is in",
    ),
    "genpy_message.py strify_message": ("current_time", _SAME),
    "import_hooks.py Loader.create_module": ("spec", _FINDER),
    "import_hooks.py TranslatingLoader.source_to_code": ("_optimize", _FINDER),
    "moveit/commander/move_group.py MoveGroupCommander.retime_trajectory": (
        "ref_state_in",
        "the group's joints are all in the trajectory",
    ),
    "moveit/commander/scene.py PlanningSceneInterface.__init__": (
        "synchronous service_timeout",
        "what is asked for at leisure is there at once as well, and who is not answered hears so",
    ),
    "moveit/py/planning.py MoveItPy.execute": ("group_name", "the trajectory knows its joints"),
    "moveit/py/robot.py RobotState.update": ("force category", "poses follow positions at once"),
    "rclpy/action/server.py default_cancel_callback": ("cancel_request", _HOOK),
    "rclpy/action/server.py default_goal_callback": ("goal_request", _HOOK),
    "rclpy/callback_groups.py CallbackGroup.beginning_execution": ("entity", _HOOK),
    "rclpy/callback_groups.py CallbackGroup.can_execute": ("entity", _HOOK),
    "rclpy/callback_groups.py CallbackGroup.ending_execution": ("entity", _HOOK),
    "rclpy/callback_groups.py MutuallyExclusiveCallbackGroup.can_execute": ("entity", _SAME),
    "rclpy/init_shutdown.py shutdown": ("uninstall_handlers", "they only pass signals on then"),
    "rclpy/clock.py ROSClock.__new__": ("clock_type", "__init__ reads it"),
    "rclpy/publisher_subscription_service.py Publisher.wait_for_all_acked": (
        "timeout",
        "what was sent needs no word back",
    ),
    "rclpy/lifecycle/entities.py ManagedEntity.on_activate": ("state", _HOOK),
    "rclpy/lifecycle/entities.py ManagedEntity.on_cleanup": ("state", _HOOK),
    "rclpy/lifecycle/entities.py ManagedEntity.on_configure": ("state", _HOOK),
    "rclpy/lifecycle/entities.py ManagedEntity.on_deactivate": ("state", _HOOK),
    "rclpy/lifecycle/entities.py ManagedEntity.on_error": ("state", _HOOK),
    "rclpy/lifecycle/entities.py ManagedEntity.on_shutdown": ("state", _HOOK),
    "rclpy/lifecycle/entities.py SimpleManagedEntity.on_activate": ("state", _HOOK),
    "rclpy/lifecycle/entities.py SimpleManagedEntity.on_deactivate": ("state", _HOOK),
    "rclpy/logging.py set_logger_level": ("detailed_error", "setting a level does not fail here"),
    "rclpy/node.py Node.get_publisher_names_and_types_by_node": (
        "no_demangle",
        _SAME,
    ),
    "rclpy/node.py Node.get_subscriber_names_and_types_by_node": (
        "no_demangle",
        _SAME,
    ),
    "rclpy/node.py Node.get_topic_names_and_types": ("no_demangle", _SAME),
    "unsupported/modules.py UnsupportedModuleFinder.find_spec": ("path target", _FINDER),
    "rosgraph/masterapi.py Master.__init__": ("caller_id", "the graph knows who asks"),
    "roslaunch/core.py ProcessListener.process_died": ("process_name exit_code", _HOOK),
    "roslaunch/parent.py ROSLaunchParent.__init__": (
        "local_only is_rostest num_workers timeout master_logger_level",
        _LOCAL,
    ),
    "roslaunch/rlutil.py configure_logging": ("run_id", "every launch writes its own log"),
    "roslib.py get_message_class": ("reload_on_error", _LOCAL),
    "roslib.py get_service_class": ("reload_on_error", _LOCAL),
    "roslib.py load_manifest": (
        "package_name bootstrap_version",
        "packages are importable already",
    ),
    "rospy/client.py get_master": ("env", _SAME),
    "rospy/names.py remap_name": ("resolved", _SAME),
    "rospy/names.py valid_name_validator_unresolved": ("caller_id", _SAME),
    "rospy/services.py Service.__init__": ("buff_size", _SOCKETS),
    "rospy/services.py ServiceProxy.__init__": ("persistent", _SOCKETS),
    "rospy/topics.py Publisher.__init__": ("tcp_nodelay", _SOCKETS),
    "rospy/topics.py SubscribeListener.peer_subscribe": (
        "topic_name topic_publish peer_publish",
        _HOOK,
    ),
    "rospy/topics.py SubscribeListener.peer_unsubscribe": ("topic_name num_peers", _HOOK),
    "rospy/topics.py Subscriber.__init__": ("buff_size tcp_nodelay", _SOCKETS),
    "tf/listener_and_broadcasters.py TransformListener.__init__": (
        "buff_size tcp_nodelay queue_size spin_thread qos static_qos",
        "frames are taken as they come, in a thread of their own, from ends of any quality",
    ),
    "tf/matrices.py superimposition_matrix": ("usesvd", _SAME),
    "tf/tf1.py Transformer.__init__": ("interpolate", _SAME),
    "tf/tf1.py Transformer.chain": ("target_time source_time fixed_frame", _SAME),
    "tf/tf1.py Transformer.setUsingDedicatedThread": ("value", "frames always have a thread"),
    "tf/tf1.py Transformer.waitForTransform": ("polling_sleep_duration", "nothing is polled"),
    "tf/tf1.py Transformer.waitForTransformFull": ("polling_sleep_duration", "nothing is polled"),
    "urdf_parser_py/xml_reflection.py AggregateElement.set_default": ("obj", _HOOK),
    "urdf_parser_py/value_types.py RawType.from_xml": ("path", _HOOK),
    "urdf_parser_py/value_types.py SimpleElementType.from_xml": ("path", _HOOK),
    "urdf_parser_py/value_types.py ValueType.from_xml": ("path", _HOOK),
}

# What Python calls by these names has arguments that are Python's.
_PYTHON = frozenset({"__exit__", "__get__", "__set_name__", "__aexit__"})


def _public(body: list[ast.stmt], above: str = "") -> Iterator[tuple[str, ast.FunctionDef]]:
    """Give the functions and methods that a user can name."""
    for one in body:
        match one:
            case ast.ClassDef(name=name) if not name.startswith("_"):
                yield from _public(one.body, f"{above}{name}.")
            case ast.FunctionDef(name=name) if name.startswith("__") or not name.startswith("_"):
                if name not in _PYTHON and (name.endswith("__") or not name.startswith("__")):
                    yield f"{above}{name}", one
            case ast.If():
                yield from _public([*one.body, *one.orelse], above)


def _refuses(function: ast.FunctionDef) -> bool:
    """Tell whether a function does nothing but raise."""
    work = [one for one in function.body if not isinstance(one, ast.Expr)]
    return bool(work) and all(isinstance(one, ast.Raise) for one in work)


def _unread(function: ast.FunctionDef) -> list[str]:
    given = function.args
    names = [one.arg for one in (*given.posonlyargs, *given.args)]
    if function.name != "__new__" or names[:1] != ["cls"]:
        names = [name for name in names if name != "self"]
    names = [name for name in names if name != "cls"]
    if given.vararg:
        names.append(given.vararg.arg)
    names += [one.arg for one in given.kwonlyargs]
    if given.kwarg:
        names.append(given.kwarg.arg)
    read = {
        one.id
        for line in function.body
        for one in ast.walk(line)
        if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Load)
    }
    return [name for name in names if name not in read]


def unread_arguments(text: str) -> dict[str, list[str]]:
    """Return what public functions of a module take and never read; `del` is no reading."""
    found = {}
    for name, function in _public(ast.parse(text).body):
        names = [] if _refuses(function) else _unread(function)
        if names:
            found[name] = names
    return found


def test_every_argument_of_a_drop_in_is_read_or_has_a_reason_not_to_be() -> None:
    found = {
        f"{file.relative_to(ROOT)} {name}": " ".join(names)
        for file in sorted(ROOT.rglob("*.py"))
        for name, names in unread_arguments(file.read_text(encoding="utf-8")).items()
    }
    assert found == {name: arguments for name, (arguments, _reason) in UNREAD.items()}


def test_argument_that_is_deleted_or_swallowed_is_found() -> None:
    text = """
class Node:
    def __init__(self, name, *, qos=None, **_options):
        del qos
        self.name = name
    def stop(self, reason):
        raise NotImplementedError
    def _inner(self, unused):
        pass
def load(name):
    '''Do nothing.'''
"""
    assert unread_arguments(text) == {"Node.__init__": ["qos", "_options"], "load": ["name"]}
