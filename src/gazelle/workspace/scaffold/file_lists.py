"""Which files a new package has, and the templates they are written from."""

from __future__ import annotations

__all__ = ["FILES"]

_ROBOT = {
    "urdf/inertia.xacro": "robot/inertia.xacro",
    "urdf/@name@.urdf.xacro": "robot/robot.urdf.xacro",
    "worlds/@name@.world": "world/world.sdf",
}
_WORLD = {"worlds/@name@.world": "world/world.sdf"}
_PYTHON = {
    "setup.cfg": "ros2/setup.cfg",
    "resource/@name@": "ros2/empty",
    "@name@/__init__.py": "ros2/empty",
}

FILES: dict[tuple[str, int], dict[str, str]] = {
    ("robot", 1): {
        "package.xml": "ros1/package_robot.xml",
        "CMakeLists.txt": "ros1/CMakeLists_robot.txt",
        "config/@name@.yaml": "ros1/robot.yaml",
        "launch/@name@.launch": "ros1/robot.launch",
        "scripts/wander.py": "ros1/wander.py",
        "urdf/gazebo.xacro": "ros1/gazebo.xacro",
        **_ROBOT,
    },
    ("robot", 2): {
        "package.xml": "ros2/package_robot.xml",
        "setup.py": "ros2/setup_robot.py",
        "config/@name@.yaml": "ros2/robot.yaml",
        "launch/@name@.launch.py": "ros2/robot.launch.py",
        "@name@/wander.py": "ros2/wander.py",
        "urdf/gazebo.xacro": "ros2/gazebo.xacro",
        **_PYTHON,
        **_ROBOT,
    },
    ("world", 1): {
        "package.xml": "ros1/package_world.xml",
        "CMakeLists.txt": "ros1/CMakeLists_world.txt",
        "launch/@name@.launch": "ros1/world.launch",
        **_WORLD,
    },
    ("world", 2): {
        "package.xml": "ros2/package_world.xml",
        "setup.py": "ros2/setup_world.py",
        "launch/@name@.launch.py": "ros2/world.launch.py",
        **_PYTHON,
        **_WORLD,
    },
    ("package", 1): {
        "package.xml": "ros1/package_package.xml",
        "CMakeLists.txt": "ros1/CMakeLists_package.txt",
        "config/@name@.yaml": "ros1/package.yaml",
        "launch/@name@.launch": "ros1/package.launch",
        "scripts/hello.py": "ros1/hello.py",
    },
    ("package", 2): {
        "package.xml": "ros2/package_package.xml",
        "setup.py": "ros2/setup_package.py",
        "config/@name@.yaml": "ros2/package.yaml",
        "launch/@name@.launch.py": "ros2/package.launch.py",
        "@name@/hello.py": "ros2/hello.py",
        **_PYTHON,
    },
}
"""Path in the package → template, by kind and generation of ROS; ``@name@`` is the package."""
