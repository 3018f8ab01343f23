"""What ``<gazebo>`` without a reference puts into the model: links, joints, frames, models.

sdformat copies such elements into the model as they are, which is how URDF's tree becomes a graph
with closed loops. They are SDF: poses of joints start from their child, names are the robot's.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from gazelle.description.model import Model
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.known_elements import check_elements
from gazelle.description.sdf_reader.models import ModelParts, model_around
from gazelle.description.urdf_reader.fixed_joint_lumping import lumped_links
from gazelle.description.xml import Tag

__all__ = ["INSERTED_ELEMENTS", "inserted_joints", "with_insertions"]

INSERTED_ELEMENTS = ("frame", "gripper", "include", "joint", "link", "model")
# The version of the document that sdformat 9 and 12 make of a URDF.
_VERSION = (1, 7)


def inserted_joints(blocks: Sequence[Tag]) -> Iterator[str]:
    """Yield the names of the joints that blocks without a reference insert."""
    for tag in _inserted(blocks):
        if tag.name == "joint" and tag.attributes.get("name", "").strip():
            yield tag.attributes["name"].strip()


def with_insertions(model: Model, blocks: Sequence[Tag], context: ReadContext) -> Model:
    """Return the robot with what its blocks insert; the robot's own names win.

    Args:
        model: the robot with poses of all its links.
        blocks: the ``<gazebo>`` elements without a reference.
        context: where to report, and look-up of files.
    """
    inserted = tuple(_without_taken(_inserted(blocks), model, context))
    if not inserted:
        return model
    around = Tag("model", model.span or inserted[0].span, {"name": model.name}, inserted)
    versioned = context.for_version(_VERSION)
    check_elements(around, versioned)
    whole = model_around(_parts(model), replace(around, children=inserted), versioned)
    links = {item.name for item in model.links}
    joints = {item.name for item in model.joints}
    return replace(
        model,
        links=(*model.links, *(item for item in whole.links if item.name not in links)),
        joints=(*model.joints, *(item for item in whole.joints if item.name not in joints)),
        frames=whole.frames,
        plugins=(*model.plugins, *whole.plugins),
    )


def _inserted(blocks: Sequence[Tag]) -> Iterator[Tag]:
    return (tag for block in blocks for tag in block.children if tag.name in INSERTED_ELEMENTS)


def _without_taken(tags: Iterator[Tag], model: Model, context: ReadContext) -> Iterator[Tag]:
    taken = {
        "link": {item.name for item in model.links},
        "joint": {item.name for item in model.joints},
    }
    for tag in tags:
        name = tag.attributes.get("name", "").strip()
        if name in taken.get(tag.name, ()):
            message = f"{tag.name} with name '{name}' stands in the robot and again in <gazebo>; "
            message += "the robot's own counts"
            context.diagnostics.report("sdf.duplicate-name", message, tag.span)
        else:
            yield tag


def _parts(model: Model) -> ModelParts:
    """Return the robot as a model that is merged into the one around it.

    A joint's pose starts from its child as sdformat sees it: from the link that a lumped child has
    become part of.
    """
    poses = {link.name: link.T_model_link for link in model.links}
    heads = {name: head for name, head in lumped_links(model).items() if head in poses}
    frames = {name: poses[heads.get(name, name)] for name in poses}
    frames |= {joint.name: joint.T_model_joint for joint in model.joints}
    attached = {name: name for name in poses}
    attached |= {joint.name: joint.child for joint in model.joints}
    # Its plug-ins are the robot's already.
    return ModelParts(replace(model, plugins=()), frames=frames, attached=attached, merged=True)
