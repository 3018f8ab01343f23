"""Files that describe robots, worlds, packages, messages and launches."""

from __future__ import annotations

import base64
import json
import re
import struct
from pathlib import Path

from tests.control.plant import PlantJoint, make_robot
from tests.control.recording_ports import RecordingPorts
from tests.fuzzing.kind import SCOUT, Kind

from gazelle.control.controller_manager import ControllerManager
from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource
from gazelle.control.parameter_sources.ros2_parameter_file import read_parameter_file
from gazelle.description.materials.ogre_scripts import parse_material_script
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader import read_sdf
from gazelle.description.sdf_reader.model_config import read_model_config
from gazelle.description.urdf_reader import read_urdf
from gazelle.description.urdfdom_emulation import urdfdom_verdict
from gazelle.description.xacro import expand_xacro
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.geometry.mesh_files import load_mesh_reported
from gazelle.interfaces.definition import RosVersion
from gazelle.interfaces.parser import parse_message, split_parts
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.workspace import Workspace
from gazelle.workspace.package_xml import ManifestError, quick_name, read_manifest

__all__ = ["DESCRIPTIONS"]


def _urdf(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    root = parse_xml(path.read_bytes(), str(path), diagnostics)
    if root is not None:
        read_urdf(root, context=ReadContext(workspace, diagnostics, str(path), None))


def _sdf(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    root = parse_xml(path.read_bytes(), str(path), diagnostics)
    if root is not None:
        read_sdf(root, context=ReadContext(workspace, diagnostics, str(path), None))


def _urdfdom(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    urdfdom_verdict(path.read_bytes().decode("utf-8", "replace"))


def _xacro(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    expanded = expand_xacro(path, workspace=workspace, diagnostics=diagnostics)
    if expanded is not None:
        expanded.tag(diagnostics)


def _launch(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    load_launch_files([path], {}, workspace=workspace, diagnostics=diagnostics)


def _message(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    text = path.read_bytes().decode("utf-8", "replace")
    parse_message(text, "p/msg/M", RosVersion.ROS2, file=str(path), diagnostics=diagnostics)


def _action(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    text = path.read_bytes().decode("utf-8", "replace")
    for part, line in split_parts(text, 3, file=str(path), diagnostics=diagnostics) or ():
        for ros_version in RosVersion:
            parse_message(part, "p/action/M", ros_version, diagnostics=diagnostics, first_line=line)


def _controllers(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    """Read a parameter file, and make and run the controllers it describes on ideal joints."""
    source = FileSource((), "/", diagnostics)
    source.add_sections(read_parameter_file(path, diagnostics))
    robot, _ = make_robot([PlantJoint("a"), PlantJoint("b")], ros_version=2)
    manager = ControllerManager(
        robot,
        namespace="/",
        make_ports=lambda name: RecordingPorts(subscribed=False),
        source=source,
        diagnostics=diagnostics,
        update_rate_hz=1000.0,
    )
    for name in source.controllers():
        manager.load(name)
        manager.configure(name)
        manager.switch([name], [], strict=False)
    for tick in range(3):
        manager.update(tick * 1_000_000, 1_000_000)
    manager.close()


def _rosparam(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    launch = path.with_suffix(".launch")
    launch.write_text(f'<launch><rosparam file="{path}" ns="a"/></launch>')
    load_launch_files([launch], {}, workspace=workspace, diagnostics=diagnostics)


def _mesh(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    load_mesh_reported(path, diagnostics)


def _model_config(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    read_model_config(path.parent, ReadContext(workspace, diagnostics, str(path), path.parent))


def _manifest(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    quick_name(path.read_bytes())
    try:
        read_manifest(path)
    except ManifestError as error:
        raise GazelleError(str(error)) from error


def _material(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    text = path.read_bytes().decode("utf-8", "replace")
    parse_material_script(text, str(path), diagnostics)


def _good_urdf() -> bytes:
    """Return the example robot, expanded."""
    workspace, diagnostics = Workspace.discover(extra=[SCOUT]), Diagnostics()
    path = SCOUT / "urdf" / "scout.urdf.xacro"
    expanded = expand_xacro(path, workspace=workspace, diagnostics=diagnostics)
    assert expanded is not None
    return expanded.text.encode()


def _good_launch() -> bytes:
    """Return the example's launch file without its command, which damage would turn into others."""
    text = (SCOUT / "launch" / "scout.launch").read_text()
    return re.sub(r'command="[^"]*"', 'value="a robot"', text).encode()


_MESSAGE = b"""# a message
std_msgs/Header header
uint8 MODE_A=1
string<=10 NAME="x"
float64[] values
geometry_msgs/Point[3] corners
int32 count 5
"""
_CONTROLLERS = b"""\
controller_manager:
  ros__parameters:
    update_rate: 100
    states: {type: joint_state_broadcaster/JointStateBroadcaster}
    arm: {type: joint_trajectory_controller/JointTrajectoryController}
    base: {type: diff_drive_controller/DiffDriveController}
    lift: {type: effort_controllers/JointPositionController}
arm:
  ros__parameters:
    joints: [a, b]
    command_interfaces: [effort]
    state_interfaces: [position, velocity]
    constraints: {goal_time: 0.5, a: {trajectory: 0.1, goal: 0.01}}
    gains: {a: {p: 10.0, i: 0.1, d: 1e-1, i_clamp: 1.0}, b: {p: 5.0}}
"base":
  ros__parameters:
    left_wheel_names: ["a"]
    right_wheel_names: ["b"]
    wheel_separation: 0.4
    wheel_radius: .1
    pose_covariance_diagonal: [0.001, 0.001, 0.001, 0.001, 0.001, 0.03]
    linear.x.max_velocity: 1.0
lift:
  ros__parameters: {joint: a, pid: {p: 1.0, i: 0.0, d: 0.0}}
"""
_ROSPARAM = b"""\
robot: &robot {name: scout, wheels: [a, b], turn: deg(90), half: rad(pi/2)}
copy: *robot
merged: {<<: *robot, name: other}
when: 2001-12-14t21:59:43.10-05:00
count: 0x10
text: |
  several
  lines
local_costmap:
  plugins:
    - {name: static, type: "costmap_2d::StaticLayer"}
  footprint: [[0.1, 0.2], [-0.1, 0.2]]
"""
_XACRO = b"""\
<?xml version="1.0"?>
<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="size" default="0.5"/>
  <xacro:property name="length" value="$(arg size)"/>
  <xacro:property name="names" value="${['a', 'b', 'c']}"/>
  <xacro:property name="half" value="${length/2}"/>
  <xacro:macro name="wheel" params="name parent:=base *origin x:=^|1 **extra">
    <link name="${name}"><xacro:insert_block name="extra"/>
      <inertial><mass value="${x * 2**2}"/></inertial></link>
    <joint name="${name}_joint" type="fixed"><xacro:insert_block name="origin"/>
      <parent link="${parent}"/><child link="${name}"/></joint>
  </xacro:macro>
  <xacro:macro name="chain" params="count">
    <xacro:if value="${count > 0}">
      <link name="l${count}"/><xacro:chain count="${count - 1}"/>
    </xacro:if>
  </xacro:macro>
  <link name="base"/>
  <xacro:wheel name="w"><origin xyz="${half} ${-half} 0"/><e><visual/></e></xacro:wheel>
  <xacro:chain count="3"/>
  <xacro:unless value="false"><link name="${'_'.join(names)}"/></xacro:unless>
  <a b="${[n*2 for n in names if n != 'a']}" c="${'%05.2f' % radians(90)}" d="${max(1, 2)}"/>
  <xacro:element xacro:name="made"><xacro:attribute name="x" value="$(eval 1+1)"/></xacro:element>
</robot>
"""
_MATERIAL = b"""\
// a script
material Base
{
  technique
  {
    pass
    {
      ambient 0.1 0.2 0.3 1.0
      diffuse 1 0 0
      specular 1 1 1 1 12
    }
  }
}
material Child : Base
{
  technique
  {
    pass
    {
      texture_unit
      {
        texture wood.png
        filtering anisotropic
      }
      scene_blend alpha_blend
    }
  }
}
"""
_CONFIG = b"""\
<?xml version="1.0"?>
<model>
  <name>Box</name><version>1.0</version><sdf version="1.5">model.sdf</sdf>
  <sdf version="1.6">model-1_6.sdf</sdf><author><name>A</name><email>a@b.c</email></author>
  <description>A box.</description>
</model>
"""
_MANIFEST = b"""\
<?xml version="1.0"?>
<package format="3">
  <name>scout</name><version>1.0.0</version><description>d</description>
  <maintainer email="a@b.c">A</maintainer><license>MIT</license>
  <buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>
  <depend>rospy</depend><exec_depend version_gte="1.0">xacro</exec_depend>
  <export><build_type>ament_cmake</build_type>
    <gazebo_ros gazebo_model_path="${prefix}/models"/></export>
</package>
"""
_OBJ = b"""\
mtllib none.mtl
o box
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vn 0 0 1
usemtl red
f 1/1/1 2/1/1 3/1/1
f 1//1 2//1 4//1
g side
f -1 -2 -3 -4
"""
_DAE = b"""\
<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="0.01" name="cm"/><up_axis>Z_UP</up_axis></asset>
  <library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong>
    <diffuse><color>1 0 0 1</color></diffuse><shininess><float>5</float></shininess>
  </phong></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
      <technique_common><accessor source="#a" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist material="s" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
      <vcount>3 4</vcount><p>0 1 2 0 1 2 3</p></polylist>
    <triangles material="s" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
      <p>0 1 3</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="vs"><node id="n">
    <matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><rotate>0 0 1 90</rotate>
    <instance_geometry url="#g"><bind_material><technique_common>
      <instance_material symbol="s" target="#m"/></technique_common></bind_material>
    </instance_geometry></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#vs"/></scene>
</COLLADA>
"""
_FACETS = (((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 1, 0), (0, 0, 1)))


def _ascii_stl() -> bytes:
    facets = "".join(
        "facet normal 0 0 1\n outer loop\n"
        + "".join(f"  vertex {x} {y} {z}\n" for x, y, z in facet)
        + " endloop\nendfacet\n"
        for facet in _FACETS
    )
    return f"solid box\n{facets}endsolid box\n".encode()


def _binary_stl() -> bytes:
    facets = b"".join(
        struct.pack("<12fH", 0, 0, 1, *(value for point in facet for value in point), 0)
        for facet in _FACETS
    )
    return b"binary".ljust(80, b"\0") + struct.pack("<I", len(_FACETS)) + facets


def _document(**buffer: object) -> dict[str, object]:
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [1, 2, 3], "children": [1]}, {"mesh": 0}],
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 36},
            {"buffer": 0, "byteOffset": 36, "byteLength": 6},
        ],
        "buffers": [{"byteLength": 42, **buffer}],
    }  # fmt: skip


_BUFFER = struct.pack("<9f3H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)


def _gltf() -> bytes:
    uri = "data:application/octet-stream;base64," + base64.b64encode(_BUFFER).decode()
    return json.dumps(_document(uri=uri), indent=1).encode()


def _glb() -> bytes:
    text = json.dumps(_document()).encode()
    text += b" " * (-len(text) % 4)
    binary = _BUFFER + b"\0" * (-len(_BUFFER) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


DESCRIPTIONS: dict[str, Kind] = {
    "action": Kind(
        lambda: b"int32 a\n---\nint32 B=5\n---\nstring[] c # text\n", "A.action", _action
    ),
    "controllers": Kind(lambda: _CONTROLLERS, "controllers.yaml", _controllers),
    "dae": Kind(lambda: _DAE, "a.dae", _mesh),
    "glb": Kind(_glb, "a.glb", _mesh),
    "gltf": Kind(_gltf, "a.gltf", _mesh),
    "launch": Kind(_good_launch, "a.launch", _launch),
    "manifest": Kind(lambda: _MANIFEST, "package.xml", _manifest),
    "material": Kind(lambda: _MATERIAL, "a.material", _material),
    "message": Kind(lambda: _MESSAGE, "M.msg", _message),
    "model_config": Kind(lambda: _CONFIG, "model.config", _model_config),
    "obj": Kind(lambda: _OBJ, "a.obj", _mesh),
    "rosparam": Kind(lambda: _ROSPARAM, "a.yaml", _rosparam),
    "sdf": Kind((SCOUT / "worlds" / "workshop.world").read_bytes, "a.world", _sdf),
    "stl_ascii": Kind(_ascii_stl, "a.stl", _mesh),
    "stl_binary": Kind(_binary_stl, "a.stl", _mesh),
    "urdf": Kind(_good_urdf, "a.urdf", _urdf),
    "urdfdom": Kind(_good_urdf, "a.urdf", _urdfdom),
    "xacro": Kind(lambda: _XACRO, "a.xacro", _xacro),
}
