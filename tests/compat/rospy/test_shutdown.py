"""What rospy's calls do when the node is shut down, before and meanwhile."""

from __future__ import annotations

import signal
import subprocess
import threading
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.graph import Graph, Node
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


@pytest.mark.parametrize("wait", sorted(_WAITS))
def test_interrupt_ends_every_wait_without_a_traceback(program: Run, node: Node, wait: str) -> None:
    """By itself nothing waited for here comes within a test's patience."""
    asked, held = threading.Event(), threading.Event()

    def hold(_request: Any) -> Any:
        asked.set()
        held.wait()

    node.create_service("/hold", Empty, hold)
    waiting = program(
        "import subprocess, sys, threading, time\nimport actionlib, rospy\n"
        "from actionlib_tutorials.msg import FibonacciAction\n"
        "from std_msgs.msg import String\nfrom std_srvs.srv import Empty\n"
        "rospy.init_node('waiting')\nrospy.wait_for_service('hold')\n"
        "sleeper = threading.Thread(target=time.sleep, args=(300,))\n"
        f"print('ready', flush=True)\n{_WAITS[wait]}\n"
    )
    waiting.wait_for_line("^ready$")
    if wait == "call":
        waiting.eventually(asked.is_set)
    assert waiting.stop(signal.SIGINT) == (9 if wait == "action" else 130), waiting.text
    held.set()
    assert TRACEBACK not in waiting.text


def test_program_that_knows_of_the_shutdown_is_left_to_its_end(program: Run, tmp_path: Any) -> None:
    go_on = tmp_path / "go_on"
    saving = program(
        "import os, rospy\nrospy.init_node('saving')\nprint('ready', flush=True)\n"
        "rospy.spin()\n"
        f"while not os.path.exists({str(go_on)!r}):\n    rospy.sleep(0.01)\n"
        "print('saved', flush=True)\n"
    )
    saving.wait_for_line("^ready$")
    saving.popen.send_signal(signal.SIGINT)
    with pytest.raises(subprocess.TimeoutExpired):
        # Longer than one that does not know may take.
        saving.popen.wait(4.0)
    go_on.touch()
    assert saving.wait() == 0 and "saved" in saving.lines


def test_second_interrupt_ends_a_program_that_does_not_listen(program: Run) -> None:
    deaf = program(
        "import rospy, time\nrospy.init_node('deaf')\n"
        "rospy.core.add_shutdown_hook(lambda _: print('first', flush=True))\n"
        "print('ready', flush=True)\n"
        "try:\n    while True:\n        time.sleep(0.01)\n"
        "except KeyboardInterrupt:\n    print('interrupted', flush=True)\n"
    )
    deaf.wait_for_line("^ready$")
    deaf.popen.send_signal(signal.SIGINT)
    deaf.wait_for_line("^first$")
    assert deaf.stop(signal.SIGINT) == 0, deaf.text
    assert "interrupted" in deaf.lines


def test_waiting_for_a_service_for_no_time_is_refused(passes: Run) -> None:
    passes(
        "import rospy\nrospy.init_node('hasty')\n"
        "try:\n    rospy.wait_for_service('any', 0)\n"
        "except ValueError as error:\n    assert str(error) == 'timeout must be non-zero'\n"
        "else:\n    raise SystemExit('waited')\n"
    )
