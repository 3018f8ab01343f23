"""Config packages that are being made, one for each panel, and the files they may touch."""

from __future__ import annotations

import itertools
import threading
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.errors import GazelleError
from gazelle.studio.errors import StudioError
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.scenes.shapes import page_scene
from gazelle.studio.setup_assistant.values import (
    AssistantPair,
    AssistantStart,
    AssistantValue,
    config_value,
    link_values,
)
from gazelle.workspace import Workspace

if TYPE_CHECKING:
    from gazelle.description.model import Model
    from gazelle.motion.setup_assistant import SetupAssistantConfig
    from gazelle.motion.setup_assistant.config import RosVersion

__all__ = ["AssistantSession", "AssistantSessions"]

_MOST = 8
_ROBOTS = (".urdf", ".urdf.xacro", ".xacro")
_SETUP = ".setup_assistant"


class AssistantSession:
    """A config package that is being made.

    Attributes:
        config: as it is chosen so far.
        model: the robot.
        folder: of the package.
        progress: of the search for pairs, 0 to 1.
        is_stopped: the search shall end.
    """

    def __init__(self, config: SetupAssistantConfig, model: Model, folder: Path) -> None:
        self.config = config
        self.model = model
        self.folder = folder
        self.progress = 0.0
        self.is_stopped = False


class AssistantSessions:
    """All sessions of a Studio; packages are written below its folder and nowhere else.

    Attributes:
        folder: of the Studio.
    """

    def __init__(self, folder: Path, assets: Assets) -> None:
        """Have no session yet.

        Args:
            folder: packages are written below it.
            assets: keeps meshes for pages.
        """
        self.folder = folder
        self._assets = assets
        self._numbers = itertools.count(1)
        self._lock = threading.Lock()
        self._sessions: dict[int, AssistantSession] = {}

    def start(self) -> AssistantStart:
        """Return what may be begun with."""
        packages = self._workspace().user_packages
        robots = [
            f"package://{package.name}/{file.relative_to(package.path).as_posix()}"
            for package in packages
            for folder in ("urdf", "robots", "xacro")
            if (package.path / folder).is_dir()
            for file in sorted((package.path / folder).rglob("*"))
            if file.name.endswith(_ROBOTS) and file.is_file()
        ]
        made = [package.name for package in packages if (package.path / _SETUP).is_file()]
        return {"robots": robots, "packages": sorted(made), "folder": str(self.parent)}

    @property
    def parent(self) -> Path:
        """Where packages are made: the workspace's ``src`` where the folder is its top."""
        source = self.folder / "src"
        is_top = source.is_dir() and not (self.folder / "package.xml").exists()
        return source if is_top else self.folder

    def load(self, file: str, xacro_args: str, ros_version: int) -> AssistantValue:
        """Begin with a robot's file: ``package://…``, or a path below the folder or in a package.

        Args:
            file: the robot's.
            xacro_args: words ``NAME:=VALUE``.
            ros_version: 0 for that of the robot's package.

        Raises:
            StudioError: there is no robot, or it lies elsewhere.
        """
        from gazelle.diagnostics import Diagnostics
        from gazelle.motion.setup_assistant import CollisionSearch, propose, read_robot

        workspace = self._workspace()
        found = Diagnostics()
        try:
            path = self._robot_file(file, workspace)
            source, model = read_robot(
                path, workspace=workspace, diagnostics=found, xacro_args=xacro_args.strip()
            )
            package = workspace.user_package(source.package) if source.package else None
            version: RosVersion = 2
            if ros_version == 1 or (
                ros_version == 0 and (package is None or package.ros_version != 2)
            ):
                version = 1
            config = propose(
                model,
                source,
                diagnostics=found,
                ros_version=version,
                search=CollisionSearch(include_never=False),
            )
        except GazelleError as error:
            raise StudioError(str(error)) from error
        return self._begun(AssistantSession(config, model, self.parent / config.package_name))

    def open(self, name: str) -> AssistantValue:
        """Begin with a config package that is there.

        Raises:
            StudioError: there is none, or it cannot be read.
        """
        from gazelle.diagnostics import Diagnostics
        from gazelle.motion.setup_assistant import read_config_package

        workspace = self._workspace()
        try:
            folder = workspace.package(name).path
            config, model = read_config_package(
                folder, workspace=workspace, diagnostics=Diagnostics()
            )
        except GazelleError as error:
            raise StudioError(str(error)) from error
        return self._begun(AssistantSession(config, model, folder))

    def session(self, number: int) -> AssistantSession:
        """Return a session.

        Raises:
            StudioError: it has ended.
        """
        with self._lock:
            found = self._sessions.get(number)
        if found is None:
            raise StudioError(
                "this session of the Setup Assistant has ended", hint="load the robot again"
            )
        return found

    def value(self, number: int) -> AssistantValue:
        """Return a session as the page takes it."""
        from gazelle.diagnostics import Diagnostics
        from gazelle.motion.model import RobotModel
        from gazelle.sensors.scene_json import robot_value
        from gazelle.studio.motion.robot import motion_part

        session = self.session(number)
        config = session.config
        robot = RobotModel.build(session.model, config.srdf, diagnostics=Diagnostics())
        links = link_values(robot)
        solid = sorted(link["name"] for link in links if link["is_solid"])
        return {
            **config_value(config, _all_pairs(config, solid)),
            "session": number,
            "folder": str(session.folder),
            "links": links,
            "robot": {
                "node": "",
                "prefix": "",
                **motion_part(robot, config.velocity_scaling, config.acceleration_scaling),
                "scene": page_scene(robot_value(session.model), self._assets),
            },
        }

    def renamed(self, session: AssistantSession, config: SetupAssistantConfig) -> None:
        """Take a configuration; another package name is another folder."""
        if config.package_name != session.config.package_name:
            session.folder = self.parent / config.package_name
        session.config = config

    def writable(self, session: AssistantSession) -> Path:
        """Return the package's folder.

        Raises:
            StudioError: it is not below the Studio's.
        """
        folder = session.folder.resolve()
        if not folder.is_relative_to(self.folder.resolve()):
            raise StudioError(
                f"{folder} is not below {self.folder}, and pages write nowhere else",
                hint="start the page with --folder",
            )
        return folder

    def _begun(self, session: AssistantSession) -> AssistantValue:
        with self._lock:
            number = next(self._numbers)
            self._sessions[number] = session
            while len(self._sessions) > _MOST:
                del self._sessions[min(self._sessions)]
        return self.value(number)

    def _workspace(self) -> Workspace:
        return Workspace.discover(cwd=self.folder)

    def _robot_file(self, file: str, workspace: Workspace) -> Path:
        if "://" in file:
            found = workspace.resolve(file)
            if found.path is None:
                raise StudioError(found.explain(file))
            path = found.path
        else:
            path = (self.folder / Path(file).expanduser()).resolve()
        path = path.resolve()
        if not path.is_file():
            raise StudioError(f"there is no file {path}")
        allowed = [self.folder.resolve(), *(one.path.resolve() for one in workspace.user_packages)]
        if not any(path.is_relative_to(folder) for folder in allowed):
            raise StudioError(
                f"{path} is neither below {self.folder} nor in a package of the workspace",
                hint="start the page with --folder",
            )
        return path


