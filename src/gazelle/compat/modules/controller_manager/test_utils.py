"""Drop-in for controller_manager.test_utils."""

from gazelle.compat.controller_manager_checks import (
    check_controllers_running,
    check_if_js_published,
    check_node_running,
)

__all__ = ["check_controllers_running", "check_if_js_published", "check_node_running"]
