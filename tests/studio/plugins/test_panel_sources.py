"""Finding panels without running them."""

from __future__ import annotations

import importlib.metadata
import sys
from pathlib import Path

import pytest
from tests.studio.plugins.rqt.package import write_package

from gazelle.errors import GazelleError
from gazelle.studio.plugins.panel_sources import (
    Source,
    Unreadable,
    all_sources,
    named_file,
    own_panel,
    panel_classes,
)
from gazelle.workspace import Workspace

_PACKAGE = """<package format="3">
  <name>scout</name><version>0.1.0</version><description>Scout</description>
  <maintainer email="a@b.c">A</maintainer><license>BSD</license>
</package>
"""
_PANEL = """
raise SystemExit("listing runs nothing")
from gazelle.studio.plugins import Panel, Slider


class Speed(Panel):
    title = "Speed limit"
    group: str = "Robot Tools"
    about = "Limits " + "it"
    widgets = (Slider("speed", min=0, max=1),)


class Faster(Speed):
    pass


class _Base(Panel):
    pass


class Other:
    pass
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "ws" / "scout"
    (folder / "panels").mkdir(parents=True)
    (folder / "package.xml").write_text(_PACKAGE)
    (folder / "panels" / "speed.py").write_text(_PANEL)
    return folder


def _sources(package: Path, *named: Source) -> dict[str, Source]:
    environ = {"ROS_PACKAGE_PATH": str(package.parent)}
    return all_sources(named, Workspace.discover(environ=environ, cwd=package))


def test_panels_of_a_package_are_listed_and_nothing_of_them_runs(package: Path) -> None:
    found = _sources(package)
    assert {name: source.title for name, source in found.items()} == {
        "scout.Speed": "Speed limit",
        "scout.Faster": "Faster",
    }
    speed = found["scout.Speed"]
    assert speed.texts == {"title": "Speed limit", "group": "Robot Tools"}
    assert (speed.origin, speed.line) == ("package scout", 6)


def test_two_classes_of_one_name_are_told_apart_by_their_files(package: Path) -> None:
    (package / "panels" / "zz.py").write_text(_PANEL.split("class Faster", maxsplit=1)[0])
    assert list(_sources(package)) == ["scout.Speed", "scout.Faster", "scout.zz.Speed"]


def test_a_file_that_cannot_be_read_is_listed_with_its_line(package: Path) -> None:
    file = package / "panels" / "broken.py"
    file.write_text("from gazelle.studio.plugins import Panel\n\nclass A(Panel:\n")
    found = _sources(package)["scout.broken"]
    assert found.problem == f"{file}:3: SyntaxError: invalid syntax"
    file.write_text("print 'a script of Python 2 that knows nothing of panels'\n")
    assert "scout.broken" not in _sources(package)


@pytest.mark.parametrize(
    "head",
    [
        "from gazelle.studio.plugins import Panel as P\nclass A(P): ...",
        "import gazelle.studio.plugins as g\nclass A(g.Panel): ...",
        "import gazelle.studio.plugins\nclass A(gazelle.studio.plugins.Panel): ...",
        "from gazelle.studio import plugins\nclass A(plugins.Panel): ...",
        "from gazelle.studio.plugins import *\nclass A(Panel): ...",
    ],
)
def test_every_way_to_import_the_class_is_understood(tmp_path: Path, head: str) -> None:
    file = tmp_path / "a.py"
    file.write_text(head)
    classes = panel_classes(file)
    assert not isinstance(classes, Unreadable)
    assert [one.name for one in classes] == ["A"]


def test_a_class_of_another_panel_is_none(tmp_path: Path) -> None:
    file = tmp_path / "a.py"
    file.write_text("# gazelle.studio\nfrom bokeh import Panel\nclass A(Panel): ...")
    assert panel_classes(file) == ()


def test_entry_points_are_read_without_importing_their_package(
    tmp_path: Path, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    module = tmp_path / "site" / "own_panels"
    module.mkdir(parents=True)
    (module / "__init__.py").write_text("raise SystemExit('listing imports nothing')\n")
    (module / "speed.py").write_text(_PANEL)
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    points = [
        importlib.metadata.EntryPoint("my/speed", "own_panels.speed:Speed", "gazelle.panels"),
        importlib.metadata.EntryPoint("gone", "own_panels.gone:Speed", "gazelle.panels"),
    ]
    monkeypatch.setattr(importlib.metadata, "entry_points", lambda group: points)
    found = _sources(package)
    assert found["my.speed"].title == "Speed limit"
    assert found["my.speed"].module_name == "own_panels.speed"
    assert found["gone"].problem.endswith("there is no module own_panels.gone")
    assert "own_panels" not in sys.modules


def test_a_file_on_the_command_line_is_checked(tmp_path: Path) -> None:
    file = tmp_path / "speed.py"
    file.write_text(_PANEL)
    assert [one.name for one in named_file(str(file))] == ["speed.Speed", "speed.Faster"]
    assert [one.name for one in named_file(f"{file}:Faster")] == ["speed.Faster"]
    with pytest.raises(GazelleError, match="the file has no panel 'Sped'; it has Speed"):
        named_file(f"{file}:Sped")
    with pytest.raises(GazelleError, match=r"--panel .*gone\.py: there is no file"):
        named_file(str(tmp_path / "gone.py"))
    file.write_text("x = 1\n")
    with pytest.raises(GazelleError, match="has no class that derives from gazelle"):
        named_file(str(file))
    file.write_text("# gazelle.studio\nx = (\n")
    with pytest.raises(GazelleError, match=r"speed\.py:2: SyntaxError"):
        named_file(str(file))


def test_rqt_s_means_a_panel_or_a_plug_in_of_the_users(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_package(tmp_path / "ws")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws"))
    assert own_panel("Speed") == own_panel("scout.Speed") == "plugin:scout.Speed"
    kind = "rqt-plugin:rqt_arm/rqt_arm.arm_tester.ArmTesterPlugin"
    assert own_panel("rqt_arm") == own_panel("rqt_arm.arm_tester.ArmTesterPlugin") == kind
    assert own_panel("rqt_plot") == ""
