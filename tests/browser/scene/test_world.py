"""The world in the page: what is seen, selected, moved, inserted, pushed and deleted."""

from __future__ import annotations

from typing import Any

import pytest
from tests.browser.scene.gazebo_page import GazeboPage

pytestmark = pytest.mark.slow

_CART = """<sdf version="1.6"><model name="my_robot">
  <link name="body"><pose>0 0 1 0 0 0</pose><inertial><mass>50</mass></inertial>
    <visual name="v"><geometry><box><size>0.4 0.3 0.2</size></box></geometry></visual>
    <collision name="c"><geometry><box><size>0.4 0.3 0.2</size></box></geometry></collision></link>
  <link name="wheel"><pose>0 0.2 1 0 0 0</pose>
    <visual name="v"><geometry><sphere><radius>0.1</radius></sphere></geometry></visual></link>
  <joint name="hinge" type="revolute"><parent>body</parent><child>wheel</child>
    <axis><xyz>0 1 0</xyz></axis></joint></model></sdf>"""


@pytest.fixture
def box(gazebo: GazeboPage) -> GazeboPage:
    """Gazebo with a box that the toolbar inserted."""
    gazebo.tool("Insert a box")
    gazebo.eventually(lambda: gazebo.report()["selected"] == {"model": "box"})
    gazebo.seen.page.evaluate(
        "gazelle.look({focal: [0, 0, 0.5], distance: 6, yaw: -0.9, pitch: 0.5}, 'gazebo')"
    )
    gazebo.tool("Select")
    return gazebo


def test_inserted_box_is_drawn_where_the_engine_has_it(box: GazeboPage) -> None:
    assert "box" in box.report()["models"]
    engine = box.simulation.engine.model_pose("box")
    assert box.pose("box::link")[:3] == pytest.approx(engine.position_m, abs=1e-3)
    box.seen.shot()


def test_click_selects_in_view_and_tree_and_escape_keeps_it(box: GazeboPage) -> None:
    box.seen.page.evaluate("document.querySelector('[data-panel=gazebo] canvas').focus()")
    box.panel("entities").get_by_role("treeitem", name="ground_plane static").click()
    assert box.report()["selected"] == {"model": "ground_plane"}
    box.click("box::link")
    box.eventually(lambda: box.report()["selected"] == {"model": "box"})
    assert box.report()["highlighted"] == 1
    row = box.panel("entities").get_by_role("treeitem", name="box model")
    assert row.get_attribute("aria-selected") == "true"
    box.click("box::link")
    box.eventually(lambda: box.report()["selected"] == {"model": "box", "link": "link"})


def test_gizmo_drags_the_model_in_the_engine(box: GazeboPage) -> None:
    box.seen.page.evaluate("gazelle.look({kind: 'Orbit', yaw: -1.5708, pitch: 0.4}, 'gazebo')")
    before = box.simulation.engine.model_pose("box").position_m
    box.tool("Translate")
    # The handle along +x lies to the right of the middle when one looks along +y.
    at = box.seen.page.evaluate(
        f"gazelle.project([{before[0] + 0.25}, {before[1]}, {before[2]}], 'gazebo')"
    )
    box.drag((at["x"], at["y"]), (at["x"] + 150, at["y"]))
    box.eventually(lambda: box.simulation.engine.model_pose("box").position_m[0] > before[0] + 0.3)
    after = box.simulation.engine.model_pose("box").position_m
    assert after[1] == pytest.approx(before[1], abs=1e-3)
    assert after[2] == pytest.approx(before[2], abs=1e-3)
    box.eventually(lambda: abs(box.pose("box::link")[0] - after[0]) < 1e-3)


def test_view_modes_draw_what_cannot_be_seen(box: GazeboPage) -> None:
    for name, mode in (
        ("Collisions", "collisions"), ("Inertias", "inertias"), ("Center of Mass", "com"),
        ("Link Frames", "frames"), ("Bounding Boxes", "boxes"),
    ):  # fmt: skip
        assert box.overlays(mode) == 0
        box.view(name)
        assert box.overlays(mode) >= 1
    box.view("Wireframe")
    box.view("Transparent")
    box.seen.shot()
    box.view("Collisions")
    assert box.overlays("collisions") == 0


