from __future__ import annotations

from pathlib import Path

from tests.shared_files import needs_shared

from gazelle.description.checks import check_description
from gazelle.description.checks.source_elements import read_checked_source
from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace

from .conftest import judged
from .test_inertia import SDF_TENSOR, sdf


def test_links_of_included_models_are_found_in_their_own_files(judge, tmp_path: Path) -> None:
    folder = tmp_path / "thing"
    folder.mkdir()
    wrong = SDF_TENSOR.replace("0.1<", "0.02<")
    (folder / "model.sdf").write_text(sdf("<mass>12</mass>" + wrong), encoding="utf-8")
    (folder / "model.config").write_text(
        "<model><name>thing</name><sdf version='1.6'>model.sdf</sdf></model>", encoding="utf-8"
    )
    world = tmp_path / "w.world"
    world.write_text(
        '<sdf version="1.6"><world name="w"><include><uri>thing</uri></include></world></sdf>',
        encoding="utf-8",
    )
    found = judged(world)
    assert found.codes == ["inertia.triangle"], [str(item) for item in found.read]
    assert found.place[0] == "model.sdf"
    assert judged(folder).codes == ["inertia.triangle"]


def test_model_that_stands_twice_is_judged_once(judge) -> None:
    one = sdf("<mass>12</mass>" + SDF_TENSOR.replace("0.1<", "0.02<"))
    model = one[one.index("<model") : one.index("</sdf>")]
    other = model.replace('name="m"', 'name="n"')
    found = judge(f'<sdf version="1.6"><world name="w">{model}{other}</world></sdf>', "w.world")
    assert [record.name for record in found.records] == ["m::a", "n::a"]
    assert [item.diagnostic.code for item in found.findings] == ["inertia.triangle"] * 2


def test_other_documents_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "a.launch"
    file.write_text("<launch/>", encoding="utf-8")
    diagnostics = Diagnostics()
    source = read_checked_source(file, workspace=None, diagnostics=diagnostics)
    assert source.models == ()
    assert "the outermost element of" in next(iter(diagnostics)).message


@needs_shared
def test_every_link_of_the_sample_robots_is_found_again(workspaces_dir: Path) -> None:
    _find_links(
        workspaces_dir / "turtlebot3_ws",
        "src/turtlebot3/turtlebot3_description/urdf/turtlebot3_waffle.urdf.xacro",
        more_than=10,
    )


def test_every_link_of_the_examples_robots_is_found_again(examples_dir: Path) -> None:
    _find_links(examples_dir / "scout_ws", "src/scout_robot/urdf/scout.urdf.xacro", more_than=9)
    _find_links(
        examples_dir / "arm_ws", "src/heron_description/urdf/heron.urdf.xacro", more_than=10
    )


def _find_links(folder: Path, name: str, *, more_than: int) -> None:
    """Raw values are read from the elements; a link without one would be judged as mended."""
    source = read_checked_source(
        folder / name, workspace=Workspace.discover(cwd=folder), diagnostics=Diagnostics()
    )
    links = source.models[0].links
    assert len(links) > more_than
    assert all(source.find_tag(link) is not None for link in links)


def test_inertial_of_a_macro_is_not_missing_when_only_the_model_is_given(tmp_path: Path) -> None:
    """The file has the macro's call in the link, the reader the <inertial> that came of it."""
    file = tmp_path / "robot.urdf.xacro"
    products = 'ixy="0" ixz="0" iyz="0"'
    moments = f'<inertia ixx="${{x}}" iyy="0.1" izz="0.05" {products}/>'
    block = f'<inertial><mass value="12"/>{moments}</inertial>'
    file.write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f'<xacro:macro name="block" params="x">{block}</xacro:macro>\n'
        '<link name="a"><xacro:block x="0.13"/></link>\n'
        '<link name="b"><xacro:block x="0.02"/></link>\n'
        '<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>\n</robot>',
        encoding="utf-8",
    )
    (model,) = load_models(file, workspace=None, diagnostics=Diagnostics())
    found = Diagnostics()
    check_description(model, diagnostics=found)
    # b breaks the triangle inequality, as written: the reader has mended it.
    (item,) = (item for item in found if item.code.startswith("inertia"))
    assert item.code == "inertia.triangle"
    assert "link 'b'" in item.message
