"""Files of a package that are no robots on their own."""

from __future__ import annotations

from pathlib import Path

from tests.doctor.conftest import Examine, Write, codes

from gazelle.doctor import Report, examine
from gazelle.workspace import Workspace

XACRO = 'xmlns:xacro="http://ros.org/wiki/xacro"'
MACRO = '<xacro:macro name="eye" params="at"><link name="${at}_eye"/></xacro:macro>'


def told(report: Report) -> list[str]:
    """Return codes of warnings and errors that are not of the package's manifest."""
    return [code for code in codes(report) if code != "package.manifest"]


def test_robot_with_nothing_in_it_is_a_placeholder(written: Write, examined: Examine) -> None:
    folder = written(**{"urdf__empty.urdf": "<robot>\n<!-- yours comes here -->\n</robot>"})
    assert told(examined(folder, "bot")) == []
    assert "urdf.no-links" in told(examined(folder, "bot", "empty.urdf"))


def test_robot_with_a_name_and_nothing_else_is_told(written: Write, examined: Examine) -> None:
    folder = written(**{"urdf__empty.urdf": '<robot name="r"></robot>'})
    assert "urdf.no-links" in told(examined(folder, "bot"))


def test_pieces_for_xacro_have_any_outermost_element(written: Write, examined: Examine) -> None:
    robot = f'<robot name="r" {XACRO}><xacro:include filename="eye.xacro"/><link name="a"/></robot>'
    folder = written(
        **{
            "urdf__eye.xacro": f"<root {XACRO}>{MACRO}</root>",
            "urdf__ear.xacro": f"<macros {XACRO}>{MACRO}</macros>",
            "urdf__robot.urdf.xacro": robot,
        }
    )
    assert "doctor.unknown-file" not in told(examined(folder, "bot"))


def test_misspelt_robot_is_told(written: Write, examined: Examine) -> None:
    folder = written(**{"urdf__r.xacro": f'<robto name="r" {XACRO}><link name="a"/></robto>'})
    assert told(examined(folder, "bot")) == ["doctor.unknown-file"]


def test_default_without_files_asks_for_a_value(written: Write, examined: Examine) -> None:
    robot = f'<robot name="r" {XACRO}><xacro:arg name="kind" default="x9"/><link name="a"/>'
    robot += '<xacro:include filename="$(arg kind)/limits.xacro"/></robot>'
    folder = written(**{"urdf__r.xacro": robot, "urdf__x1__limits.xacro": f"<robot {XACRO}/>"})
    assert told(examined(folder, "bot")) == []
    (found,) = (item for item in examined(folder, "bot").findings if "x9" in item.message)
    assert found.code == "doctor.needs-arguments"
    assert "there are no files for kind:=x9, which is the default" in found.message
    assert found.fix.endswith("r.xacro kind:=…")
    assert told(examined(folder, "bot", "r.xacro")) == ["xacro.file-missing"]


def test_empty_default_in_a_files_name_asks_for_a_value(written: Write, examined: Examine) -> None:
    macro = '<xacro:macro name="load" params="arm"><xacro:include filename="${arm}/a.xacro"/>'
    robot = f'<robot name="r" {XACRO}><xacro:arg name="arm" default=""/>{macro}</xacro:macro>\n'
    robot += '<xacro:load arm="$(arg arm)"/><link name="a"/></robot>'
    folder = written(**{"urdf__r.xacro": robot})
    assert told(examined(folder, "bot")) == []
    (found,) = (item for item in examined(folder, "bot").findings if "arm:=," in item.message)
    assert found.code == "doctor.needs-arguments"


def test_model_is_looked_at_once_for_its_config_and_its_file(
    written: Write, examined: Examine
) -> None:
    config = '<model><name>m</name><sdf version="1.6">m.sdf</sdf></model>'
    model = '<sdf version="1.6"><model name="m"><link name="l"><visul/></link></model></sdf>'
    folder = written(**{"models__m__model.config": config, "models__m__m.sdf": model})
    workspace = Workspace.discover(environ={"HOME": str(folder)}, cwd=folder)
    seen: list[str] = []
    examine(("bot",), workspace=workspace, progress=seen.append, cwd=folder)
    assert [Path(text).name for text in seen if "models" in text] == ["model.config"]
    assert "xml.unknown-tag" in told(examined(folder, "bot"))
