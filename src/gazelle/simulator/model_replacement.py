"""Changes a model's description while it runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle.description.model import Model
from gazelle.errors import EngineError
from gazelle.simulator.input_validation import InputRefusedError

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["is_fixed", "replace_model"]


def is_fixed(model: Model) -> bool:
    """Tell whether a model as a whole cannot move: static, or jointed to the world."""
    return model.static or any(joint.parent == "world" for joint in model.joints)


def replace_model(engine: Engine, model: Model) -> None:
    """Put a changed description in the place of the model of the same name.

    Pose, velocity and joint state stay; motor commands and efforts on its joints end, their
    plug-ins give them again.

    Raises:
        InputRefusedError: the engine cannot build it; everything is as it was.
    """
    name = model.name
    pose = engine.model_pose(name)
    linear, angular = engine.model_velocity(name)
    joints = {
        item: (engine.joint(item).position, engine.joint(item).velocity)
        for item in engine.joint_names
        if item.startswith(f"{name}::") and engine.joint(item).is_driveable
    }
    before = engine.save_state()
    engine.delete(name)
    try:
        engine.spawn(model, name=name)
        engine.set_model_pose(name, pose)
        if not is_fixed(model):
            engine.set_model_velocity(name, linear, angular)
        for item, (position, velocity) in joints.items():
            # One that is static now has none.
            if engine.joint(item).is_driveable:
                engine.joint(item).set_state(position, velocity)
    except EngineError as error:
        # It is gone by now, and nobody asked for that.
        engine.restore_state(before)
        raise InputRefusedError(str(error)) from error
