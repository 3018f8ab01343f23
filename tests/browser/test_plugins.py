"""Panels of the user's own, in the browser."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.studio import Server, Studio

pytestmark = pytest.mark.slow

_PANEL = """
from gazelle.studio.plugins import (
    Button, Checkbox, Choice, Image, Label, Number, Panel, Plot, Row, Slider, Table, TextInput
)
import numpy as np


class Speed(Panel):
    title = "Speed limit"
    group = "Robot Tools"
    module = "speed.js"
    widgets = (
        Slider("speed", min=0.0, max=2.0, unit="m/s"),
        Row(Button("stop"), Button("fail"), Button("lock"), title="Do"),
        Checkbox("lights"),
        Choice("gear", options=("low", "high")),
        Number("laps", value=3, min=0, max=9),
        TextInput("driver"),
        Label("seen", unit="m/s"),
        Plot("history", curves=("wanted", "seen"), unit="m/s"),
        Table("joints", columns=("name", "position")),
        Image("map"),
    )

    def start(self, node):
        self.node = node
        node.subscribe("/odom_speed", "std_msgs/Float64", self.on_odometry)
        self["joints"] = [("left", 0.5), ("right", -0.25)]
        self["map"] = np.full((24, 32, 3), 200, np.uint8)

    def on_odometry(self, message):
        self["seen"] = message.data
        self.add("history", self["speed"], message.data)

    def on_speed(self, value):
        self.node.publish("/limit", self.node.message("std_msgs/Float64", data=value))

    def on_stop(self):
        self["speed"] = 0.0
        self.on_speed(0.0)

    def on_fail(self):
        return 1 / 0

    def on_lock(self):
        self.change("speed", enabled=False)

    def on_driver(self, text):
        self["laps"] = len(text)

    def on_gear(self, gear):
        self.change("speed", max=2.0 if gear == "low" else 8.0)

    def on_message(self, value):
        self["driver"] = value["name"]
        self.send({"hello": value["name"]})