def with_pairs(session: AssistantSession, trials: int) -> None:
    """Find the pairs of a session's robot that need no check; those chosen by hand stay.

    Raises:
        StudioError: the page stopped the search.
    """
    from gazelle.diagnostics import Diagnostics
    from gazelle.motion.model import RobotModel
    from gazelle.motion.setup_assistant import DisabledReason, self_collision_matrix

    session.progress, session.is_stopped = 0.0, False

    def told(done: float) -> None:
        session.progress = done
        if session.is_stopped:
            raise StudioError("the search was stopped")

    found = Diagnostics()
    bare = RobotModel.build(session.model, diagnostics=found)
    config = session.config
    matrix = self_collision_matrix(
        bare,
        trials=trials,
        always_fraction=config.always_fraction,
        progress=told,
        diagnostics=found,
    )
    disabled = {(pair.link1, pair.link2): pair for pair in matrix.disabled()}
    for pair in config.srdf.disabled_pairs:
        if pair.reason == DisabledReason.USER.value:
            disabled.setdefault((min(pair.link1, pair.link2), max(pair.link1, pair.link2)), pair)
    srdf = replace(session.config.srdf, disabled_pairs=tuple(disabled.values()))
    session.config = replace(session.config, srdf=srdf, collision_trials=trials)


def _all_pairs(config: SetupAssistantConfig, links: list[str]) -> list[AssistantPair]:
    reasons = {
        frozenset((pair.link1, pair.link2)): pair.reason for pair in config.srdf.disabled_pairs
    }
    return [
        {"link1": first, "link2": second, "reason": reasons.get(frozenset((first, second)), "")}
        for first, second in itertools.combinations(links, 2)
    ]
