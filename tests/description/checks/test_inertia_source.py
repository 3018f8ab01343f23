from __future__ import annotations

from pathlib import Path

from gazelle.description.checks.inertia_source import read_checked_source
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


def test_every_link_of_the_sample_robots_is_found_again(workspaces_dir: Path) -> None:
    """Raw values are read from the elements; a link without one would be judged as mended."""
    workspace = Workspace.discover(cwd=workspaces_dir / "turtlebot3_ws")
    file = workspaces_dir / (
        "turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf/turtlebot3_waffle.urdf.xacro"
    )
    source = read_checked_source(file, workspace=workspace, diagnostics=Diagnostics())
    links = source.models[0].links
    assert len(links) > 10
    assert all(source.find_tag(link) is not None for link in links)
