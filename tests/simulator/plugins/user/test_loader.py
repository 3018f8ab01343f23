"""Plug-ins of the user's own: what they are given, when they are called, what their errors do."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.installed_packages import installed

from gazelle.interfaces import message_type, service_type
from gazelle.simulator import Simulation
from gazelle.workspace import Workspace

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

MANIFEST = """<package format="2"><name>{name}</name><version>1.0.0</version>
  <description>d</description><maintainer email="a@b.c">m</maintainer><license>l</license>
  <buildtool_depend>catkin</buildtool_depend></package>"""
WORLD = """<sdf version="1.6"><world name="lab"><gravity>0 0 0</gravity>{world_plugin}
  <model name="m"><link name="l"><inertial><mass>2</mass><inertia><ixx>.1</ixx><iyy>.1</iyy>
    <izz>.1</izz></inertia></inertial>
    <sensor name="i" type="imu"><update_rate>50</update_rate>{sensor_plugin}</sensor></link>
  {plugin}</model></world></sdf>"""
PUSHER = """
    from gazelle.simulator.plugins.user import ModelPlugin

    class Pusher(ModelPlugin):
        def load(self, model, parameters, node):
            self.link = model.link(parameters["link"])
            self.force = parameters.number("force", 1.0)
            self.state = node.advertise("pushes", "std_msgs/Float64")
            node.subscribe("force", "std_msgs/Float64", self.take)
            node.service("stop", "std_srvs/Empty", self.stop)
            self.node = node
            self.count = 0

        def take(self, message):
            self.force = message.data

        def stop(self, request, response):
            self.force = 0.0

        def on_update(self, time_s):
            self.count += 1
            self.link.apply_wrench(force_n=(self.force, 0.0, 0.0), seconds=0.001)
            if self.state.matched:
                self.state.publish(self.node.message("std_msgs/Float64", data=self.force))

        def on_reset(self):
            self.count = 0
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "ws" / "src" / "my_robot"
    (folder / "plugins").mkdir(parents=True)
    (folder / "package.xml").write_text(MANIFEST.format(name="my_robot"))
    return folder


@pytest.fixture
def load_with(load: Load, package: Path) -> Callable[..., Simulation]:
    """Loads a world with plug-ins in model, sensor or world, from files of a package."""

    def load_one(files: dict[str, str], **elements: str) -> Simulation:
        for name, text in files.items():
            path = package / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(textwrap.dedent(text))
        places = {"plugin": "", "world_plugin": "", "sensor_plugin": "", **elements}
        workspace = Workspace.discover(
            environ={"ROS_PACKAGE_PATH": str(package.parent)}, cwd=Path("/")
        )
        return load(WORLD.format(**places), workspace=workspace)

    return load_one


def plugin(filename: str, keys: str = "", name: str = "p") -> str:
    return f'<plugin name="{name}" filename="{filename}">{keys}</plugin>'


@pytest.mark.parametrize("filename", ["libpusher.so", "pusher", "pusher.py", "/x/libpusher.so"])
def test_a_model_plug_in_pushes_its_link(
    load_with: Callable[..., Simulation], listen: Listen, filename: str
) -> None:
    keys = "<link>l</link><force>4</force><robotNamespace>/r</robotNamespace>"
    sim = load_with({"plugins/pusher.py": PUSHER}, plugin=plugin(filename, keys))
    assert [str(item) for item in sim.diagnostics] == []
    pushes = listen(sim, "/r/pushes")
    sim.run(seconds=1.0)
    # F t = m v; the first push comes after the first step.
    assert sim.link("l").linear_velocity_m_s[0] == pytest.approx(4 * 0.999 / 2, rel=1e-6)
    assert len(pushes) == 1000
    assert pushes[-1].data == 4.0
    sim.publish("/r/force", message_type("std_msgs/Float64")(data=-4.0))
    sim.run(seconds=1.0)
    assert sim.link("l").linear_velocity_m_s[0] == pytest.approx(0.0, abs=0.01)
    empty = service_type("std_srvs/Empty")
    sim.server.node.call("/r/stop", empty.Request())  # type: ignore[attr-defined]
    before = sim.link("l").linear_velocity_m_s[0]
    sim.run(seconds=0.5)
    assert sim.link("l").linear_velocity_m_s[0] == pytest.approx(before, abs=0.005)


