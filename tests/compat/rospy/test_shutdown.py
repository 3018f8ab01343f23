"""What rospy's calls do when the node is shut down, before and meanwhile."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from tests.conftest import commands, reserved_port
from tests.patience import eventually

from gazelle.graph import Graph
from gazelle.interfaces import service_type

Run = Callable[..., Any]
Empty = service_type("std_srvs/srv/Empty")
TRACEBACK = "Traceback (most recent call last)"

_AFTER = """
import actionlib, rospy, tf, tf2_ros
from dynamic_reconfigure.client import Client
from actionlib_tutorials.msg import FibonacciAction, FibonacciGoal
from std_msgs.msg import String
from std_srvs.srv import Empty
rospy.init_node("late")
early = actionlib.SimpleActionClient("early", FibonacciAction)
rospy.signal_shutdown("over")
pub = rospy.Publisher("words", String, queue_size=1, latch=True)
pub.publish("to nobody")
sub = rospy.Subscriber("words", String, lambda _: print("heard", flush=True))
print("connections", pub.get_num_connections(), sub.get_num_connections())
server = rospy.Service("serve", Empty, print)
call = rospy.ServiceProxy("serve", Empty)
client = actionlib.SimpleActionClient("act", FibonacciAction)
for one in (early, client):
    one.send_goal(FibonacciGoal())
    one.cancel_all_goals()
    print("server", one.wait_for_server(), "result", one.wait_for_result())
actionlib.SimpleActionServer("own", FibonacciAction, print, False).start()
buffer = tf2_ros.Buffer()
tf2_ros.TransformListener(buffer)
tf.TransformBroadcaster()
rospy.Timer(rospy.Duration(0.01), print)
rospy.Rate(100).sleep()
print("parameter", rospy.get_param("/absent", 3))
for wait in (
    call,
    lambda: Client("nobody", timeout=60),
    lambda: rospy.wait_for_service("serve"),
    lambda: rospy.wait_for_message("words", String),
):
    try:
        wait()
    except (rospy.ServiceException, rospy.ROSException) as error:
        print(type(error).__name__, error)
for one in (pub, sub):
    one.unregister()