def test_context_menu_shows_modes_of_one_model_and_deletes(box: GazeboPage) -> None:
    box.click("box::link", button="right")
    menu = box.seen.page.get_by_role("menu", name="box")
    menu.get_by_role("menuitemcheckbox", name="Link Frames").click()
    assert box.overlays("frames") == 1
    box.click("box::link", button="right")
    menu.get_by_role("menuitem", name="Follow").click()
    assert box.report()["following"] is True
    box.click("box::link", button="right")
    menu.get_by_role("menuitem", name="Delete").click()
    box.eventually(lambda: "box" not in box.report()["models"])
    assert [model.name for model in box.simulation.engine.world.models] == ["ground_plane"]


def test_inspector_types_a_pose_and_a_mass(box: GazeboPage) -> None:
    panel = box.panel("inspector")
    field = panel.get_by_label("Pose x (m)")
    field.fill("2.5")
    field.press("Enter")
    box.eventually(lambda: abs(box.simulation.engine.model_pose("box").position_m[0] - 2.5) < 1e-6)
    box.eventually(lambda: abs(box.pose("box::link")[0] - 2.5) < 1e-4)


def test_wrench_dialog_pushes_a_link(box: GazeboPage) -> None:
    box.simulation.unpause()
    box.click("box::link", button="right")
    box.seen.page.get_by_role("menuitem", name="Apply Force/Torque…").click()
    dialog = box.seen.page.get_by_role("dialog", name="Apply Force/Torque: box")
    dialog.get_by_label("Force x (N)").fill("200")
    dialog.get_by_role("button", name="Apply Force", exact=True).click()
    x = box.simulation.engine.model_pose("box").position_m[0]
    box.eventually(lambda: box.simulation.engine.model_pose("box").position_m[0] > x + 0.1)
    box.view("Contacts")
    box.eventually(lambda: box.report()["contacts"] >= 1)


def test_dropped_sdf_is_moved_by_a_tenth_of_a_newton_metre(gazebo: GazeboPage) -> None:
    gazebo.seen.page.evaluate(
        """text => {
          const files = new DataTransfer();
          files.items.add(new File([text], 'my_robot.sdf'));
          const panel = document.querySelector('[data-panel=gazebo] .scene-panel');
          const box = panel.getBoundingClientRect();
          const at = {clientX: box.left + box.width / 2, clientY: box.top + box.height * 0.8};
          panel.dispatchEvent(new DragEvent('drop', {dataTransfer: files, bubbles: true, ...at}));
        }""",
        _CART,
    )
    gazebo.eventually(lambda: "my_robot" in gazebo.report()["models"])
    panel = gazebo.panel("joints-force")
    panel.get_by_label("Model").select_option("my_robot")
    force = panel.get_by_label("hinge force (N·m)")
    force.fill("0.1")
    force.press("Enter")
    gazebo.simulation.unpause()
    gazebo.eventually(lambda: _velocity(panel) > 0.05)
    gazebo.seen.shot()


def test_position_and_velocity_have_gains(gazebo: GazeboPage) -> None:
    chooser = gazebo.panel("insert")
    with gazebo.seen.page.expect_file_chooser() as waiting:
        chooser.get_by_role("button", name="File…").click()
    waiting.value.set_files(
        files=[{"name": "cart.sdf", "mimeType": "text/xml", "buffer": _CART.encode()}]
    )
    gazebo.eventually(
        lambda: (
            "my_robot" in "".join(gazebo.report()["models"]) or "cart" in gazebo.report()["models"]
        )
    )
    panel = gazebo.panel("joints-force")
    panel.get_by_role("button", name="Velocity", exact=True).click()
    gain = panel.get_by_label("hinge p", exact=True)
    gain.fill("5")
    target = panel.get_by_label("hinge velocity (rad/s)")
    target.fill("1")
    target.press("Enter")
    gazebo.simulation.unpause()
    gazebo.eventually(lambda: abs(_velocity(panel) - 1.0) < 0.3)


def test_file_that_is_no_robot_is_refused_with_words(gazebo: GazeboPage) -> None:
    with gazebo.seen.page.expect_file_chooser() as waiting:
        gazebo.panel("insert").get_by_role("button", name="File…").click()
    waiting.value.set_files(
        files=[{"name": "notes.xml", "mimeType": "text/xml", "buffer": b"<notes/>"}]
    )
    assert "neither URDF nor SDF" in gazebo.seen.toast()


def test_no_world_is_said(bench: Any, look: Any) -> None:
    seen = look(bench.url, "gzclient")
    seen.panel("gazebo").locator(".scene-empty").wait_for()
    seen.panel("entities").get_by_text("No world is running").wait_for()


def _velocity(panel: Any) -> float:
    text = panel.locator("[data-joint=hinge] output").nth(1).inner_text()
    return float(text) if text not in ("", "–") else 0.0
