"""A config package made in the page, step by step, with keyboard and mouse."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.motion.setup_assistant.robots import chain, link

pytestmark = pytest.mark.slow

_ROBOT = f'<robot name="picker">{link("base")}{chain("", "base", 4)}</robot>'


def test_a_package_is_made_from_a_urdf(
    bench: Any, look: Callable[..., Any], tmp_path: Path
) -> None:
    (tmp_path / "picker.urdf").write_text(_ROBOT, encoding="utf-8")
    seen = look(bench.url, "moveit_setup_assistant", size=(1400, 860))
    panel = seen.panel("moveit_setup_assistant")
    steps = panel.get_by_role("tablist", name="Steps of the Setup Assistant")

    # Without a robot every step says what to do first.
    steps.get_by_role("tab", name="Planning Groups").click()
    panel.get_by_text("Load a robot first: step Start.").wait_for()
    steps.get_by_role("tab", name="Planning Groups").press("Home")
    panel.get_by_label("Robot file").fill("picker.urdf")
    panel.get_by_role("button", name="Load").click()
    panel.get_by_text("picker: 5 links, 4 joints that move").wait_for()
    seen.shot("start")

    # The keyboard alone: down to the next step, Tab into it.
    steps.get_by_role("tab", name="Start").press("ArrowDown")
    panel.get_by_label("Random configurations").fill("200")
    panel.get_by_role("button", name="Find pairs").click()
    panel.get_by_text(re.compile(r"pairs are not checked: 4 Adjacent, \d Never")).wait_for()
    box = panel.get_by_label("Do not check base and link_4")
    was = box.is_checked()
    box.click()
    bench.eventually(lambda: panel.get_by_label("Do not check base and link_4").is_checked() != was)
    panel.get_by_role("button", name="Matrix").click()
    panel.get_by_role("button", name="base and link_1: Adjacent").first.wait_for()
    seen.shot("collisions")

    steps.get_by_role("tab", name="Planning Groups").click()
    panel.get_by_label("Last link of the chain").select_option("link_3")
    seen.shot("groups")
    steps.get_by_role("tab", name="Robot Poses").click()
    panel.get_by_role("button", name="arm: home").wait_for()
    panel.get_by_label("joint_2 position").fill("0.7")
    panel.get_by_label("joint_2 position").press("Enter")
    bench.eventually(lambda: panel.get_by_label("joint_2", exact=True).input_value() == "0.7")
    seen.shot("poses")
    for name in ("Virtual Joints", "End Effectors", "Passive Joints", "Hardware", "Controllers"):
        steps.get_by_role("tab", name=name).click()
        panel.get_by_role("heading", name=name).wait_for()
        seen.shot(name)
    steps.get_by_role("tab", name="Author").click()
    panel.get_by_label("Author", exact=True).last.fill("Ada")
    panel.get_by_label("Author", exact=True).last.press("Enter")

    steps.get_by_role("tab", name="Write Package").click()
    panel.get_by_text("config/picker.srdf").wait_for()
    panel.get_by_role("button", name="Write package").click()
    panel.get_by_text("gazelle roslaunch picker_moveit_config demo.launch").wait_for()
    seen.shot("written")
    folder = tmp_path / "picker_moveit_config"
    srdf = (folder / "config" / "picker.srdf").read_text(encoding="utf-8")
    assert '<chain base_link="base" tip_link="link_3"/>' in srdf
    assert '<joint name="joint_2" value="0.7"/>' in srdf
    assert "Ada" in (folder / "package.xml").read_text(encoding="utf-8")
