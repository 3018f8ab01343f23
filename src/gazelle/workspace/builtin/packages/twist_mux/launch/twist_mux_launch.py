"""Choosing among velocity commands, with the joystick's relay."""

from gazelle.launch.ros2.builtin_launch_files import twist_mux


def generate_launch_description():
    """Return the arguments and the three nodes."""
    return twist_mux()
