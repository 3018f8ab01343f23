"""What a world file says of the window: where its camera is, and the colour behind everything."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from tests.browser.scene.gazebo_page import GazeboPage
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.simulator.gui import offer_views
from gazelle.studio import Server, Studio

pytestmark = pytest.mark.slow
_WORLD = """<sdf version="1.6"><world name="w">
  <scene><background>0.1 0.5 0.2 1</background><grid>false</grid></scene>
  <gui><camera name="user_camera"><pose>0.3 -0.2 9.3 0 1.5708 0</pose></camera></gui>
  <model name="box"><static>true</static><pose>0.3 -0.2 0.5 0 0 0</pose><link name="l">
    <visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual></link></model>
</world></sdf>"""

_BOX = "<visual name='v'><geometry><box><size>.4 .4 .2</size></box></geometry></visual>"
_ROBOT = f"""<sdf version="1.6"><world name="w">
  <model name="hall"><static>true</static><link name="l"><visual name="v"><geometry>
    <plane><normal>0 0 1</normal><size>90 90</size></plane></geometry></visual></link></model>
  <model name="thing"><pose>30 20 1 0 0 0</pose><link name="l">{_BOX}</link></model>
  <model name="robot"><pose>-3 2 1 0 0 0</pose><link name="a">{_BOX}</link>
    <link name="b">{_BOX}</link><joint name="j" type="revolute"><parent>a</parent><child>b</child>
    <axis><xyz>0 0 1</xyz></axis></joint></model>
</world></sdf>"""


@pytest.fixture
def page(
    request: pytest.FixtureRequest, free_port: int, look: Any, tmp_path: Path
) -> Iterator[Any]:
    (tmp_path / "w.world").write_text(getattr(request, "param", _WORLD), encoding="utf-8")
    graph = Graph.open(port=free_port, environ={}, role="hub")
    node = graph.create_node("gazebo", rosout=False)
    server = Simulation.load(world=tmp_path / "w.world", node=node).server
    server.pause()
    offer_gazebo_ros(server)
    offer_views(server)
    running = threading.Thread(target=server.run)
    running.start()
    with Server(Studio(graph), port=0) as studio:
        seen = look(studio.url, "gzclient", size=(1200, 800))
        seen.expect_problem("ERR_CONNECTION_REFUSED|ERR_EMPTY_RESPONSE|ERR_CONNECTION_RESET")
        yield seen
    server.close()
    running.join(stretched())
    graph.close()


def test_page_looks_from_the_camera_of_the_world_file_on_its_background(page: Any) -> None:
    GazeboPage(page, None, eventually).eventually(
        lambda: "box" in page.page.evaluate("gazelle.scene('gazebo').models")
    )
    page.page.wait_for_timeout(1000)
    # Straight from above the box is in the middle, and nothing but the background around it.
    at = page.page.evaluate("gazelle.screen('box::l', 'gazebo')")
    area = page.panel("gazebo").locator("canvas").first.bounding_box()
    assert at["x"] == pytest.approx(area["x"] + area["width"] / 2, abs=3)
    assert at["y"] == pytest.approx(area["y"] + area["height"] / 2, abs=3)
    with Image.open(page.shot()) as picture:
        corner: Any = picture.getpixel((int(area["x"] + area["width"] * 0.1), int(at["y"])))
    assert corner[:3] == pytest.approx((26, 128, 51), abs=3)


@pytest.mark.parametrize("page", [_ROBOT], indirect=True)
def test_without_a_camera_in_the_world_file_the_robot_fills_the_first_look(page: Any) -> None:
    GazeboPage(page, None, eventually)

    def camera() -> Any:
        return page.page.evaluate("gazelle.scene('gazebo').camera")

    eventually(lambda: camera()["focal"] == pytest.approx([-3.0, 2.0, 1.0], abs=0.05))
    assert 0.4 < camera()["distance"] < 1.2
    # Whoever has moved the camera keeps it.
    page.page.evaluate("gazelle.look({distance: 5}, 'gazebo')")
    page.page.wait_for_timeout(1500)
    assert camera()["distance"] == 5
