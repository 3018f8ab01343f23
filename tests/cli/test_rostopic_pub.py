"""rostopic pub."""

from __future__ import annotations

import io
import threading
import time
from typing import Any

import pytest

from gazelle.cli.rostopic import pub
from gazelle.graph import Entity, Node
from gazelle.interfaces import ros1_message_type


class Ear:
    """Hears a topic, and calls `then` once it heard `enough`."""

    def __init__(
        self, robot: Node, topic: str, type_name: str, *, enough: int = 0, then: Any = None
    ) -> None:
        self.heard: list[Any] = []
        self._changed = threading.Condition()
        self._enough = enough
        self._then = then
        robot.create_subscription(topic, ros1_message_type(type_name), self)

    def __call__(self, message: Any) -> None:
        with self._changed:
            self.heard.append(message)
            self._changed.notify_all()
        if len(self.heard) == self._enough:
            self._then()

    def wait(self, count: int = 1) -> list[Any]:
        with self._changed:
            assert self._changed.wait_for(lambda: len(self.heard) >= count, 10.0)
            return list(self.heard)


@pytest.fixture(autouse=True)
def _short(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pub, "_ONCE_S", 0.1)


@pytest.mark.parametrize(
    "words",
    [
        ["{linear: {x: 0.5}, angular: {z: 0.1}}"],
        ["[0.5, 0, 0]", "[0, 0, 0.1]"],
        ["linear: {x: 0.5}\nangular: {z: 0.1}"],
        ["{x: 0.5}", "{z: 0.1}"],
    ],
)
def test_all_forms_of_arguments_are_taken(robot: Node, run, words: list[str]) -> None:
    ear = Ear(robot, "/cmd_vel", "geometry_msgs/Twist")
    assert run("rostopic", "pub", "-1", "/cmd_vel", "geometry_msgs/Twist", *words).code == 0
    message = ear.wait()[0]
    assert (message.linear.x, message.linear.y, message.angular.z) == (0.5, 0.0, 0.1)


def test_once_says_what_ros_says(robot: Node, run, recorded, monkeypatch) -> None:
    Ear(robot, "/cmd_vel", "geometry_msgs/Twist")
    real = recorded("pub")
    monkeypatch.setattr(pub, "_ONCE_S", 3.0)
    start_s = time.monotonic()
    assert (
        run("rostopic", "pub", "-1", "/cmd_vel", "geometry_msgs/Twist", "[0,0,0]", "[0,0,0]")
        == real
    )
    assert time.monotonic() - start_s >= 3.0


def test_a_wrong_field_is_reported_as_by_ros_and_explained(graph, run, recorded) -> None:
    real = recorded("pub_bad")
    ours = run("rostopic", "pub", "-1", "/cmd_vel", "geometry_msgs/Twist", "{linear: {q: 0.5}}")
    assert (ours.code, ours.out) == (real.code, real.out)
    lines = ours.err.splitlines()
    assert [lines[0], *lines[2:]] == real.err.splitlines()
    assert "its fields are x, y, z" in lines[1].lower()


def test_a_wrong_value_shows_the_definition(graph, run) -> None:
    found = run("rostopic", "pub", "-1", "/x", "std_msgs/Float64", "{data: fast}")
    assert found.code == 1
    assert found.err == (
        "ERROR: Unable to publish message. One of the fields has an incorrect type:\n"
        "  std_msgs/msg/Float64: field 'data' must be a number (float64), is str 'fast'\n\n"
        "msg file:\nfloat64 data\n\n"
    )


def test_an_unknown_type_names_what_is_near(graph, run) -> None:
    found = run("rostopic", "pub", "-1", "/x", "geometry_msgs/Twst", "{}")
    assert found.code == 1
    assert found.err.startswith("ERROR: invalid message type: geometry_msgs/Twst\n")
    assert "did you mean 'geometry_msgs/msg/Twist'" in found.err
    assert run("rostopic", "pub", "-1", "/x", "Twist", "{}").err.startswith(
        "ERROR: invalid topic type: Twist"
    )


def test_broken_yaml_is_one_error(graph, run) -> None:
    found = run("rostopic", "pub", "/x", "std_msgs/String", "{data: [")
    assert found.code == 1
    assert found.err.startswith("ERROR: Argument error: ")
    assert "Traceback" not in found.err


