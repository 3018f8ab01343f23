"""rostopic echo: the text of messages is that of ROS 1, byte for byte."""

from __future__ import annotations

import threading

import pytest

from gazelle.graph import Graph, Node, Publisher
from gazelle.interfaces import Time, ros1_message_type

_JOINTS = ["left_joint", "right_joint", "laser_joint"]


def _joint_state(stamp_ns: int):
    message = ros1_message_type("sensor_msgs/JointState")()
    message.header.stamp = Time(*divmod(stamp_ns, 1_000_000_000))
    message.name = list(_JOINTS)
    message.position = [0.0, 0.0, 0.0]
    return message


def _latched(robot: Node, topic: str, message) -> None:
    robot.create_publisher(topic, type(message), latch=True).publish(message)


def test_joint_state_is_that_of_ros(robot: Node, run, recorded) -> None:
    publisher = robot.create_publisher(
        "/joint_states", ros1_message_type("sensor_msgs/JointState"), latch=True
    )
    for _ in range(42):
        publisher.publish(_joint_state(1795226371_809584379))
    assert run("rostopic", "echo", "-n", "1", "/joint_states") == recorded("topic_echo_js")


def test_transforms_are_those_of_ros(robot: Node, run, recorded) -> None:
    real = recorded("topic_echo_tf")
    kind = ros1_message_type("geometry_msgs/TransformStamped")
    transforms = []
    for child, xyz, quat in (
        (
            "laser",
            (0.25, 0.0, 0.15),
            (0.034270798550482096, 0.10602051106179564, 0.14357217502739192, 0.9833474432563557),
        ),
        ("left_wheel", (0.0, 0.22, 0.0), (-0.707106771713121, 0.0, 0.0, 0.707106790659974)),
        ("right_wheel", (0.0, -0.22, 0.0), (-0.707106771713121, 0.0, 0.0, 0.707106790659974)),
    ):
        one = kind(child_frame_id=child)
        one.header.frame_id = "base_link"
        one.header.stamp = Time(1795226373, 109104156)
        move, turn = one.transform.translation, one.transform.rotation
        move.x, move.y, move.z = xyz
        turn.x, turn.y, turn.z, turn.w = quat
        transforms.append(one)
    _latched(robot, "/tf", ros1_message_type("tf2_msgs/TFMessage")(transforms=transforms))
    assert run("rostopic", "echo", "-n", "1", "/tf") == real


def test_plot_format_is_that_of_ros(robot: Node, run, recorded, when_heard) -> None:
    publisher = robot.create_publisher("/joint_states", ros1_message_type("sensor_msgs/JointState"))
    stamps = (1795226399_109122037, 1795226399_209131956)
    for _ in range(314):
        publisher.publish(_joint_state(0))
    when_heard("/joint_states", lambda: [publisher.publish(_joint_state(one)) for one in stamps])
    real = recorded("echo_csv")
    assert run("rostopic", "echo", "-n", "2", "-p", "/joint_states") == real


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("/scan/range_max", "10.0"),
        ("/scan/ranges", "[1.0, 2.5, inf]"),
        ("/scan/ranges[1]", "2.5"),
        ("/scan/ranges[-1]", "inf"),
        ("/scan/ranges[0:2]", "[1.0, 2.5]"),
        ("/scan/header/frame_id", '"laser"'),
        ("/scan/header/stamp", "\nsecs: 3\nnsecs:        50"),
    ],
)
def test_part_of_a_message_can_be_echoed(robot: Node, run, path: str, text: str) -> None:
    _latched(robot, "/scan", _scan())
    assert run("rostopic", "echo", "-n1", path).out == f"{text}\n---\n"


def _scan():
    message = ros1_message_type("sensor_msgs/LaserScan")()
    message.header.frame_id = "laser"
    message.header.stamp = Time(3, 50)
    message.range_max = 10.0
    message.ranges = [1.0, 2.5, float("inf")]
    return message


def test_field_of_each_item_of_a_slice(robot: Node, run) -> None:
    cloud = ros1_message_type("sensor_msgs/PointCloud")()
    point = ros1_message_type("geometry_msgs/Point32")
    cloud.points = [point(1.0, 2.0, 3.0), point(4.0, 5.0, 6.0)]
    _latched(robot, "/cloud", cloud)
    assert run("rostopic", "echo", "-n1", "/cloud/points[:]/x").out == "[1.0, 4.0]\n---\n"