server.shutdown()
"""


def test_what_is_made_after_the_shutdown_reaches_nobody(passes: Run, graph: Graph) -> None:
    seen: set[str] = set()
    graph.discovery.listen(lambda entity, _: seen.add(entity.name))
    told = passes(_AFTER)
    assert [line for line in told.lines if line != "fine"] == [
        "connections 0 0",
        *["server False result False"] * 2,
        "parameter 3",
        "ServiceException service [/serve] returned no response",
        *["ROSInterruptException rospy shutdown"] * 3,
    ]
    assert not seen & {"/words", "/serve", "/act/goal", "/own/status"}


_WAITS = {
    "action": "actionlib.SimpleActionClient('no', FibonacciAction).wait_for_server()\nsys.exit(9)",
    "call": "rospy.ServiceProxy('hold', Empty)()",
    "endless loop": "while True:\n    time.sleep(0.01)",
    "endless sleeps": "while True:\n    rospy.sleep(0.01)",
    "input": "import os\nos.read(os.pipe()[0], 1)",
    "join": "sleeper.start()\nsleeper.join()",
    "message": "rospy.wait_for_message('nobody', String)",
    "left thread": "sleeper.start()\nrospy.spin()",
    "process": "subprocess.call(['sleep', '300'])",
    "service": "rospy.wait_for_service('nobody')",
    "sleep": "time.sleep(300)",
}


_HEAD = (
    "import os, signal, subprocess, sys, threading, time\nimport actionlib, rospy\n"
    "from actionlib_tutorials.msg import FibonacciAction\n"
    "from std_msgs.msg import String\nfrom std_srvs.srv import Empty\n"
    "rospy.init_node('waiting', anonymous=True)\nrospy.wait_for_service('hold')\n"
    "sleeper = threading.Thread(target=time.sleep, args=(300,))\n"
    "def saves():\n"
    "    while not os.path.exists('go_on'):\n        rospy.sleep(0.01)\n"
    "    print('saved', flush=True)\n"
)
_SAVES = {
    "knows": "print('ready', flush=True)\nrospy.spin()\nsaves()\n",
    # Longer than a program may go on that does not ask; meanwhile this one cannot.
    "shut down slowly": "rospy.core.add_shutdown_hook(lambda _: time.sleep(3.5))\n"
    "print('ready', flush=True)\n"
    "while not rospy.is_shutdown():\n    time.sleep(0.01)\nsaves()\n",
    # The second Ctrl-C comes as soon as the first one has shut the node down.
    "asked twice": "def again(_):\n    os.kill(os.getpid(), signal.SIGINT)\n"
    "rospy.core.add_shutdown_hook(again)\n"
    # Whoever reads it interrupts at once.
    "try:\n    print('ready', flush=True)\n"
    "    while True:\n        time.sleep(0.01)\n"
    "except KeyboardInterrupt:\n    print('interrupted', flush=True)\n    saves()\n",
}


@dataclass
class _Interrupted:
    """Programs that all have heard Ctrl-C at the same time, and what there is of them."""

    programs: dict[str, Any]
    go_on: Path


@pytest.fixture(scope="module")
def interrupted(tmp_path_factory: pytest.TempPathFactory) -> Iterator[_Interrupted]:
    """Interrupted once they wait: together, as each may go on for a while of wall time."""
    folder = tmp_path_factory.mktemp("interrupted")
    asked, held = threading.Event(), threading.Event()

    def hold(_request: Any) -> Any:
        asked.set()
        held.wait()

    texts = {name: f"print('ready', flush=True)\n{wait}\n" for name, wait in _WAITS.items()}
    programs: dict[str, Any] = {}
    with (
        reserved_port() as port,
        Graph.open(port=port, role="hub", environ={}) as graph,
        commands(folder, port) as run,
    ):
        graph.create_node("test", rosout=False).create_service("/hold", Empty, hold)
        for name, text in (texts | _SAVES).items():
            file = folder / f"{name}.py"
            file.write_text(_HEAD + text, encoding="utf-8")
            programs[name] = run(str(file), module="gazelle.compat.script_runner")
        for one in programs.values():
            one.wait_for_line("^ready$")
        eventually(asked.is_set)
        for one in programs.values():
            one.popen.send_signal(signal.SIGINT)
        yield _Interrupted(programs, folder / "go_on")
        held.set()


@pytest.mark.parametrize("wait", sorted(_WAITS))
def test_interrupt_ends_every_wait_without_a_traceback(
    interrupted: _Interrupted, wait: str
) -> None:
    """By itself nothing waited for here comes within a test's patience."""
    waiting = interrupted.programs[wait]
    assert waiting.wait() == (9 if wait == "action" else 130), waiting.text
    assert TRACEBACK not in waiting.text


def test_program_that_knows_of_its_end_is_left_to_it(interrupted: _Interrupted) -> None:
    """It has seen the shutdown, or a second Ctrl-C; those that have not are ended meanwhile."""
    for wait in _WAITS:
        interrupted.programs[wait].wait()
    for name in _SAVES:
        assert interrupted.programs[name].popen.poll() is None, interrupted.programs[name].text
    interrupted.go_on.touch()
    for name in _SAVES:
        saving = interrupted.programs[name]
        assert saving.wait() == 0 and "saved" in saving.lines, saving.text
    assert "interrupted" in interrupted.programs["asked twice"].lines


def test_waiting_for_a_service_for_no_time_is_refused(passes: Run) -> None:
    passes(
        "import rospy\nrospy.init_node('hasty')\n"
        "try:\n    rospy.wait_for_service('any', 0)\n"
        "except ValueError as error:\n    assert str(error) == 'timeout must be non-zero'\n"
        "else:\n    raise SystemExit('waited')\n"
    )
