"""launch, by Gazelle: the classes of `gazelle.launch.ros2` at the paths that ROS 2 has them."""

import sys as _sys

from gazelle.launch.ros2 import *  # noqa: F403
from gazelle.launch.ros2 import (
    action,
    actions,
    condition,
    conditions,
    descriptions,
    event,
    event_handler,
    event_handlers,
    events,
    frontend,
    invalid_launch_file_error,
    launch_context,
    launch_description,
    launch_description_entity,
    launch_description_source,
    launch_description_sources,
    launch_introspector,
    launch_service,
    logging,
    substitution,
    substitutions,
    utilities,
)
from gazelle.launch.ros2.events import process as _process
from gazelle.launch.ros2.frontend import entity as _frontend_entity
from gazelle.launch.ros2.frontend import expose as _expose
from gazelle.launch.ros2.frontend import parse_substitution as _parse_substitution
from gazelle.launch.ros2.frontend import parser as _parser
from gazelle.launch.ros2.frontend import type_utils as _frontend_type_utils
from gazelle.launch.ros2.launch_description_sources import sources as _sources
from gazelle.launch.ros2.logging import handlers as _handlers
from gazelle.launch.ros2.utilities import type_utils as _type_utils

# The original has a module per class; users import from those too.
_ACTIONS = (
    "append_environment_variable",
    "declare_launch_argument",
    "emit_event",
    "execute_local",
    "execute_process",
    "for_loop",
    "group_action",
    "include_launch_description",
    "log",
    "log_info",
    "opaque_coroutine",
    "opaque_function",
    "pop_environment",
    "pop_launch_configurations",
    "push_environment",
    "push_launch_configurations",
    "register_event_handler",
    "reset_environment",
    "reset_launch_configurations",
    "set_environment_variable",
    "set_launch_configuration",
    "shutdown_action",
    "timer_action",
    "unregister_event_handler",
    "unset_environment_variable",
    "unset_launch_configuration",
)
_SUBSTITUTIONS = (
    "anon_name",
    "boolean_substitution",
    "command",
    "environment_variable",
    "equals_substitution",
    "file_content",
    "find_executable",
    "for_loop_var",
    "if_else_substitution",
    "launch_configuration",
    "launch_log_dir",
    "local_substitution",
    "not_equals_substitution",
    "path_join_substitution",
    "path_substitution",
    "python_expression",
    "string_join_substitution",
    "substitution_failure",
    "text_substitution",
    "this_launch_file",
    "this_launch_file_dir",
)
_CONDITIONS = (
    "evaluate_condition_expression_impl",
    "if_condition",
    "invalid_condition_expression_error",
    "launch_configuration_equals",
    "launch_configuration_not_equals",
    "unless_condition",
)
_EVENT_HANDLERS = (
    "event_named",
    "on_action_event_base",
    "on_execution_complete",
    "on_include_launch_description",
    "on_process_exit",
    "on_process_io",
    "on_process_start",
    "on_shutdown",
)
_EVENTS = (
    "execution_complete",
    "include_launch_description",
    "matchers",
    "shutdown",
    "timer_event",
)
_PROCESS_EVENTS = (
    "process_exited",
    "process_io",
    "process_matchers",
    "process_started",
    "process_stderr",
    "process_stdin",
    "process_stdout",
    "process_targeted_event",
    "running_process_event",
    "shutdown_process",
    "signal_process",
)
_UTILITIES = (
    "class_tools_impl",
    "create_future_impl",
    "ensure_argument_type_impl",
    "normalize_to_list_of_entities_impl",
    "normalize_to_list_of_substitutions_impl",
    "perform_substitutions_impl",
    "signal_management",
    "visit_all_entities_and_collect_futures_impl",
)
_SOURCES = (
    "any_launch_description_source",
    "frontend_launch_description_source",
    "python_launch_description_source",
)
_FILES = (
    "any_launch_file_utilities",
    "frontend_launch_file_utilities",
    "python_launch_file_utilities",
)

_sys.modules.update(
    {
        f"{__name__}.{_name}": _module
        for _name, _module in {
            "action": action,
            "actions": actions,
            "condition": condition,
            "conditions": conditions,
            "descriptions": descriptions,
            "descriptions.executable": descriptions,
            "event": event,
            "event_handler": event_handler,
            "event_handlers": event_handlers,
            "events": events,
            "events.process": _process,
            "frontend": frontend,
            "frontend.entity": _frontend_entity,
            "frontend.expose": _expose,
            "frontend.parse_substitution": _parse_substitution,
            "frontend.parser": _parser,
            "frontend.type_utils": _frontend_type_utils,
            "invalid_launch_file_error": invalid_launch_file_error,
            "launch_context": launch_context,
            "launch_description": launch_description,
            "launch_description_entity": launch_description_entity,
            "launch_description_source": launch_description_source,
            "launch_description_sources": launch_description_sources,
            "launch_introspector": launch_introspector,
            "launch_service": launch_service,
            "logging": logging,
            "logging.handlers": _handlers,
            "some_actions_type": launch_description_entity,
            "some_entities_type": launch_description_entity,
            "some_substitutions_type": substitution,
            "substitution": substitution,
            "substitutions": substitutions,
            "utilities": utilities,
            "utilities.type_utils": _type_utils,
            **{f"actions.{_one}": actions for _one in _ACTIONS},
            **{f"conditions.{_one}": conditions for _one in _CONDITIONS},
            **{f"event_handlers.{_one}": event_handlers for _one in _EVENT_HANDLERS},
            **{f"events.{_one}": events for _one in _EVENTS},
            **{f"events.process.{_one}": _process for _one in _PROCESS_EVENTS},
            **{f"launch_description_sources.{_one}": _sources for _one in _SOURCES},
            **{f"launch_description_sources.{_one}": _sources for _one in _FILES},
            **{f"substitutions.{_one}": substitutions for _one in _SUBSTITUTIONS},
            **{f"utilities.{_one}": utilities for _one in _UTILITIES},
        }.items()
    }
)
for _name in list(_sys.modules):
    _prefix, _, _rest = _name.partition(".")
    if _prefix == __name__ and _rest and "." not in _rest:
        globals()[_rest] = _sys.modules[_name]
