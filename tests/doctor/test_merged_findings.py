"""One fact of many files is one finding."""

from __future__ import annotations

from pathlib import Path

from tests.doctor.conftest import Examine, Write

from gazelle.diagnostics import Diagnostic, Diagnostics, Severity, SourceSpan
from gazelle.doctor.merged_findings import condensed

WORLD = """<sdf version="1.6"><world name="w"><model name="m"><static>true</static><link name="l">
<visual name="v"><geometry><mesh><uri>model://crane/meshes/crane.dae</uri></mesh></geometry>
<material><script><uri>model://crane/materials/scripts</uri><name>Crane/Diffuse</name></script>
</material></visual>
<visual name="w"><geometry><mesh><uri>model://beer/meshes/beer.dae</uri></mesh></geometry></visual>
</link></model></world></sdf>
"""


def _found(code: str, *messages: str) -> list[Diagnostic]:
    made = Diagnostics()
    for line, message in enumerate(messages, 1):
        made.report(code, message, SourceSpan(f"/ws/{line}.launch", line, 1))
    return list(made)


def test_packages_of_ros_are_one_warning_and_a_wrong_name_stays_an_error(
    written: Write, examined: Examine
) -> None:
    node = '<node pkg="{}" type="t" name="n{}"/>'
    names = ("anchor_radar", "hokuyo_maker", "shop", "moev_base")
    nodes = "".join(node.format(name, index) for index, name in enumerate(names))
    manifest = '<package format="2"><name>bot</name><version>1.0.0</version>'
    manifest += "<exec_depend>shop</exec_depend></package>"
    folder = written(
        **{
            "package.xml": manifest,
            "launch__one.launch": f"<launch>{nodes}</launch>",
            "launch__two.launch": f"<launch>{node.format('anchor_radar', 9)}</launch>",
        }
    )
    found = [item for item in examined(folder, "bot").findings if "launch" in str(item.span)]
    elsewhere = next(item for item in found if item.code == "doctor.packages-elsewhere")
    assert elsewhere.severity is Severity.WARNING
    assert "anchor_radar (one.launch, two.launch), hokuyo_maker (one" in elsewhere.message
    (wrong,) = (item for item in found if item.code == "launch.package-missing")
    assert (wrong.severity, "'moev_base' not found" in wrong.message) == (Severity.ERROR, True)


def test_models_that_are_not_here_are_one_finding(written: Write, examined: Examine) -> None:
    folder = written(**{"worlds__w.world": WORLD})
    found = [item for item in examined(folder, "bot").findings if item.span and item.span.line > 1]
    assert [item.code for item in found] == ["sdf.missing-model"]
    assert "2 models are not here, and nothing is downloaded: beer, crane; " in found[0].message
    assert "GAZEBO_MODEL_PATH" in found[0].fix


def test_models_of_gazebos_database_are_in_the_one_finding() -> None:
    advice = "'{0}' is a model of Gazebo's model database; Gazelle has none of its own"
    texts = [f"'model://{name}/a' not found: {advice.format(name)}" for name in ("suv", "drc")]
    (found,) = condensed(_found("sdf.missing-file", *texts))
    assert "2 models are not here, and nothing is downloaded: drc, suv; " in found.message


def test_model_that_is_wanted_once_keeps_its_own_message() -> None:
    text = "'model://suv/a.dae' not found: there is no model 'suv'; name the folder"
    (found,) = condensed(_found("sdf.missing-file", text))
    assert found.message == text


def test_launch_files_read_and_not_run_are_counted() -> None:
    (found,) = condensed(_found("launch_ros2.static", "read, not run", "read, not run (of 3)"))
    assert found.message.startswith("2 launch files were read, not run: ")
    assert found.span is None


def test_packages_of_several_launch_files_are_joined() -> None:
    text = "packages that are not in this workspace: {}; what the launch takes"
    found = _found("launch_ros2.packages-elsewhere", text.format("b, joy"), text.format("a, joy"))
    assert "workspace: a, b, joy; " in condensed(found)[0].message


def test_nodes_that_are_not_compiled_are_listed() -> None:
    text = "Cannot locate node of type [{}] in package [bot]: it is compiled code"
    found = condensed(_found("launch.compiled-node", text.format("a"), text.format("b")))
    assert [item.message for item in found] == [
        "Cannot locate node of 2 types: they are compiled code that nothing builds: bot/a, bot/b"
    ]


def test_library_of_many_sensors_is_told_once() -> None:
    text = "plug-in '{}' (name '{}') is compiled code"
    names = (("libcliff.so", "left"), ("libbump.so", "b"), ("libcliff.so", "right"))
    found = condensed(_found("plugin.compiled", *(text.format(*item) for item in names)))
    assert [item.message.partition("'")[2][:8] for item in found] == ["libcliff", "libbump."]
    assert found[0].message.endswith("the same library in one more place")


def test_class_of_many_controllers_is_told_once() -> None:
    text = "'/spawner' cannot load controller '{}': Could not load class 'dog/Joint': it is not"
    (found,) = condensed(
        _found("doctor.controller-fails", *(text.format(name) for name in ("hip", "knee", "toe")))
    )
    assert found.message.endswith("the same class in 2 more places")


def test_places_looked_in_are_cut_to_three() -> None:
    places = "\n".join(f"    /folder/{index}" for index in range(9))
    text = f"'x' not found\n  looked in:\n{places}\n  the world goes on"
    (found,) = condensed(_found("sdf.missing-model", text))
    lines = found.message.split("\n")
    assert lines[-3:] == ["    /folder/2", "    … and 6 more", "  the world goes on"]


def test_plugins_that_are_built_in_are_left_to_the_table() -> None:
    assert condensed(_found("plugin.built-in", "plug-in 'a' is part of Gazelle")) == []


def test_robot_alone_stands_in_gazelles_empty_world(written: Write, examined: Examine) -> None:
    """Another package's empty.world has elements of its own that would be reported."""
    other = '<sdf version="1.6"><world name="w"><atmosphere type="adiabatic"/></world></sdf>'
    manifest = '<package format="2"><name>bot</name><version>1.0.0</version><export>'
    manifest += '<gazebo_ros gazebo_media_path="${prefix}"/></export></package>'
    link = '<link name="a"/>'
    folder = written(
        **{
            "package.xml": manifest,
            "worlds__empty.world": other,
            "robot.urdf": f"<robot name='r'>{link}</robot>",
        }
    )
    found = examined(folder, str(Path("robot.urdf"))).findings
    assert [item for item in found if item.span and "empty.world" in item.span.file] == []