def test_a_sensor_plug_in_is_called_at_its_sensors_rate(
    load_with: Callable[..., Simulation], listen: Listen
) -> None:
    code = """
        from gazelle.simulator.plugins.user import SensorPlugin

        class Shake(SensorPlugin):
            def load(self, sensor, parameters, node):
                self.sensor, self.node = sensor, node

            def on_update(self, time_s):
                x = float(self.sensor.read().linear_acceleration_m_s2[0])
                self.node.publish("~/x", self.node.message("std_msgs/Float64", data=x))
    """
    sim = load_with({"shake.py": code}, sensor_plugin=plugin("libshake.so"))
    values = listen(sim, "/p/x")
    sim.link("l").apply_wrench(force_n=(6.0, 0.0, 0.0))
    sim.run(seconds=1.0)
    assert len(values) == 50
    assert values[-1].data == pytest.approx(3.0)


def test_a_world_plug_in_sees_all_models(
    load_with: Callable[..., Simulation], listen: Listen
) -> None:
    code = """
        from gazelle.simulator.plugins.user import WorldPlugin

        class Count(WorldPlugin):
            update_rate_hz = 10.0

            def load(self, world, parameters, node):
                self.world, self.node = world, node

            def on_update(self, time_s):
                text = f"{self.world.name} {len(self.world.models)} {self.world.time_s:.1f}"
                self.node.publish("/census", self.node.message("std_msgs/String", data=text))
    """
    sim = load_with({"src/count.py": code}, world_plugin=plugin("libcount.so"))
    said = listen(sim, "/census")
    sim.run(seconds=0.5)
    assert [message.data for message in said] == [f"lab 1 0.{tick}" for tick in range(1, 6)]


def test_an_error_stops_the_plug_in_and_not_the_world(
    load_with: Callable[..., Simulation],
) -> None:
    code = """
        from gazelle.simulator.plugins.user import ModelPlugin

        class Bad(ModelPlugin):
            def load(self, model, parameters, node):
                node.advertise("gone", "std_msgs/Empty")

            def on_update(self, time_s):
                if time_s > 0.0995:
                    raise ValueError("too late")
    """
    sim = load_with({"bad.py": code}, plugin=plugin("libbad.so"))
    assert "/gone" in sim.server.node.topics  # type: ignore[attr-defined]
    sim.run(seconds=0.5)
    assert sim.time_s == pytest.approx(0.5)
    (found,) = sim.diagnostics.by_code("plugin.user-error")
    assert found.message == (
        "plug-in 'p' (bad.py) raised and is stopped; the world goes on: in on_update(): "
        "ValueError: too late"
    )
    assert found.span is not None
    assert (Path(found.span.file).name, found.span.line) == ("bad.py", 10)
    (place,) = found.span.via
    assert place == sim.server.engine.world.models[0].plugins[0].span
    assert "/gone" not in sim.server.node.topics  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("code", "line", "wanted"),
    [
        ("import nothing_of_this_name\n", 1, "in <module>(): ModuleNotFoundError"),
        ("def broken(:\n", 1, "goes on: SyntaxError"),
        (
            "from gazelle.simulator.plugins.user import ModelPlugin\n"
            "class Bad(ModelPlugin):\n"
            "    def load(self, model, parameters, node):\n"
            "        model.link('ll')\n",
            4,
            "link 'll'",
        ),
        (
            "from gazelle.simulator.plugins.user import ModelPlugin\n"
            "class Bad(ModelPlugin):\n"
            "    def load(self, model, parameters, node):\n"
            "        parameters['forse']\n",
            4,
            "in load(): KeyError: 'forse'",
        ),
    ],
)
def test_a_file_that_does_not_load_is_named_with_its_line(
    load_with: Callable[..., Simulation], code: str, line: int, wanted: str
) -> None:
    sim = load_with({"bad.py": code}, plugin=plugin("libbad.so"))
    (found,) = sim.diagnostics.by_code("plugin.user-error")
    assert wanted in found.message
    assert found.span is not None
    assert (Path(found.span.file).name, found.span.line) == ("bad.py", line)
    assert found.span.via
    sim.run(seconds=0.01)


