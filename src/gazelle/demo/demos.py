"""The table of demos, in the order in which a newcomer might look at them."""

from __future__ import annotations

from gazelle.demo.demo import Demo, Panel, Step
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError

__all__ = ["DEMOS", "find_demo"]

_KEYS_ROS1 = "gazelle rosrun teleop_twist_keyboard teleop_twist_keyboard.py"
_KEYS_ROS2 = "gazelle ros2 run teleop_twist_keyboard teleop_twist_keyboard"


def find_demo(name: str) -> Demo:
    """Return a demo by its name.

    Raises:
        NotFoundError: there is none of this name; holds the nearest names.
    """
    for demo in DEMOS:
        if demo.name == name:
            return demo
    names = [demo.name for demo in DEMOS]
    raise NotFoundError(
        "demo", name, nearest=nearest_names(name, names), hint=f"demos: {', '.join(names)}"
    )


DEMOS: tuple[Demo, ...] = (
    Demo(
        name="scout",
        title="A robot with lidar and camera",
        summary="Two wheels, a lidar, a depth camera and an IMU in a workshop.",
        ros_version=1,
        workspace="scout_ws",
        packages=("scout_robot",),
        launch=("roslaunch", "scout_robot", "scout.launch"),
        sign="/scan",
        seen=(
            "An orange robot stands in a room of 8 m by 6 m, with a crate and a barrel that it can",
            "push and a ball that it cannot.",
        ),
        try_next=(
            Step("drive it with the keys w a s d x", "gazelle rosrun scout_robot scout_teleop.py"),
            Step(
                "or let it drive a circle by itself",
                "gazelle rostopic pub -r 10 /cmd_vel geometry_msgs/Twist "
                "'{linear: {x: 0.3}, angular: {z: 0.5}}'",
            ),
            Step("see what the lidar measures", "gazelle rostopic echo -n 1 /scan"),
            Step("draw a map while it drives", "gazelle roslaunch scout_robot map.launch"),
        ),
        panels=(Panel("gazebo"), Panel("rqt_image_view", {"topic": "/camera/rgb/image_raw"})),
    ),
    Demo(
        name="four_wheels",
        title="A four-wheeler from YAML files",
        summary="Wheels and head under ros_control; the controllers are three YAML files.",
        ros_version=1,
        workspace="four_wheel_ws",
        packages=("courier_robot",),
        launch=("roslaunch", "courier_robot", "courier.launch"),
        sign="/diff_drive_controller/odom",
        seen=("A four-wheeled robot with a head that turns, on open ground.",),
        try_next=(
            Step(
                "drive it with the keys i j k l ,",
                f"{_KEYS_ROS1} cmd_vel:=/diff_drive_controller/cmd_vel",
            ),
            Step(
                "turn its head, rad",
                "gazelle rostopic pub -1 /head_controller/command std_msgs/Float64 0.8",
            ),
            Step("list its controllers", "gazelle controller_manager list"),
            Step("read one of the files", "gazelle rosparam get /diff_drive_controller"),
        ),
        panels=(
            Panel("gazebo"),
            Panel("rqt_robot_steering", {"topic": "/diff_drive_controller/cmd_vel"}),
        ),
    ),
    Demo(
        name="arm",
        title="An arm that picks and places",
        summary="Six joints and a gripper under MoveIt; a cube is carried over a wall.",
        ros_version=2,
        workspace="arm_ws",
        packages=("heron_bringup", "heron_description", "heron_moveit_config"),
        launch=("ros2", "launch", "heron_bringup", "heron.launch.py"),
        sign="/joint_states",
        seen=(
            "An arm at its workbench. As soon as MoveIt is up it grips the cube, carries it over",
            "the wall and puts it down there.",
        ),
        try_next=(
            Step(
                "put everything back", "gazelle ros2 service call /reset_world std_srvs/srv/Empty"
            ),
            Step("and let it work again", "gazelle ros2 run heron_bringup pick_and_place"),
            Step(
                "plan motions with the mouse",
                'gazelle rviz2 -d "$(gazelle rospack find heron_moveit_config)/config/moveit.rviz"',
            ),
            Step("see the joints", "gazelle ros2 topic echo --once /joint_states"),
        ),
        programs=(("ros2", "run", "heron_bringup", "pick_and_place"),),
    ),
    Demo(
        name="plugin",
        title="A Gazebo plug-in in Python",
        summary="Balloons in the wind: a world, a model and a sensor plug-in, 300 lines of Python.",
        ros_version=1,
        workspace="own_plugin_ws",
        packages=("gust_plugins",),
        launch=("roslaunch", "gust_plugins", "gust.launch"),
        sign="/clock",
        seen=("Two balloons; the wind carries one faster than the other.",),
        try_next=(
            Step("see who leads", "gazelle rostopic echo /leader"),
            Step(
                "give the slow one a storm",
                "gazelle rostopic pub -1 /slow/wind geometry_msgs/Vector3 '{x: 8.0}'",
            ),
            Step("hear who is shaken by it", "gazelle rostopic echo /slow/alarm"),
        ),
    ),
    Demo(
        name="controller",
        title="A controller in Python",
        summary="Two wheels under a controller written in Python, as for the PR2.",
        ros_version=1,
        workspace="pr2_style_ws",
        packages=("tandem_controller",),
        launch=("roslaunch", "tandem_controller", "robot.launch"),
        sign="/joint_states",
        seen=("Two broad wheels, one behind the other; a PID written in Python turns them.",),
        try_next=(
            Step(
                "let it roll 3 rad of its wheels",
                "gazelle rostopic pub -1 /tandem_controller/command std_msgs/Float64 3.0",
            ),
            Step("list the controllers", "gazelle controller_manager list"),
            Step("change the gains while it runs", "gazelle rqt_reconfigure"),
        ),
    ),
)
