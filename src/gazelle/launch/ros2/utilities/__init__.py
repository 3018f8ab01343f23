"""launch.utilities: small tools that users' own actions and substitutions need."""

from __future__ import annotations

from gazelle.launch.ros2.utilities import type_utils
from gazelle.launch.ros2.utilities.normalization import (
    ensure_argument_type,
    is_a,
    is_a_subclass,
    isclassinstance,
    normalize_to_list_of_entities,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    visit_all_entities_and_collect_futures,
)
from gazelle.launch.ros2.utilities.signals import (
    AsyncSafeSignalManager,
    create_future,
    install_signal_handlers,
    on_sigint,
    on_sigquit,
    on_sigterm,
)

__all__ = [
    "AsyncSafeSignalManager",
    "create_future",
    "ensure_argument_type",
    "install_signal_handlers",
    "is_a",
    "is_a_subclass",
    "isclassinstance",
    "normalize_to_list_of_entities",
    "normalize_to_list_of_substitutions",
    "on_sigint",
    "on_sigquit",
    "on_sigterm",
    "perform_substitutions",
    "type_utils",
    "visit_all_entities_and_collect_futures",
]