def test_long_fields_can_be_left_out(robot: Node, run) -> None:
    _latched(robot, "/scan", _scan())
    lines = run("rostopic", "echo", "-n1", "--noarr", "--nostr", "/scan").out.splitlines()
    assert 'ranges: "<array type: float32, length: 3>"' in lines
    assert '  frame_id: "<string length: 5>"' in lines
    assert "range_max: 10.0" in lines
    part = run("rostopic", "echo", "-n1", "--noarr", "/scan/ranges").out
    assert part == '"<array type: float32, length: 3>"\n---\n'
    plot = run("rostopic", "echo", "-n1", "-p", "--noarr", "--nostr", "/scan").out
    assert plot.splitlines()[0] == (
        "%time,field.header.seq,field.header.stamp,field.angle_min,field.angle_max,"
        "field.angle_increment,field.time_increment,field.scan_time,field.range_min,field.range_max"
    )


def test_numbers_can_have_one_width_and_the_screen_be_cleared(robot: Node, run) -> None:
    _latched(robot, "/x", ros1_message_type("std_msgs/Float64")(data=1.23456))
    assert run("rostopic", "echo", "-n1", "-w4", "/x").out == "data: 1.23\n---\n"
    assert run("rostopic", "echo", "-n1", "-c", "/x").out == "\033[2J\033[;Hdata: 1.23456\n---\n"


def test_times_can_be_shown_relative_to_now(robot: Node, graph: Graph, run, pump) -> None:
    graph.parameters.set("/use_sim_time", True)
    clock = robot.create_publisher("/clock", "rosgraph_msgs/Clock", latch=True)
    message = clock.message_class()
    message.clock.sec = 1
    clock.publish(message)
    stamp = ros1_message_type("std_msgs/Time")(data=Time(3, 500_000_000))
    # Until the first /clock simulated time is 0.
    publisher = robot.create_publisher("/t", type(stamp))
    pump(lambda: publisher.publish(stamp))
    out = run("rostopic", "echo", "-n20", "--offset", "/t").out
    assert out.endswith("data: \n  secs: 2\n  nsecs: 500000000\n---\n")


def test_filter_chooses_messages(robot: Node, run, when_heard) -> None:
    kind = ros1_message_type("std_msgs/Int32")
    publisher = robot.create_publisher("/n", kind)
    when_heard("/n", lambda: [publisher.publish(kind(data=one)) for one in range(6)])
    out = run("rostopic", "echo", "-n2", "--filter", "m.data % 2 and topic == '/n'", "/n").out
    assert out == "data: 1\n---\ndata: 3\n---\n"


def test_a_bad_filter_is_one_error(robot: Node, run) -> None:
    _latched(robot, "/n", ros1_message_type("std_msgs/Int32")(data=1))
    broken = run("rostopic", "echo", "--filter", "m.data ==", "/n")
    assert broken.code == 1
    assert broken.err.startswith("ERROR: --filter 'm.data ==' is not a Python expression")
    failing = run("rostopic", "echo", "--filter", "m.dta == 1", "/n")
    assert failing.code == 1
    assert "AttributeError" in failing.err


def test_waits_for_a_topic_and_says_so(graph: Graph, robot: Node, run, monkeypatch) -> None:
    from gazelle.cli.rostopic import topics

    robot.create_publisher("/scan", "sensor_msgs/LaserScan")
    advise = topics._advice

    def appear(entities, word):
        _latched(robot, "/scn", ros1_message_type("std_msgs/String")(data="here"))
        return advise(entities, word)

    monkeypatch.setattr(topics, "_advice", appear)
    found = run("rostopic", "echo", "-n1", "/scn")
    assert found.out == 'data: "here"\n---\n'
    assert found.err == (
        "WARNING: topic [/scn] does not appear to be published yet\n  did you mean '/scan'?\n"
    )


@pytest.fixture
def warned(graph: Graph, monkeypatch) -> threading.Event:
    """Set when the command has warned, which it does at once in simulated time."""
    from gazelle.cli.rostopic import echo

    warned = threading.Event()

    def say(*words, **options) -> None:
        print(*words, **options)
        warned.set()

    monkeypatch.setattr(echo, "_SIM_TIME_S", 0.0)
    monkeypatch.setattr(echo, "print", say, raising=False)
    graph.parameters.set("/use_sim_time", True)
    return warned