def test_now_and_auto_stand_for_the_time(robot: Node, run) -> None:
    ear = Ear(robot, "/p", "geometry_msgs/PointStamped")
    before_s = time.time()
    run("rostopic", "pub", "-1", "/p", "geometry_msgs/PointStamped", "{header: auto}")
    run("rostopic", "pub", "-1", "/p", "geometry_msgs/PointStamped", "{header: {stamp: now}}")
    for message in ear.wait(2):
        assert before_s - 1 < message.header.stamp.to_sec() < time.time() + 1


def test_a_late_subscriber_gets_the_latched_message(robot: Node, run, end_commands) -> None:
    ears: list[Ear] = []

    def listen(entity: Entity, is_there: bool) -> None:
        if is_there and entity.name == "/late" and not ears:
            ears.append(Ear(robot, "/late", "std_msgs/String", enough=1, then=end_commands))

    robot.graph.discovery.listen(listen)
    found = run("rostopic", "pub", "/late", "std_msgs/String", "data: hi")
    assert found.out == "publishing and latching message. Press ctrl-C to terminate\n"
    assert ears[0].heard[0].data == "hi"


def test_a_rate_publishes_again_and_substitutes(robot: Node, run, end_commands) -> None:
    ear = Ear(robot, "/t", "std_msgs/Time", enough=3, then=end_commands)
    found = run("rostopic", "pub", "-r", "200", "-s", "-v", "/t", "std_msgs/Time", "{data: now}")
    assert found.out.startswith("publishing data: \n  secs: ")
    stamps = [message.data.to_nsec() for message in ear.heard]
    assert len(stamps) >= 3
    assert stamps == sorted(set(stamps))


def test_a_file_of_several_documents_is_published_in_order(robot, run, tmp_path) -> None:
    ear = Ear(robot, "/n", "std_msgs/Int32")
    file = tmp_path / "numbers.yaml"
    file.write_text("data: 1\n---\ndata: 2\n---\ndata: 3\n")
    found = run("rostopic", "pub", "-r", "500", "-f", str(file), "/n", "std_msgs/Int32")
    assert found.code == 0
    assert [message.data for message in ear.wait(3)] == [1, 2, 3]
    missing = run("rostopic", "pub", "-f", "none.yaml", "/n", "std_msgs/Int32")
    assert missing.err == "ERROR: file does not exist: none.yaml\n"


def test_one_document_and_a_rate_repeat(robot: Node, run, end_commands, tmp_path) -> None:
    ear = Ear(robot, "/n", "std_msgs/Int32", enough=3, then=end_commands)
    file = tmp_path / "one.yaml"
    file.write_text("data: 7\n")
    found = run("rostopic", "pub", "-r", "200", "-f", str(file), "/n", "std_msgs/Int32")
    assert found.out == "Got one message and a rate, publishing repeatedly\n"
    assert {message.data for message in ear.heard} == {7}


def test_standard_input_is_published_document_by_document(robot, run, monkeypatch) -> None:
    ear = Ear(robot, "/n", "std_msgs/Int32")
    monkeypatch.setattr("sys.stdin", io.StringIO("data: 1\n---\ndata: 2\n---\ndata: 9"))
    assert run("rostopic", "pub", "-r", "500", "/n", "std_msgs/Int32").code == 0
    # What is behind the last rule may be half a message.
    assert [message.data for message in ear.wait(2)] == [1, 2]


def test_another_type_on_the_topic_is_told(robot: Node, run) -> None:
    robot.create_subscription("/cmd_vel", "geometry_msgs/Twist", print)
    found = run("rostopic", "pub", "-1", "/cmd_vel", "geometry_msgs/TwistStamped", "{}")
    assert found.err.startswith(
        "WARNING: /cmd_vel has type geometry_msgs/Twist, you publish geometry_msgs/TwistStamped; "
        "its subscribers drop that\n"
    )


def test_an_empty_message_needs_no_values(robot: Node, run) -> None:
    ear = Ear(robot, "/go", "std_msgs/Empty")
    assert run("rostopic", "pub", "-1", "/go", "std_msgs/Empty").code == 0
    assert len(ear.wait()) == 1
