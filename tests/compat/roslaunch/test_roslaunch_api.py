"""roslaunch from Python, as its wiki page has it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from gazelle.compat.roslaunch import Node, RLException, ROSLaunch
from gazelle.compat.roslaunch.rlutil import resolve_launch_arguments

TALKER = """
import rospy, sys
from std_msgs.msg import String
rospy.init_node('talker')
publisher = rospy.Publisher('chatter', String, queue_size=1, latch=True)
publisher.publish(f"{rospy.get_name()} {rospy.get_param('~word', 'none')} {rospy.myargv()[1:]}")
rospy.spin()
"""
MANIFEST = (
    "<package format='2'><name>pkg</name><version>0.0.1</version><description>d</description>"
    "<maintainer email='a@b.c'>a</maintainer><license>MIT</license>"
    "<buildtool_depend>catkin</buildtool_depend></package>"
)


@pytest.fixture
def package(tmp_path: Any) -> Any:
    folder = tmp_path / "pkg"
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_text(MANIFEST)
    script = folder / "scripts" / "talker.py"
    script.write_text(f"#!/usr/bin/env python3\n{TALKER}")
    script.chmod(0o755)
    (folder / "one.launch").write_text(
        "<launch><arg name='word'/><node pkg='pkg' type='talker.py' name='by_file'>"
        "<param name='word' value='$(arg word)'/></node></launch>"
    )
    return folder


def test_script_starts_and_stops_files_and_nodes(
    program: Callable[..., Any], package: Any, graph: Any
) -> None:
    running = program(
        f"""
import roslaunch, rospy, time
from std_msgs.msg import String
rospy.init_node('script')
heard = []
rospy.Subscriber('chatter', String, lambda message: heard.append(message.data))
def wait(condition):
    for _ in range(2000):
        if condition():
            return
        time.sleep(0.01)
    raise AssertionError(heard)
uuid = roslaunch.rlutil.get_or_generate_uuid(None, False)
roslaunch.configure_logging(uuid)
file = roslaunch.rlutil.resolve_launch_arguments(['pkg', 'one.launch'])[0]
assert file == {str(package / "one.launch")!r}
parent = roslaunch.parent.ROSLaunchParent(uuid, [(file, ['word:=hello'])], show_summary=False)
parent.start()
launch = roslaunch.scriptapi.ROSLaunch()
launch.start()
node = roslaunch.core.Node('pkg', 'talker.py', name='by_hand', namespace='/ns', args='5',
                           remap_args=[('chatter', '/chatter')])
process = launch.launch(node)
wait(lambda: len(heard) == 2)
assert sorted(heard) == ['/by_file hello []', "/ns/by_hand none ['5']"], heard
assert process.is_alive() and process.name == '/ns/by_hand'
process.stop()
assert not process.is_alive() and process.exit_code == 0, process.get_info()
parent.shutdown()
assert not parent.spin_once()
print('fine')
""",
        ROS_PACKAGE_PATH=str(package.parent),
    )
    running.wait_for_line("fine")
    assert running.wait() == 0, running.text


def test_what_cannot_start_is_told_at_once(
    package: Any, monkeypatch: pytest.MonkeyPatch, tmp_path: Any
) -> None:
    from gazelle.compat.roslaunch import ROSLaunchParent

    monkeypatch.setenv("ROS_PACKAGE_PATH", str(package.parent))
    monkeypatch.chdir(tmp_path)
    with pytest.raises(RLException, match=r"not a launch file in package .pkg.; .*one.launch"):
        resolve_launch_arguments(["pkg", "on.launch"])
    with pytest.raises(RLException, match="neither a launch file in package"):
        resolve_launch_arguments(["pgk", "one.launch"])
    with pytest.raises(RLException, match="does not exist"):
        ROSLaunchParent("", [str(tmp_path / "none.launch")]).start()
    bad = tmp_path / "bad.launch"
    bad.write_text("<launch><nod/></launch>\n<oops")
    with pytest.raises(RLException, match=r"bad\.launch"):
        ROSLaunchParent("", [(str(bad), [])]).start()
    api = ROSLaunch()
    with pytest.raises(RLException, match=r"please call start\(\) first"):
        api.launch(Node("pkg", "talker.py"))
    api.start()
    with pytest.raises(RLException, match=r"unable to launch \[pkg/talkr.py\].*talkr.py"):
        api.launch(Node("pkg", "talkr.py"))


def test_node_is_written_as_xml() -> None:
    node = Node("a", "b.py", args="--x '<1>'", respawn=True, env_args=[("K", "v")], output="screen")
    text = node.to_xml()
    assert 'name="b"' in text and 'respawn="true"' in text and 'output="screen"' in text
    assert "args=\"--x '&lt;1&gt;'\"" in text and '<env name="K" value="v"/>' in text
