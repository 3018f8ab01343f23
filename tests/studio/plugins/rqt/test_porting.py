"""What the page says to plug-ins of rqt."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.patience import stretched
from tests.studio.plugins.rqt.package import UI, write_package

from gazelle.launch.environment import drop_in_folder
from gazelle.studio.errors import StudioError
from gazelle.studio.plugins.rqt.plugin_xml import rqt_plugins
from gazelle.studio.plugins.rqt.porting import how_to_port
from gazelle.studio.plugins.rqt.ui_files import form_widgets
from gazelle.workspace import Workspace


def _workspace(folder: Path) -> Workspace:
    return Workspace.discover(environ={"ROS_PACKAGE_PATH": str(folder)}, cwd=folder)


def test_an_exported_plug_in_is_found_with_its_source(tmp_path: Path) -> None:
    folder = write_package(tmp_path)
    (plugin,) = rqt_plugins(_workspace(tmp_path))
    assert plugin.name == "rqt_arm/rqt_arm.arm_tester.ArmTesterPlugin"
    assert plugin.label == "Arm Tester"
    assert plugin.source == folder / "src" / "rqt_arm" / "arm_tester.py"
    assert (plugin.manifest, plugin.line) == (folder / "plugin.xml", 2)


def test_a_plugin_xml_that_nobody_exports_is_found_too_and_gazebos_is_none(tmp_path: Path) -> None:
    folder = write_package(tmp_path)
    manifest = folder / "package.xml"
    text = manifest.read_text()
    manifest.write_text(
        text.replace('<export><rqt_gui plugin="${prefix}/plugin.xml"/></export>', "")
    )
    assert [one.package for one in rqt_plugins(_workspace(tmp_path))] == ["rqt_arm"]
    plugin = folder / "plugin.xml"
    plugin.write_text(
        plugin.read_text().replace("rqt_gui_py::Plugin", "nav_core::BaseLocalPlanner")
    )
    assert rqt_plugins(_workspace(tmp_path)) == []


def test_each_widget_of_the_form_has_one_of_ours_with_its_limits(tmp_path: Path) -> None:
    file = tmp_path / "arm.ui"
    file.write_text(UI)
    found = {one.name: one for one in form_widgets(file)}
    assert {name: one.ours for name, one in found.items()} == {
        "speed_slider": 'Slider("speed_slider", min=0, max=50, step=1)',
        "gain": 'Number("gain", value=0.0, min=0, max=2.5, step=0.1, unit="Nm")',
        "go-button": 'Button("go_button", text="Go")',
        "mode": 'Choice("mode", options=("fast", "slow"))',
        "drawing": "",
        "joints": 'Table("joints", columns=("Joint", "Angle"))',
    }
    assert (
        found["speed_slider"].line
        == UI.splitlines().index('       <widget class="QSlider" name="speed_slider">') + 1
    )
    assert "ES module" in found["drawing"].note


def test_the_panel_to_begin_with_runs_and_has_the_forms_rows(tmp_path: Path) -> None:
    folder = write_package(tmp_path)
    answer = how_to_port("rqt_arm", _workspace(tmp_path))
    assert answer["target"] == str(folder / "panels" / "arm_tester.py")
    assert [Path(form["file"]).name for form in answer["forms"]] == ["arm_tester.ui"]
    made: dict[str, object] = {}
    exec(compile(ast.parse(answer["code"]), "arm_tester.py", "exec"), made)
    panel = made["ArmTester"]
    from gazelle.studio.plugins.panel_state import checked_layout

    layout = checked_layout(panel)  # type: ignore[arg-type]
    group = layout[0]
    assert (type(group).__name__, group.title) == ("Column", "Speed")  # type: ignore[union-attr]
    (row,) = group.children  # type: ignore[union-attr]
    assert type(row).__name__ == "Row"
    assert [one.name for one in row.children] == ["speed_slider", "gain"]  # type: ignore[union-attr]
    assert "def on_go_button(self):" in answer["code"]
    assert "# drawing: Image for pictures" in answer["code"]


def test_a_name_that_no_plug_in_has_names_those_that_exist(tmp_path: Path) -> None:
    write_package(tmp_path)
    with pytest.raises(StudioError, match="there is no plug-in of rqt 'rqt_arms'") as caught:
        how_to_port("rqt_arms", _workspace(tmp_path))
    assert caught.value.known == ("rqt_arm/rqt_arm.arm_tester.ArmTesterPlugin",)


def test_a_form_that_is_no_xml_leaves_a_panel_with_a_hint(tmp_path: Path) -> None:
    folder = write_package(tmp_path)
    (folder / "resource" / "arm_tester.ui").write_text("<ui><widget")
    code = how_to_port("rqt_arm", _workspace(tmp_path))["code"]
    assert "# Slider(" in code
    ast.parse(code)


def test_the_imports_of_a_plug_in_raise_one_error_that_says_how() -> None:
    lines = (
        "from rqt_gui_py.plugin import Plugin",
        "from python_qt_binding.QtWidgets import QWidget",
        "from rqt_gui.main import Main",
        "import qt_gui",
    )
    code = "import traceback\n" + "".join(
        f"try:\n    {line}\nexcept ImportError:\n    traceback.print_exc()\n" for line in lines
    )
    done = _run(code, drop_in_folder())
    assert done.returncode == 0, done.stderr
    for line in lines:
        name = line.split()[1].partition(".")[0]
        text = f"ImportError: '{name}' is part of rqt, whose plug-ins draw with Qt"
        assert done.stderr.count(text) == 1
    assert done.stderr.count("fix: write the window as a panel") == len(lines)
    assert "ModuleNotFoundError" not in done.stderr


def test_an_installed_qt_is_used(tmp_path: Path) -> None:
    package = tmp_path / "python_qt_binding"
    package.mkdir()
    (package / "__init__.py").write_text("QT_BINDING = 'pyqt'\n")
    (package / "QtWidgets.py").write_text("class QWidget: pass\n")
    line = "import python_qt_binding as b; from python_qt_binding.QtWidgets import QWidget; "
    done = _run(line + "print(b.QT_BINDING, QWidget.__name__)", drop_in_folder(), tmp_path)
    assert done.stdout == "pyqt QWidget\n", done.stderr


def _run(code: str, *folders: Path) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join(str(folder) for folder in folders)
    return subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=stretched(),
        check=False,
    )
