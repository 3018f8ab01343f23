"""``gazelle view FILE|PACKAGE|MODEL [-o out.png]``."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from gazelle.cli.view.source import find_viewed
from gazelle.description.forward_kinematics import movable_joints, posed_model
from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics, nearest_names, render
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.workspace import Workspace

__all__ = ["main"]

_SIZE = re.compile(r"(\d+)x(\d+)")


def main(argv: list[str]) -> int:
    """Draw a robot, a model or a world into a PNG file."""
    mappings = dict(word.split(":=", 1) for word in argv if ":=" in word)
    options = _parser().parse_args([word for word in argv if ":=" not in word])
    if len(options.target) > 2:
        _parser().error("name one FILE, PACKAGE or MODEL, or PACKAGE and FILE")
    diagnostics = Diagnostics()
    viewed = find_viewed(
        options.target,
        workspace=Workspace.discover(),
        diagnostics=diagnostics,
        mappings=mappings,
    )
    world = _posed(viewed.world, dict(options.joint))
    path = Path(options.output or f"{viewed.name}.png")
    _draw(world, options, path, diagnostics)
    render(diagnostics)
    print(f"{path}: {options.size[0]}x{options.size[1]}")
    return 0


def _parser() -> argparse.ArgumentParser:
    from gazelle.sensors.picture import SHOWN
    from gazelle.sensors.picture_views import VIEWS

    parser = argparse.ArgumentParser(
        prog="gazelle view",
        usage="gazelle view [options] FILE|PACKAGE [FILE]|MODEL [xacro_arg:=value …]",
        description="Draw a robot, a model or a world into a PNG file; no display is needed.",
    )
    add = parser.add_argument
    add("target", nargs="+", help="URDF, xacro or SDF file, package, model or world")
    add("-o", "--output", metavar="OUT.png", type=_png, help="where to (default: NAME.png here)")
    add("--size", type=_size, default=(800, 600), metavar="WxH", help="pixels (default: 800x600)")
    add(
        "--show",
        type=_words,
        default=("visuals",),
        metavar="WHAT",
        help=f"comma-separated, of {', '.join(SHOWN)} (default: visuals)",
    )
    add(
        "--views",
        type=_words,
        default=("iso",),
        metavar="VIEWS",
        help=f"comma-separated, of {', '.join(VIEWS)} (default: iso)",
    )
    xyz = ("X", "Y", "Z")
    add("--camera", nargs=3, type=float, metavar=xyz, help="where the camera stands, m")
    add("--look-at", nargs=3, type=float, metavar=xyz, help="with --camera (default: the origin)")
    add(
        "--joint",
        type=_joint,
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="stand a joint at so many rad or m; MODEL::JOINT where several models have it",
    )
    add("--background", type=_colour, metavar="COLOUR", help="such as white or #20242c")
    return parser


def _draw(world: World, options: argparse.Namespace, path: Path, diagnostics: Diagnostics) -> None:
    from PIL import Image

    from gazelle.sensors.kernel_warm_up import warm_up
    from gazelle.sensors.picture import take_picture

    try:
        camera = _camera(options)
        warm_up(lambda text: print(f"gazelle view: {text}", file=sys.stderr))
        picture = take_picture(
            world,
            show=options.show,
            views=options.views,
            T_world_camera=camera,
            size_px=options.size,
            background=options.background,
            diagnostics=diagnostics,
        )
    except ValueError as error:
        _parser().error(str(error))
    try:
        Image.fromarray(picture.rgb).save(path, "PNG")
    except OSError as error:
        _parser().error(f"cannot write {path}: {error.strerror}")


def _camera(options: argparse.Namespace) -> Pose | None:
    from gazelle.sensors.picture_views import looking_at

    if options.camera is None:
        if options.look_at is not None:
            raise ValueError("--look-at needs --camera")
        return None
    return looking_at(tuple(options.camera), tuple(options.look_at or (0.0, 0.0, 0.0)))


def _posed(world: World, positions: Mapping[str, float]) -> World:
    by_model: dict[str, dict[str, float]] = {model.name: {} for model in world.models}
    names = {
        name: (model.name, joint)
        for model in world.models
        for joint in movable_joints(model)
        for name in (joint, f"{model.name}::{joint}")
    }
    for name, value in positions.items():
        if name not in names:
            plain = [item for item in names if item in {joint for _, joint in names.values()}]
            hint = f"joints that move: {', '.join(plain) or 'none'}"
            raise NotFoundError("joint", name, nearest=nearest_names(name, names), hint=hint)
        model, joint = names[name]
        by_model[model][joint] = value
    models = (posed_model(model, by_model[model.name]) for model in world.models)
    return replace(world, models=tuple(models))


def _png(text: str) -> str:
    if not text.lower().endswith(".png"):
        raise argparse.ArgumentTypeError(f"'{text}': pictures are PNG files, name it so")
    return text


def _size(text: str) -> tuple[int, int]:
    found = _SIZE.fullmatch(text)
    if found is None:
        raise argparse.ArgumentTypeError(f"'{text}' is no size; write it as 800x600")
    return int(found[1]), int(found[2])


def _words(text: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in text.split(",") if word.strip())


def _joint(text: str) -> tuple[str, float]:
    name, sign, value = text.rpartition("=")
    try:
        if name and sign:
            return name, float(value)
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"'{text}' is no position; write it as joint=0.5")


def _colour(text: str) -> tuple[float, float, float]:
    from PIL import ImageColor

    try:
        red, green, blue = ImageColor.getrgb(text)[:3]
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is no colour; try white or #20242c") from None
    return red / 255, green / 255, blue / 255