def test_a_topic_without_publisher_is_told_for_what_it_is(
    graph: Graph, robot: Node, run, pump, warned
) -> None:
    kind = ros1_message_type("std_msgs/String")
    robot.create_publisher("/clock", ros1_message_type("rosgraph_msgs/Clock"))
    robot.create_subscription("/chat", kind, lambda message: None)
    publishers: list[Publisher] = []

    def publish() -> bool:
        if warned.is_set() and not publishers:
            publishers.append(robot.create_publisher("/chat", kind))
        return bool(publishers) and publishers[0].publish(kind(data="late"))

    pump(publish)
    found = run("rostopic", "echo", "-n1", "/chat")
    assert found.err == "WARNING: no messages received: nobody publishes /chat.\n"


def test_a_publisher_that_is_silent_while_time_passes_is_named(
    robot: Node, run, pump, warned
) -> None:
    kind = ros1_message_type("std_msgs/String")
    robot.create_publisher("/clock", ros1_message_type("rosgraph_msgs/Clock"))
    publisher = robot.create_publisher("/chat", kind)
    pump(lambda: warned.is_set() and publisher.publish(kind(data="late")))
    found = run("rostopic", "echo", "-n1", "/chat")
    assert found.err == "WARNING: no messages received yet from /robot.\n"


def test_warns_when_nothing_comes_in_simulated_time(
    graph: Graph, robot: Node, run, pump, warned
) -> None:
    kind = ros1_message_type("std_msgs/String")
    publisher = robot.create_publisher("/chat", kind)
    pump(lambda: warned.is_set() and publisher.publish(kind(data="late")))
    found = run("rostopic", "echo", "-n1", "/chat")
    assert found.out == 'data: "late"\n---\n'
    assert found.err == (
        "WARNING: no messages received and simulated time is active.\nIs /clock being published?\n"
    )


def test_log_messages_have_the_fields_of_ros1(graph: Graph, run, when_heard) -> None:
    talker = graph.create_node("talker")
    when_heard("/rosout", lambda: talker.log("warn", "look out", console=False))
    lines = run("rostopic", "echo", "-n1", "--filter", "m.name == '/talker'", "/rosout").out
    assert 'level: 4\nname: "/talker"\nmsg: "look out"\n' in lines


def test_bytes_are_shown_as_numbers(robot: Node, run) -> None:
    image = ros1_message_type("sensor_msgs/Image")(data=bytes([0, 7, 255]), width=3)
    _latched(robot, "/image", image)
    assert run("rostopic", "echo", "-n1", "/image/data").out == "[0, 7, 255]\n---\n"
    assert "data: [0, 7, 255]\n" in run("rostopic", "echo", "-n1", "/image").out
    assert run("rostopic", "echo", "-n1", "/image/data[1]").out == "7\n---\n"
    short = run("rostopic", "echo", "-n1", "--noarr", "/image").out
    assert 'data: "<array type: uint8, length: 3>"\n' in short


def test_a_type_that_is_not_known_here_is_one_error(graph: Graph, run, monkeypatch) -> None:
    from gazelle.cli.rostopic import echo, topics

    found = topics.FoundTopic("/x", "other_msgs/Thing", ())
    monkeypatch.setattr(echo, "wait_for_topic", lambda _graph, _word: found)
    result = run("rostopic", "echo", "/x")
    assert result.code == 1
    assert result.err.startswith(
        "ERROR: Cannot load message class for [other_msgs/Thing]. Are your messages built?\n"
    )


def test_a_field_that_is_not_there_is_named_with_those_that_are(robot: Node) -> None:
    from gazelle.cli.rostopic.topics import _advice

    robot.create_publisher("/scan", "sensor_msgs/LaserScan")
    text = _advice(robot.graph.entities(), "/scan/rnges")
    assert "/scan is published; the fields of sensor_msgs/LaserScan: header, angle_min" in text


def test_an_index_that_is_no_number_is_an_error(robot: Node, run) -> None:
    _latched(robot, "/scan", _scan())
    found = run("rostopic", "echo", "-n1", "/scan/ranges[x]")
    assert found.code == 1
    assert found.err.startswith("ERROR: field 'ranges' has invalid slice argument 'x'")


def test_a_missing_bag_is_told(run) -> None:
    found = run("rostopic", "echo", "-b", "x.bag", "/scan")
    assert (found.code, found.err) == (1, "ERROR: bag file [x.bag] does not exist\n")
