"""``libroboticsgroup_gazebo_mimic_joint_plugin``: one joint follows another, as ``<mimic>`` says.

Gazebo Classic has no mimic joints, so that grippers couple their fingers by this plug-in.
"""

from __future__ import annotations

from fractions import Fraction

from gazelle.engine import JointHandle
from gazelle.parameters import Parameter, ParameterTable
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginTable

__all__ = ["TABLE", "load"]

TABLE = PluginTable(
    ParameterTable(
        "mimic_joint",
        "Keeps a joint at a multiple of another joint's position.",
        (
            "roboticsgroup_upatras_gazebo_mimic_joint_plugin",
            "roboticsgroup_gazebo_mimic_joint_plugin",
            "gazebo_mimic_joint_plugin",
        ),
        (
            Parameter("joint", "text", "", "the joint that is followed"),
            Parameter("mimicJoint", "text", "", "the joint that follows"),
            Parameter("multiplier", "number", 1.0, "of the position"),
            Parameter("offset", "number", 0.0, "added to it", "rad, m"),
            Parameter(
                "sensitiveness", "number", 0.0, "smaller deviations are left as they are", "rad, m"
            ),
            Parameter(
                "hasPID", "refused", "", "the joint is put into place, no effort is computed"
            ),
            Parameter(
                "maxEffort", "refused", "", "the joint is put into place, no effort is computed"
            ),
            Parameter("robotNamespace", "refused", "", "where Gazebo reads the gains of `hasPID`"),
        ),
    ),
    behaviour=(
        "A joint that has `<mimic>` in its URDF follows by that, within the physics: then the"
        " plug-in has nothing to do.",
        "Other joints are put to multiplier · position + offset at every step, as Gazebo does"
        " without `hasPID`; with it they are as well, for a PID would only come near.",
    ),
)


def load(context: PluginContext) -> None:
    """Couple two joints that the description does not couple already."""
    parameters = context.reader(TABLE)
    followed = context.joint_name(parameters.text("joint"))
    follower = context.joint_name(parameters.text("mimicJoint"))
    multiplier, offset = parameters.number("multiplier"), parameters.number("offset")
    sensitiveness = parameters.number("sensitiveness")
    parameters.report_unread()
    if followed is None or follower is None:
        return
    name = follower.rpartition("::")[2]
    if any(joint.name == name and joint.mimic for joint in context.model.joints):
        return
    engine = context.host.engine
    law = (multiplier, offset, sensitiveness)
    _couple(context, engine.joint(followed), engine.joint(follower), law)


def _couple(
    context: PluginContext,
    leader: JointHandle,
    follower: JointHandle,
    law: tuple[float, float, float],
) -> None:
    multiplier, offset, sensitiveness = law

    def update() -> None:
        wanted = multiplier * leader.position + offset
        if abs(wanted - follower.position) >= sensitiveness:
            follower.lock_position(wanted)

    resources = context.resources
    resources.task(f"{context.plugin.name} {follower.name}", Fraction(1), update)
    resources.on_close(follower.release)
