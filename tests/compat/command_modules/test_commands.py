"""rostopic, rosnode, rosparam, rosservice, roslib and rospkg as modules of a program."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.graph import Node
from gazelle.interfaces import message_type, service_type


def test_topics_nodes_and_services_are_asked_for(passes: Callable[..., Any], node: Node) -> None:
    node.create_publisher("/odom", message_type("nav_msgs/Odometry"))
    node.create_publisher("/scan", message_type("sensor_msgs/LaserScan"))
    kind = service_type("example_interfaces/AddTwoInts")
    triggers = service_type("std_srvs/SetBool")
    node.create_service(
        "/switch", triggers, lambda request: triggers.Response(success=request.data)
    )
    del kind
    passes(
        """
import rospy, rostopic, rosnode, rosservice
from nav_msgs.msg import Odometry
rospy.init_node('asker')
rospy.Subscriber('/odom', Odometry, print)
cls, real, take = rostopic.get_topic_class('/odom/pose/pose/position/x', blocking=True)
assert cls is Odometry and real == '/odom', (cls, real)
message = Odometry(); message.pose.pose.position.x = 3.0
assert take(message) == 3.0
assert rostopic.get_topic_type('odom') == ('nav_msgs/Odometry', '/odom', None)
assert rostopic.get_topic_type('/nothing') == (None, None, None)
scan = rostopic.get_topic_class('/scan/ranges[1]')
assert scan[2](scan[0](ranges=[1.0, 2.0])) == 2.0
pubs, subs = rostopic.get_topic_list()
assert ('/odom', 'nav_msgs/Odometry', ['/test']) in pubs
assert ('/odom', 'nav_msgs/Odometry', ['/asker']) in subs
assert rostopic.find_by_type('sensor_msgs/LaserScan') == ['/scan']
text = rostopic.get_info_text('/scan')
assert text.startswith('Type: sensor_msgs/LaserScan\\n\\nPublishers: \\n * /test\\n'), text
assert 'Subscribers: None' in text
try:
    rostopic.get_info_text('/nothing')
except rostopic.ROSTopicException as error:
    assert str(error) == 'Unknown topic /nothing'

assert {'/asker', '/test'} <= set(rosnode.get_node_names())
assert rosnode.get_node_names('/nowhere') == []
assert rosnode.rosnode_ping('/test', max_count=1) and not rosnode.rosnode_ping('/gone')
assert rosnode.kill_nodes(['/gone']) == ([], ['/gone'])

assert '/switch' in rosservice.get_service_list()
assert rosservice.get_service_type('/switch') == 'std_srvs/SetBool'
assert rosservice.get_service_node('/switch') == '/test'
assert rosservice.get_service_args('/switch') == 'data'
assert rosservice.rosservice_find('std_srvs/SetBool') == ['/switch']
request, response = rosservice.call_service('/switch', [True])
assert response.success
try:
    rosservice.call_service('/switch', [1, 2])
except rosservice.ROSServiceException as error:
    assert 'Incompatible arguments to call service [/switch]' in str(error)
else:
    raise AssertionError('one field')
try:
    rosservice.get_service_class_by_name('/swich')
except rosservice.ROSServiceException as error:
    assert "did you mean '/switch'" in str(error)
"""
    )


def test_parameters_come_from_files_and_go_to_them(
    passes: Callable[..., Any], tmp_path: Path
) -> None:
    file = tmp_path / "p.yaml"
    file.write_text("_ns: arm\na: 1\nb: {c: deg(90)}\n---\nlist: [1, 2]\n")
    passes(
        f"FILE, OUT = {str(file)!r}, {str(tmp_path / 'out.yaml')!r}\n"
        + """
import rosparam, rospy, yaml
documents = rosparam.load_file(FILE, default_namespace='/robot')
assert [space for _, space in documents] == ['/robot/arm', '/robot'], documents
for params, ns in documents:
    rosparam.upload_params(ns, params)
assert rospy.get_param('/robot/arm/a') == 1 and rospy.get_param('/robot/list') == [1, 2]
assert abs(rospy.get_param('/robot/arm/b/c') - 1.5708) < 1e-3
assert rosparam.list_params('/robot/arm') == ['/robot/arm/a', '/robot/arm/b/c']
rosparam.set_param('/robot/x', '[1, two]')
assert rosparam.get_param('/robot/x') == [1, 'two']
rosparam.dump_params(OUT, '/robot')
assert yaml.safe_load(open(OUT))['arm']['a'] == 1
rosparam.delete_param('/robot/x')
for call, text in ((lambda: rosparam.get_param('/robot/x'), 'Parameter [/robot/x] is not set'),
                   (lambda: rosparam.load_file('/nope.yaml'), 'file [/nope.yaml] does not exist'),
                   (lambda: rosparam.load_str('a: [', 'mine'), '[mine] is no YAML of parameters'),
                   (lambda: rosparam.upload_params('/a', {1: 2}), 'must have string keys'),
                   (lambda: rosparam.upload_params('/', 3), 'can only be set to a dictionary')):
    try:
        call()
    except rosparam.RosParamException as error:
        assert text in str(error), error
    else:
        raise AssertionError(text)
"""
    )


def test_packages_and_classes_are_found(passes: Callable[..., Any], tmp_path: Path) -> None:
    folder = tmp_path / "src" / "mine"
    (folder / "launch").mkdir(parents=True)
    (folder / "launch" / "a.launch").write_text("<launch/>")
    (folder / "package.xml").write_text(
        "<package><name>mine</name><version>1.2.3</version><description>d</description>"
        "<run_depend>std_msgs</run_depend></package>"
    )
    passes(
        f"ROOT = {str(tmp_path / 'src')!r}\n"
        + """
import os, rospkg, roslib, roslib.message
from roslib import packages
roslib.load_manifest('mine')
assert roslib.message.get_message_class('std_msgs/String')._type == 'std_msgs/String'
assert roslib.message.get_message_class('std_msgs/Nope') is None
assert roslib.message.get_service_class('std_srvs/Empty')._type == 'std_srvs/Empty'
try:
    roslib.message.get_message_class('String')
except ValueError as error:
    assert 'message type is missing package name' in str(error)
mine = os.path.join(ROOT, 'mine')
assert packages.get_pkg_dir('mine') == mine
assert packages.find_resource('mine', 'a.launch') == [os.path.join(mine, 'launch', 'a.launch')]
assert packages.resource_file('mine', 'launch', 'b') == os.path.join(mine, 'launch', 'b')
assert packages.get_dir_pkg(os.path.join(mine, 'launch')) == (mine, 'mine')
assert packages.get_pkg_dir('nobody', required=False) is None
try:
    packages.get_pkg_dir('nobody')
except packages.InvalidROSPkgException as error:
    assert 'nobody' in str(error)
pack = rospkg.RosPack.get_instance()
assert pack is rospkg.RosPack.get_instance() and pack.get_path('mine') == mine
assert pack.get_manifest('mine').version == '1.2.3'
assert rospkg.RosStack().list() == [] and pack.stack_of('mine') is None
assert rospkg.get_package_name(os.path.join(mine, 'launch')) == 'mine'
assert rospkg.on_ros_path(mine) and not rospkg.on_ros_path('/usr')
assert rospkg.get_ros_home().endswith('.ros') or 'ROS_HOME' in os.environ
""",
        ROS_PACKAGE_PATH=str(tmp_path / "src"),
    )