def test_a_class_of_another_role_is_reported(load_with: Callable[..., Simulation]) -> None:
    code = """
        from gazelle.simulator.plugins.user import WorldPlugin

        class Wrong(WorldPlugin):
            pass
    """
    sim = load_with({"wrong.py": code}, plugin=plugin("libwrong.so"))
    (found,) = sim.diagnostics.by_code("plugin.user-class")
    assert "stands in a model and needs a class derived from ModelPlugin" in found.message
    assert "wrong.py has Wrong (a WorldPlugin); it is left out" in found.message


def test_of_several_classes_the_plug_ins_name_chooses(
    load_with: Callable[..., Simulation], listen: Listen
) -> None:
    code = """
        from gazelle.simulator.plugins.user import ModelPlugin

        class First(ModelPlugin):
            def load(self, model, parameters, node):
                node.advertise("first", "std_msgs/Empty")

        class Second(ModelPlugin):
            def load(self, model, parameters, node):
                node.advertise("second", "std_msgs/Empty")
    """
    named = load_with({"two.py": code}, plugin=plugin("two", name="my::Second"))
    assert list(named.server.node.topics) == ["/second"]  # type: ignore[attr-defined]
    unnamed = load_with({"two.py": code}, plugin=plugin("two"))
    (found,) = unnamed.diagnostics.by_code("plugin.user-class")
    assert "two.py has several: First, Second" in found.message
    assert found.fix == "give the <plugin> the name of the class that is meant"


def test_reset_and_close_are_called(load_with: Callable[..., Simulation], package: Path) -> None:
    code = f"""
        from pathlib import Path
        from gazelle.simulator.plugins.user import ModelPlugin

        LOG = Path({str(package / "log.txt")!r})

        class Watch(ModelPlugin):
            def load(self, model, parameters, node):
                LOG.write_text(f"load {{model.name}};")

            def on_reset(self):
                LOG.write_text(LOG.read_text() + "reset;")

            def close(self):
                LOG.write_text(LOG.read_text() + "close;")
    """
    sim = load_with({"watch.py": code}, plugin=plugin("libwatch.so"))
    sim.reset()
    sim.delete("m")
    assert (package / "log.txt").read_text() == "load m;reset;close;"


def test_parameters_are_texts_numbers_flags_and_vectors(
    load_with: Callable[..., Simulation], listen: Listen
) -> None:
    code = """
        from gazelle.simulator.plugins.user import ModelPlugin

        class Read(ModelPlugin):
            def load(self, model, parameters, node):
                words = [
                    parameters.get("word", "none"), parameters.get("absent", "none"),
                    parameters.number("number"), parameters.flag("flag"),
                    parameters.vector("vector"), sorted(parameters),
                    [tag.text for tag in parameters.tag.find_all("word")],
                ]
                node.advertise("/said", "std_msgs/String", latch=True)
                node.publish("/said", node.message("std_msgs/String", data=repr(words)))
    """
    keys = "<word>a</word><word>b</word><number>2.5</number><flag>true</flag>"
    keys += "<vector>1 2 3</vector>"
    sim = load_with({"read.py": code}, plugin=plugin("libread.so", keys))
    said = listen(sim, "/said")
    names = ["flag", "number", "vector", "word"]
    wanted = ["a", "none", 2.5, True, (1.0, 2.0, 3.0), names, ["a", "b"]]
    assert said[-1].data == repr(wanted)


