"""rospy.Service, ServiceProxy and wait_for_service."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Run = Callable[..., Any]

_SERVICES = """
import rospy
from std_srvs.srv import Empty, SetBool, SetBoolRequest, SetBoolResponse, Trigger, TriggerResponse
rospy.init_node("server")

def failure(function, *args, **kwds):
    try:
        function(*args, **kwds)
    except rospy.ServiceException as error:
        return str(error)
    raise AssertionError("nothing raised")

def offer(name, kind, handler, **more):
    rospy.Service(name, kind, handler, **more)
    rospy.wait_for_service(name, timeout=30)
    return rospy.ServiceProxy(name, kind)

# A response, a list, a tuple, a dict.
for answer in (TriggerResponse(True, "yes"), [True, "yes"], (True, "yes"),
               {"success": True, "message": "yes"}):
    call = offer("trigger", Trigger, lambda request, answer=answer: answer)
    response = call()
    assert (response.success, response.message) == (True, "yes")

# A request in each form.
echo = offer("echo", SetBool, lambda request: (request.data, str(request.data)))
assert echo(True).message == echo(data=True).message == echo(SetBoolRequest(True)).message == "True"
assert echo.call(False).success is False
offer("empty", Empty, lambda request: [])()

def boom(request):
    raise RuntimeError("boom")
def refuse(request):
    raise rospy.ServiceException("not today")
assert failure(offer("boom", Trigger, boom)) == (
    "service [/boom] responded with an error: error processing request: boom")
assert failure(offer("refuse", Trigger, refuse)) == (
    "service [/refuse] responded with an error: service cannot process request: not today")
assert "service handler returned None" in failure(offer("none", Trigger, lambda request: None))
heard = []
failure(offer("heard", Trigger, boom, error_handler=lambda *about: heard.append(about[1])))
assert heard == [RuntimeError]

assert failure(rospy.ServiceProxy("nowhere", Trigger)) == "service [/nowhere] unavailable"
try:
    rospy.wait_for_service("nowhere", timeout=0.05)
    raise AssertionError("nothing raised")
except rospy.ROSException as error:
    assert str(error) == "timeout exceeded while waiting for service /nowhere"
try:
    echo(TriggerResponse())
    raise AssertionError("nothing raised")
except TypeError:
    pass
"""


def test_services_take_and_give_every_form_and_say_what_failed(passes: Run) -> None:
    done = passes(_SERVICES)
    assert "Error processing request: boom" in done.text


def test_service_can_be_called_without_being_a_node(passes: Run, node: Any) -> None:
    from gazelle.interfaces import service_type

    kind = service_type("std_srvs/srv/Trigger")
    node.create_service("/ask", kind, lambda request: kind.Response(success=True, message="hi"))
    passes(
        "import rospy\nfrom std_srvs.srv import Trigger\n"
        "rospy.wait_for_service('/ask', 5)\n"
        "assert rospy.ServiceProxy('/ask', Trigger)().message == 'hi'\n"
    )
