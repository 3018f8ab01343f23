"""T16: ``gazebo``, a model inserted by name and moved from the Joints panel; the other ways in."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from tests.browser.scene.gazebo_page import GazeboPage
from tests.browser.tutorial.terminal import Session
from tests.shared_files import SHARED, needs_shared, shared_cases

from gazelle.graph import Graph
from gazelle.interfaces import fill, service_type

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_LOOK_NORTH = """gazelle.look(
  {kind: 'Orbit', focal: [0, 0, 0.3], distance: 6, yaw: -1.5708, pitch: 0.4}, 'gazebo')"""


class World:
    """What the simulation says through ``/gazebo``'s services."""

    def __init__(self, graph: Any) -> None:
        self._node = graph.create_node("test", anonymous=True, rosout=False)

    def models(self) -> list[str]:
        """The names of all models."""
        return list(self._call("get_world_properties", "GetWorldProperties").model_names)

    def state(self, model: str) -> Any:
        """Pose and twist of a model."""
        return self._call("get_model_state", "GetModelState", model_name=model)

    def _call(self, name: str, type_name: str, **fields: Any) -> Any:
        kind = service_type(f"gazebo_msgs/srv/{type_name}")
        client = self._node.create_client(f"/gazebo/{name}", kind)
        assert client.wait_for_service(60.0)
        request = kind.Request()
        fill(request, fields)
        try:
            return client.call(request, timeout_s=60.0)
        finally:
            client.unregister()


class Models(NamedTuple):
    """A folder of models with a robot of two wheels among them.

    Attributes:
        folder: of the models.
        name, title: the robot's.
        wheels: its joints.
    """

    folder: Path
    name: str
    title: str
    wheels: tuple[str, str]


_YARD = Path(__file__).parents[2] / "workspaces/ros1/src/yard_gazebo/models"
_SAMPLES = SHARED / "workspaces/gazebo_models"
# A page takes seconds: our own models are shown where the document's are not there.
_CASES = shared_cases(
    Models(_SAMPLES, "my_robot", "My Robot", ("left_wheel_hinge", "right_wheel_hinge"))
) or [Models(_YARD, "barrow", "Barrow (motor)", ("left_hinge", "right_hinge"))]


@pytest.fixture(params=_CASES)
def models(request: pytest.FixtureRequest) -> Models:
    return request.param


@pytest.fixture
def gazebo(session: Callable[..., Session], models: Models, look: Any) -> Iterator[GazeboPage]:
    """``gazebo``, as the document starts it, and its page."""
    begun = session("gazebo", GAZEBO_MODEL_PATH=str(models.folder))
    begun.shows(begun.first, "gazebo")
    seen = look(begun.url, size=(1440, 900))
    with Graph.open(port=begun.first.port, role="client", environ={}) as graph:
        page = GazeboPage(seen, World(graph), begun.eventually)
        page.eventually(lambda: "ground_plane" in page.report()["models"])
        yield page


def test_robot_is_inserted_by_name_and_moved_by_a_tenth_of_a_newton_metre(
    gazebo: GazeboPage, models: Models
) -> None:
    world = gazebo.simulation
    card = gazebo.panel("insert").get_by_role("button", name=re.compile(f"^Insert .*{models.name}"))
    assert models.title in card.inner_text()
    card.click()
    gazebo.eventually(lambda: models.name in gazebo.report()["models"])
    assert models.name in world.models()
    panel = gazebo.panel("joints-force")
    panel.get_by_label("Model").select_option(models.name)
    for wheel in models.wheels:
        force = panel.get_by_label(f"{wheel} force (N·m)")
        force.fill("0.1")
        force.press("Enter")
    # Two wheels of 0.1 m push 3 kg and their own 2 · 1 kg·m²/(0.1 m)²: 0.00985 m/s².
    gazebo.eventually(lambda: world.state(models.name).twist.linear.x > 0.02)
    gazebo.seen.shot("pushed")
    assert abs(world.state(models.name).twist.linear.y) < 0.01
    effort = panel.locator(f"[data-joint={models.wheels[0]}] output").nth(2)
    assert float(effort.inner_text()) == pytest.approx(0.1, abs=1e-3)


@needs_shared
def test_stages_without_a_link_are_told_and_shapes_and_files_come_in(
    gazebo: GazeboPage, models: Models
) -> None:
    world, seen = gazebo.simulation, gazebo.seen
    for file in (models.folder / f"stages/my_robot_{stage}.sdf" for stage in (1, 2)):
        with seen.page.expect_file_chooser() as waiting:
            gazebo.panel("insert").get_by_role("button", name="File…").click()
        waiting.value.set_files(file)
        assert f"model '{models.name}' has no link" in seen.toast()
        seen.shot(file.stem)
        seen.page.locator(".toast").get_by_role("button").last.click()
    gazebo.panel("insert").get_by_role("button", name="box", exact=True).click()
    gazebo.eventually(lambda: gazebo.report()["selected"] == {"model": "box"})
    _drag_along_x(gazebo, "box")
    gazebo.seen.page.keyboard.press("Delete")
    gazebo.eventually(lambda: "box" not in world.models())
    _drop(gazebo, models.folder.parent / "catkin_ws/src/urdf_tutorial/urdf/mobile_robot.urdf")
    gazebo.eventually(lambda: "mobile_robot" in gazebo.report()["models"])
    gazebo.eventually(lambda: world.state("mobile_robot").pose.position.z > 0.2)
    seen.shot("dropped")


def _drag_along_x(gazebo: GazeboPage, model: str) -> None:
    """Drag the red arrow of the chosen model to the right, as one looks north."""
    world = gazebo.simulation
    gazebo.seen.page.evaluate(_LOOK_NORTH)
    gazebo.tool("Translate")
    before = world.state(model).pose.position
    # The arrows are there from the first frame drawn with them on.
    gazebo.seen.page.evaluate("gazelle.drawNow('gazebo')")
    gazebo.eventually(lambda: gazebo.pose(f"{model}::link")[0] == pytest.approx(before.x, abs=1e-3))
    handle = f"gazelle.project([{before.x + 0.5}, {before.y}, {before.z}], 'gazebo')"
    at = gazebo.seen.page.evaluate(handle)
    gazebo.drag((at["x"], at["y"]), (at["x"] + 150, at["y"]))
    gazebo.eventually(lambda: world.state(model).pose.position.x > before.x + 0.3)
    assert world.state(model).pose.position.y == pytest.approx(before.y, abs=0.01)


def _drop(gazebo: GazeboPage, file: Path) -> None:
    gazebo.seen.page.evaluate(
        """([text, name]) => {
          const files = new DataTransfer();
          files.items.add(new File([text], name));
          const panel = document.querySelector('[data-panel=gazebo] .scene-panel');
          const box = panel.getBoundingClientRect();
          const at = {clientX: box.left + box.width / 2, clientY: box.top + box.height * 0.8};
          panel.dispatchEvent(new DragEvent('drop', {dataTransfer: files, bubbles: true, ...at}));
        }""",
        [file.read_text(encoding="utf-8"), file.name],
    )
