"""What to type once a config package is written."""

from __future__ import annotations

from gazelle.motion.setup_assistant.config import SetupAssistantConfig

__all__ = ["next_steps"]


def next_steps(config: SetupAssistantConfig) -> list[str]:
    """Return commands with what they are for, a line each."""
    name = config.package_name
    launch = "gazelle roslaunch" if config.ros_version == 1 else "gazelle ros2 launch"
    demo, world = (
        ("demo.launch", "demo_gazebo.launch")
        if config.ros_version == 1
        else ("demo.launch.py", "gazebo.launch.py")
    )
    return [
        f"plan with it:   {launch} {name} {demo}",
        f"in Gazebo:      {launch} {name} {world}",
        f"look for slips: gazelle doctor {name}",
    ]
