"""The table of demos, in the order in which a newcomer might look at them."""

from __future__ import annotations

from gazelle.demo.demo import Demo, Panel, Step
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError

__all__ = ["DEMOS", "find_demo"]

# The robot is the model after the ground.
_ROLLED_TO = "/gazebo/model_states/pose[1]/position/x"
_KEYS_ROS1 = "gazelle rosrun teleop_twist_keyboard teleop_twist_keyboard.py"
_KEYS_ROS2 = "gazelle ros2 run teleop_twist_keyboard teleop_twist_keyboard"


def _world(
    distance_m: float,
    *,
    focal_m: tuple[float, float, float] = (0.0, 0.0, 0.1),
    yaw_rad: float = -0.9,
    pitch_rad: float = 0.5,
    kind: str = "gazebo",
) -> Panel:
    """The world as Gazebo shows it, looked at from so far, so much to the side and from above.

    The kind ``gz`` is the view alone, without the tree of the world.
    """
    view = {"focal": list(focal_m), "distance": distance_m, "yaw": yaw_rad, "pitch": pitch_rad}
    return Panel(kind, {"view": view})


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
        panels=(
            _world(4.4, focal_m=(0.5, 0.0, 0.1), pitch_rad=0.6),
            Panel("rqt_image_view", {"topic": "/camera/rgb/image_raw"}),
        ),
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
            _world(2.4, focal_m=(0.0, 0.0, 0.2)),
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
        panels=(_world(1.6, focal_m=(0.25, 0.0, 0.25), yaw_rad=0.4, pitch_rad=0.45),),
    ),
    Demo(
        name="mapping",
        title="A robot that maps and drives",
        summary="SLAM and navigation at once: click a goal, the map grows on the way there.",
        ros_version=2,
        workspace="mapping_ws",
        packages=("surveyor_robot",),
        launch=("ros2", "launch", "surveyor_robot", "mapping.launch.py"),
        sign="/map",
        seen=(
            "A round robot in a flat of three rooms, and the map that it draws of what its lidar",
            "sees. In the page choose '2D Nav Goal', press at a place and drag into a direction.",
        ),
        try_next=(
            Step(
                "send it to a goal from here",
                "gazelle ros2 topic pub --once /goal_pose geometry_msgs/msg/PoseStamped "
                "'{header: {frame_id: map}, pose: {position: {x: 2.0, y: -0.6}, "
                "orientation: {w: 1.0}}}'",
            ),
            Step(
                "let it look for the unknown by itself",
                "gazelle ros2 run explore_lite explore --ros-args -p use_sim_time:=true "
                "-p costmap_topic:=map -p robot_base_frame:=base_footprint",
            ),
            Step("keep the map", "gazelle ros2 run nav2_map_server map_saver_cli -f my_map"),
        ),
        panels=(
            Panel("rviz", file="src/surveyor_robot/rviz/mapping.rviz"),
            _world(6.0, pitch_rad=0.9, kind="gz"),
        ),
    ),
    Demo(
        name="balancer",
        title="A robot that keeps its balance",
        summary="Two wheels under a controller of our own; it is pushed and stays up.",
        ros_version=2,
        workspace="balance_ws",
        packages=("balancer_robot",),
        launch=("ros2", "launch", "balancer_robot", "balancer.launch.py"),
        sign="/wheel_controller/commands",
        seen=(
            "A robot on two wheels keeps itself upright. Every eight seconds something pushes it,",
            "from behind and from the front in turns, and it rolls back to where it stood.",
        ),
        try_next=(
            Step("drive it with the keys i j k l ,", _KEYS_ROS2),
            Step(
                "push it harder", "gazelle ros2 run balancer_robot push --ros-args -p force:=70.0"
            ),
            Step(
                "stop its controller: it falls on its board",
                "gazelle ros2 control switch_controllers --deactivate wheel_controller",
            ),
            Step(
                "and start it again: it gets up",
                "gazelle ros2 control switch_controllers --activate wheel_controller",
            ),
        ),
        programs=(("ros2", "run", "balancer_robot", "push", "--ros-args", "-p", "every:=8.0"),),
        panels=(
            _world(2.9, focal_m=(0.0, 0.0, 0.4), pitch_rad=0.3),
            Panel("rqt_plot", {"curves": ["/imu/orientation/y"]}),
        ),
    ),
    Demo(
        name="turtles",
        title="Turtles that paint",
        summary="The turtles of ROS's first tutorial; three of them draw flowers.",
        ros_version=2,
        workspace="turtles_ws",
        packages=("turtle_painter",),
        launch=("ros2", "launch", "turtle_painter", "turtles.launch.py"),
        sign="/turtle1/pose",
        seen=("Three turtles draw flowers, each in its colour.",),
        try_next=(
            Step("steer one with the arrow keys", "gazelle ros2 run turtlesim turtle_teleop_key"),
            Step("wipe the canvas", "gazelle ros2 service call /clear std_srvs/srv/Empty"),
            Step(
                "call one more turtle",
                "gazelle ros2 service call /spawn turtlesim/srv/Spawn "
                "'{x: 8.0, y: 8.0, theta: 0.5, name: guest}'",
            ),
            Step("see who talks to whom", "gazelle rqt_graph"),
        ),
        panels=(Panel("turtlesim", {"node": "turtlesim"}),),
    ),
    Demo(
        name="playground",
        title="Things to push",
        summary="A little bulldozer among crates, balls and a row of dominoes.",
        ros_version=1,
        workspace="playground_ws",
        packages=("dozer_robot",),
        launch=("roslaunch", "dozer_robot", "playground.launch"),
        sign="/odom",
        seen=(
            "A little bulldozer among crates, balls and dominoes. Drive it with the sliders of the",
            "page, or let it knock the dominoes over.",
        ),
        try_next=(
            Step("knock the dominoes over", "gazelle rosrun dozer_robot knock.py"),
            Step("drive it with the keys i j k l ,", _KEYS_ROS1),
            Step("put everything back", "gazelle rosservice call /gazebo/reset_world"),
            Step("stop the time", "gazelle rosservice call /gazebo/pause_physics"),
        ),
        panels=(
            _world(6.0, focal_m=(0.5, 0.0, 0.1), yaw_rad=-2.2, pitch_rad=0.6),
            Panel("rqt_robot_steering", {"topic": "/cmd_vel"}),
        ),
    ),
    Demo(
        name="plugin",
        title="A Gazebo plug-in in Python",
        summary="Balloons in the wind: a world, a model and a sensor plug-in, 70 lines of Python.",
        ros_version=1,
        workspace="own_plugin_ws",
        packages=("gust_plugins",),
        launch=("roslaunch", "gust_plugins", "gust.launch"),
        sign="/leader",
        seen=("Two balloons in a wind that goes round; it blows harder at one of them.",),
        try_next=(
            Step("see who leads", "gazelle rostopic echo /leader"),
            Step(
                "give the slow one a storm",
                "gazelle rostopic pub -r 20 /slow/wind geometry_msgs/Vector3 '{x: 8.0}'",
            ),
            Step("hear who is shaken by it", "gazelle rostopic echo /slow/alarm"),
        ),
        programs=(("rosrun", "gust_plugins", "gusts.py"),),
        panels=(_world(11.0, focal_m=(0.0, 2.0, 1.5), pitch_rad=0.4),),
    ),
    Demo(
        name="controller",
        title="A controller in Python",
        summary="Two wheels under a controller written in Python, as for the PR2.",
        ros_version=1,
        workspace="pr2_style_ws",
        packages=("tandem_controller",),
        launch=("roslaunch", "tandem_controller", "robot.launch"),
        sign="/tandem_controller/pid_steer/parameter_updates",
        seen=(
            "Two broad wheels, one behind the other, roll to and fro; a PID in Python turns them.",
        ),
        try_next=(
            Step(
                "roll somewhere else, rad of its wheels",
                "gazelle rostopic pub -1 /tandem_controller/command std_msgs/Float64 8.0",
            ),
            Step("list the controllers", "gazelle controller_manager list"),
            Step("change the gains while it runs", "gazelle rqt_reconfigure"),
        ),
        programs=(("rosrun", "tandem_controller", "there_and_back.py"),),
        panels=(_world(2.2), Panel("rqt_plot", {"curves": [_ROLLED_TO]})),
    ),
)