"""
_MODULE = """
export function mount(element, api) {
  const words = document.createElement('button');
  words.textContent = `speed ${api.get('speed')}`;
  words.className = 'mine';
  words.onclick = () => api.send({ name: 'Ada' });
  api.onChange((name, value) => { if (name === 'speed') words.textContent = `speed ${value}`; });
  api.onMessage((value) => { words.dataset.hello = value.hello; });
  element.append(words);
  return () => words.remove();
}
"""
_SCOUT = Path(__file__).parents[2] / "examples" / "scout_ws"
_KIND = "plugin:speed.Speed"


@pytest.fixture
def files(tmp_path: Path) -> Path:
    (tmp_path / "speed.py").write_text(_PANEL)
    (tmp_path / "speed.js").write_text(_MODULE)
    return tmp_path


@pytest.fixture
def site(bench: Any, files: Path) -> Any:
    """The bench, with a Studio of its own that knows the panel."""
    with Server(Studio(bench.graph), port=0) as server:
        server.studio.shown_panels.name_file(str(files / "speed.py"))
        bench.url = server.url
        yield bench


def test_a_panel_is_found_in_the_menu_and_its_slider_reaches_the_robot(
    site: Any, look: Any
) -> None:
    limits = site.listen("/limit", "std_msgs/msg/Float64")
    seen = look(site.url, "rqt_graph")
    seen.page.get_by_role("button", name="Panels").click()
    seen.page.get_by_role("menuitem", name="Speed limit").click()
    panel = seen.panel(_KIND)
    slider = panel.get_by_role("slider", name="Speed", exact=True)
    slider.focus()
    slider.press("End")
    site.eventually(lambda: limits and limits[-1].data == 2.0)
    panel.get_by_label("Speed value").fill("0.75")
    panel.get_by_label("Speed value").press("Enter")
    site.eventually(lambda: limits[-1].data == 0.75)
    panel.get_by_role("button", name="Stop").click()
    site.eventually(lambda: limits[-1].data == 0.0)
    site.eventually(lambda: slider.input_value() == "0")
    seen.shot("whole")


def test_every_kind_of_widget_shows_and_acts(site: Any, look: Any) -> None:
    seen = look(site.url, _KIND, size=(1000, 900))
    panel = seen.panel(_KIND)
    site.keep_publishing("/odom_speed", "std_msgs/msg/Float64", lambda t: {"data": 0.25})
    site.eventually(lambda: panel.get_by_label("Seen", exact=True).inner_text() == "0.25")
    assert panel.get_by_role("table", name="Joints").inner_text().split() == [
        "name", "position", "left", "0.5", "right", "-0.25",
    ]  # fmt: skip
    panel.get_by_label("Driver").fill("Grace")
    panel.get_by_label("Driver").press("Enter")
    site.eventually(lambda: panel.get_by_label("Laps").input_value() == "5")
    panel.get_by_label("Gear").select_option("high")
    site.eventually(lambda: panel.get_by_role("slider").get_attribute("max") == "8")
    panel.get_by_label("Lights").check()
    picture = panel.get_by_role("img", name="Map")
    site.eventually(lambda: picture.evaluate("image => image.naturalWidth") == 32)
    site.eventually(lambda: panel.locator(".u-wrap").count() == 1)
    panel.get_by_role("button", name="Lock").click()
    site.eventually(lambda: panel.get_by_role("slider").is_disabled())
    seen.shot("widgets")


def test_two_pages_share_a_panels_state(site: Any, look: Any) -> None:
    one, other = look(site.url, _KIND), look(site.url, _KIND)
    one.panel(_KIND).get_by_label("Speed value").fill("1.5")
    one.panel(_KIND).get_by_label("Speed value").press("Enter")
    field = other.panel(_KIND).get_by_label("Speed value")
    site.eventually(lambda: field.input_value() == "1.5")


def test_an_error_is_shown_with_its_place_and_the_panel_goes_on(
    site: Any, look: Any, files: Path
) -> None:
    limits = site.listen("/limit", "std_msgs/msg/Float64")
    seen = look(site.url, _KIND)
    panel = seen.panel(_KIND)
    panel.get_by_role("button", name="Fail").click()
    alert = panel.get_by_role("alert")
    alert.wait_for()
    line = next(n for n, text in enumerate(_PANEL.splitlines(), 1) if "1 / 0" in text)
    place = f"{files / 'speed.py'}:{line} in on_fail(): ZeroDivisionError: division by zero"
    assert place in alert.inner_text()
    panel.get_by_role("button", name="Fail").click()
    site.eventually(lambda: "(2 times)" in alert.inner_text())
    panel.get_by_role("button", name="Stop").click()
    site.eventually(lambda: limits and limits[-1].data == 0.0)
    seen.shot("error")
    panel.get_by_role("button", name="Dismiss").click()
    assert not alert.is_visible()


def test_a_changed_file_is_reloaded_by_its_button(site: Any, look: Any, files: Path) -> None:
    seen = look(site.url, _KIND)
    panel = seen.panel(_KIND)
    panel.get_by_role("button", name="Lock").wait_for()
    file = files / "speed.py"
    file.write_text(_PANEL.replace('Button("lock")', 'Button("lock", text="Lock it")'))
    os.utime(file, ns=(1, file.stat().st_mtime_ns + 1_000_000_000))
    panel.get_by_role("button", name="File changed: reload").click()
    panel.get_by_role("button", name="Lock it").wait_for()
    assert panel.get_by_role("button", name="Reload").is_visible()


def test_an_es_module_draws_and_talks_to_the_panels_code(site: Any, look: Any) -> None:
    seen = look(site.url, _KIND)
    panel = seen.panel(_KIND)
    mine = panel.locator(".mine")
    mine.wait_for()
    panel.get_by_label("Speed value").fill("1")
    panel.get_by_label("Speed value").press("Enter")
    site.eventually(lambda: mine.inner_text() == "speed 1")
    mine.click()
    site.eventually(lambda: panel.get_by_label("Driver").input_value() == "Ada")
    site.eventually(lambda: mine.get_attribute("data-hello") == "Ada")


def test_a_plug_in_of_rqt_is_answered_with_its_port(
    bench: Any, look: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from tests.studio.plugins.rqt.package import write_package

    write_package(tmp_path)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    seen = look(bench.url, "rqt_graph")
    seen.page.get_by_role("button", name="Panels").click()
    entry = seen.page.get_by_role("menuitem", name="Arm Tester")
    entry.wait_for()
    assert "faded" in (entry.get_attribute("class") or "")
    entry.click()
    panel = seen.panel("rqt-plugin:rqt_arm/rqt_arm.arm_tester.ArmTesterPlugin")
    panel.get_by_role("table", name="Widgets").wait_for()
    assert 'Slider("speed_slider", min=0, max=50, step=1)' in panel.inner_text()
    assert "class ArmTester(Panel):" in panel.get_by_label("Python code").inner_text()
    seen.shot("port")


def test_the_scouts_panel_drives_the_running_robot(gazelle: Any, look: Any) -> None:
    """Named on the command line; the robot goes ahead, and the panel stops it before a wall."""
    launched = gazelle("roslaunch", "scout_robot", "scout.launch", cwd=_SCOUT)
    launched.wait_for_line("spawn_scout")
    panel_file = str(_SCOUT / "src" / "scout_robot" / "panels" / "cruise.py")
    words = ("studio", "--port", "0", "--no-browser", "--panel", panel_file)
    line = gazelle(*words, port=launched.port).wait_for_line("Studio: ")
    seen = look(line.split("Studio: ")[1].strip())
    panel = seen.panel("plugin:cruise.Cruise")
    go, stop = (panel.get_by_role("button", name=name, exact=True) for name in ("Go", "Stop"))
    panel.get_by_label("Speed value").fill("0.5")
    panel.get_by_label("Speed value").press("Enter")
    expect = pytest.importorskip("playwright.sync_api").expect
    expect(panel.get_by_label("Free way ahead", exact=True)).not_to_have_text(
        "–", timeout=stretched() * 1000
    )
    go.click()
    expect(stop).to_be_enabled()
    driven = panel.get_by_label("driven", exact=True)
    expect(driven).to_have_text(re.compile(r"0\.[345]\d*"), timeout=stretched() * 1000)
    seen.shot("driving")
    panel.get_by_label("Stop before value").fill("2")
    panel.get_by_label("Stop before value").press("Enter")
    expect(go).to_be_enabled(timeout=stretched() * 1000)
    expect(driven).to_have_text(re.compile(r"-?(0\.0\d*|0|.*e-\d+)"), timeout=stretched() * 1000)
