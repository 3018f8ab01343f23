"""Objects of the planning scene, made and moved in the page; move_group's scene is what counts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.slow

_SOLIDS = {
    # MoveIt's order: of a cylinder and a cone the height comes first.
    "Box": ({"x": 0.3, "y": 0.2, "z": 0.1}, 1, [0.3, 0.2, 0.1]),
    "Sphere": ({"radius": 0.07}, 2, [0.07]),
    "Cylinder": ({"radius": 0.04, "length": 0.5}, 3, [0.5, 0.04]),
    "Cone": ({"radius": 0.06, "length": 0.2}, 4, [0.2, 0.06]),
}
_WEDGE = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 50\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
_OLD_SCENE = """(noname)
* old table
1
box
0.5 0.4 0.02
0.6 0.1 -0.2
0 0 0.7071068 0.7071068
0 0 0 0
.
"""


def _place(item: Any) -> list[float]:
    return [float(getattr(item.pose.position, axis)) for axis in "xyz"]


def test_solids_are_added_moved_and_removed(desk: Any) -> None:
    ui = desk.ui
    ui.tab("Scene Objects")
    for at, (shape, (sizes, kind, dimensions)) in enumerate(_SOLIDS.items()):
        ui.add_solid(shape, **sizes)
        ui.place_object(x=-0.6, y=0.4 * at - 0.6, z=0.3)
        ui.eventually(lambda name=shape: _place(desk.objects()[name])[2] > 0.2)
        made = desk.objects()[shape]
        assert int(made.primitives[0].type) == kind
        assert list(made.primitives[0].dimensions) == pytest.approx(dimensions)
        assert _place(made) == pytest.approx([-0.6, 0.4 * at - 0.6, 0.3])
    ui.shows(objects=4)
    assert ui.panel.locator("[data-object]").count() == 4

    # By the upper one of its blue arrows; the numbers follow.
    ui.panel.locator("[data-object=Cone]").click()
    before = _place(desk.objects()["Cone"])
    ui.drag("z", -1, marker="Cone", at=(-0.6, 0.6, 0.3))
    ui.eventually(lambda: _place(desk.objects()["Cone"])[2] > before[2] + 0.02)
    after = _place(desk.objects()["Cone"])
    assert after[:2] == pytest.approx(before[:2], abs=1e-6)
    shown = ui.panel.get_by_label("Object z")
    ui.eventually(lambda: float(shown.input_value()) == pytest.approx(after[2], abs=1e-4))
    ui.place_object(yaw=1.5707963)
    ui.eventually(lambda: desk.objects()["Cone"].pose.orientation.z > 0.5)
    turned = desk.objects()["Cone"].pose.orientation
    assert (turned.z, turned.w) == pytest.approx((0.70710678, 0.70710678), abs=1e-6)
    ui.rviz.seen.shot("objects")

    # By keys alone.
    ui.panel.locator("[data-object=Cone]").focus()
    ui.page.keyboard.press("Delete")
    ui.shows(objects=3)
    assert "Cone" not in desk.objects()
    ui.panel.locator("[data-object=Box]").focus()
    ui.page.keyboard.press("ArrowDown")
    assert ui.panel.locator("[aria-selected=true][data-object]").count() == 1

    # A second one has a name of its own; one in the goal's way is told before anybody plans.
    ui.add_solid("Sphere", radius=0.2)
    assert "Sphere_1" in desk.objects()
    ui.place_object(z=0.5)
    ui.says("collides with Sphere_1", "Collisions")
    ui.eventually(lambda: ui.counts()["red"] > 0)
    ui.press("Clear scene")
    ui.shows(objects=0, red=0)
    assert not desk.objects()
    assert not ui.panel.get_by_role("status", name="Collisions").is_visible()
    ui.choose("Shape", "Box")
    ui.panel.get_by_label("Box x (m)").fill("0")
    ui.press("Add")
    ui.says("The sizes of a Box must be above 0 m.")


def test_meshes_are_held_kept_in_files_and_come_back(desk: Any, tmp_path: Path) -> None:
    ui = desk.ui
    ui.tab("Scene Objects")
    mesh = tmp_path / "wedge.obj"
    mesh.write_text(_WEDGE, "utf-8")
    ui.type("Mesh scale", "0.001")
    _choose_file(ui, "Mesh file…", mesh)
    ui.says("Added wedge.")
    ui.place_object(x=0.7, z=0.4)
    ui.eventually(lambda: _place(desk.objects()["wedge"]) == pytest.approx([0.7, 0, 0.4]))
    made = desk.objects()["wedge"]
    corners = sorted((one.x, one.y, one.z) for one in made.meshes[0].vertices)
    assert corners == [(0, 0, 0), (0, 0, 0.05), (0, 0.1, 0), (0.1, 0, 0)]
    assert len(made.meshes[0].triangles) == 4

    # The gripper holds it and may touch it.
    ui.press("Attach")
    ui.shows(objects=0, attached=1)
    body = desk.held()["wedge"]
    assert body.link_name == "tool_link"
    assert {"hand_link", "left_finger_link", "right_finger_link"} <= set(body.touch_links)
    ui.rviz.seen.shot("held")
    ui.press("Detach")
    ui.shows(objects=1, attached=0)
    assert not desk.held()

    ui.add_solid("Cylinder", radius=0.1, length=0.3)
    ui.place_object(x=-0.5, y=0.25, roll=0.5)
    ui.eventually(lambda: desk.objects()["Cylinder"].pose.orientation.x > 0.1)
    before = {name: _told(item) for name, item in desk.objects().items()}
    file = tmp_path / "kept.scene"

    # What is exported is what the page has heard of move_group's scene by then.
    def kept() -> bool:
        with ui.page.expect_download() as saved:
            ui.press("Export")
        saved.value.save_as(file)
        assert saved.value.suggested_filename == "heron.scene"
        text = file.read_text("utf-8")
        return "-0.5 0.25 0" in text and "0.2474" in text

    ui.eventually(kept)
    ui.press("Clear scene")
    ui.shows(objects=0)
    _choose_file(ui, "Import…", file)
    ui.says("Added 2 objects of kept.scene.")
    ui.shows(objects=2)
    after = {name: _told(item) for name, item in desk.objects().items()}
    assert sorted(after) == sorted(before) == ["Cylinder", "wedge"]
    for name, told in before.items():
        assert after[name] == pytest.approx(told, abs=1e-6)

    # Files of MoveIt 1 have no poses of objects; what is wrong in one is told with its line.
    old = tmp_path / "old.scene"
    old.write_text(_OLD_SCENE, "utf-8")
    _choose_file(ui, "Import…", old)
    ui.says("Added 1 objects of old.scene.")
    table = desk.objects()["old table"]
    assert list(table.primitives[0].dimensions) == pytest.approx([0.5, 0.4, 0.02])
    old.write_text(_OLD_SCENE.replace("box", "tetrahedron"), "utf-8")
    _choose_file(ui, "Import…", old)
    words = ui.says("there is no shape 'tetrahedron'")
    assert "old.scene:4:" in words and "cylinder" in words
    step = tmp_path / "wedge.obj"
    step.write_text("v 0 0\n", "utf-8")
    _choose_file(ui, "Mesh file…", step)
    ui.says("wedge.obj")


def _choose_file(ui: Any, button: str, file: Path) -> None:
    with ui.page.expect_file_chooser() as chooser:
        ui.press(button)
    chooser.value.set_files(file)


def _told(item: Any) -> list[float]:
    """All numbers of an object."""
    turn = item.pose.orientation
    found = [*_place(item), turn.x, turn.y, turn.z, turn.w]
    for solid in item.primitives:
        found += [solid.type, *solid.dimensions]
    for mesh in item.meshes:
        found += [value for one in mesh.vertices for value in (one.x, one.y, one.z)]
        found += [value for one in mesh.triangles for value in one.vertex_indices]
    return [float(value) for value in found]
