"""``launch_test``: tests of ROS 2 beside and after a launch."""

from __future__ import annotations

from gazelle.cli.ros2.launch import prepare_launch_environment

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run the tests of a file with a ``generate_test_description``."""
    prepare_launch_environment()
    from gazelle.launch.ros2.launch_testing.launch_test import main as run_tests

    return run_tests(argv)