def test_a_plug_in_with_cpp_sources_is_named_with_its_files(
    load_with: Callable[..., Simulation], package: Path
) -> None:
    files = {
        "CMakeLists.txt": "project(my_robot)\n\nadd_library(door_plugin src/door.cpp)\n",
        "src/door.cpp": "class Door : public ModelPlugin {};\nGZ_REGISTER_MODEL_PLUGIN(Door)\n",
    }
    sim = load_with(files, plugin=plugin("libdoor_plugin.so"))
    (found,) = sim.diagnostics.by_code("plugin.compiled")
    assert (
        "plug-in 'libdoor_plugin.so' (name 'p') is compiled code of package 'my_robot'"
        in found.message
    )
    assert f"({package}/src/door.cpp:1, {package}/CMakeLists.txt:3)" in found.message
    assert found.fix.startswith("write it in Python: a file door_plugin.py anywhere in package")
    assert found.fix.endswith("derived from gazelle.simulator.plugins.user.ModelPlugin")
    assert not sim.diagnostics.by_code("plugin.unknown")


def test_what_nobody_has_is_unknown(load_with: Callable[..., Simulation]) -> None:
    sim = load_with({}, plugin=plugin("libnobody_has_it.so"))
    (found,) = sim.diagnostics.by_code("plugin.unknown")
    assert "plug-in 'libnobody_has_it.so'" in found.message


def test_a_plug_in_of_an_installed_package_is_found_by_its_librarys_name(
    load_with: Callable[..., Simulation], tmp_path: Path
) -> None:
    points = {"gazelle.plugins": {"pusher": "push_parts:Pusher"}}
    with installed(tmp_path / "site", "push_parts", PUSHER, points):
        sim = load_with({}, plugin=plugin("libpusher.so", "<link>l</link><force>4</force>"))
        assert [str(item) for item in sim.diagnostics] == []
        sim.run(seconds=1.0)
        assert sim.link("l").linear_velocity_m_s[0] == pytest.approx(4 * 0.999 / 2, rel=1e-6)


def test_a_file_of_the_workspace_comes_before_an_installed_plug_in(
    load_with: Callable[..., Simulation], tmp_path: Path
) -> None:
    points = {"gazelle.plugins": {"pusher": "push_parts:Missing"}}
    with installed(tmp_path / "site", "push_parts", PUSHER, points):
        keys = "<link>l</link><force>4</force>"
        sim = load_with({"plugins/pusher.py": PUSHER}, plugin=plugin("libpusher.so", keys))
        assert [str(item) for item in sim.diagnostics] == []


@pytest.mark.parametrize(
    ("attribute", "told"),
    [
        ("Missing", "raised and is stopped; the world goes on: AttributeError: "),
        (
            "WORDS",
            "needs a class derived from ModelPlugin; entry point 'pusher = push_parts:WORDS' of "
            "push_parts 1.2 (gazelle.plugins) is a tuple, no class; it is left out",
        ),
        ("Elsewhere", "(gazelle.plugins) is a WorldPlugin; it is left out"),
    ],
)
def test_an_installed_plug_in_that_is_none_is_told(
    load_with: Callable[..., Simulation], tmp_path: Path, attribute: str, told: str
) -> None:
    source = """
        from gazelle.simulator.plugins.user import WorldPlugin

        WORDS = ("a", "b")

        class Elsewhere(WorldPlugin):
            pass
    """
    points = {"gazelle.plugins": {"pusher": f"push_parts:{attribute}"}}
    with installed(tmp_path / "site", "push_parts", source, points):
        sim = load_with({}, plugin=plugin("libpusher.so"))
        assert told in "\n".join(str(item) for item in sim.diagnostics)
