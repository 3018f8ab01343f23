"""Readings on demand: every sensor of a model, its noise, and those that cannot be read."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from gazelle.errors import GazelleError
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]

NOISE = "<noise type='gaussian'><mean>0</mean><stddev>{}</stddev></noise>"
MODEL = f"""<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>
  <model name="m"><pose>0 0 10 0 0 0</pose><link name="l"><inertial><mass>1</mass></inertial>
  <sensor name="mag" type="magnetometer"><magnetometer><x>{NOISE.format(1e-6)}</x>
    </magnetometer></sensor>
  <sensor name="alt" type="altimeter"><altimeter><vertical_position>{NOISE.format(0.5)}
    </vertical_position></altimeter></sensor>
  <sensor name="look" type="logical_camera"/><sensor name="ft" type="force_torque"/>
  </link></model></world></sdf>"""


def test_noise_of_a_reading_starts_over_with_the_world(load: Load) -> None:
    sim = load(MODEL)
    first = [sim.sensor("alt").read().vertical_position_m for _ in range(500)]
    assert np.std(first) == pytest.approx(0.5, rel=0.12)
    sim.reset()
    again = [sim.sensor("alt").read().vertical_position_m for _ in range(500)]
    assert again == first
    other = load(MODEL, seed=1)
    assert other.sensor("alt").read().vertical_position_m != first[0]


def test_only_axes_with_noise_scatter(load: Load) -> None:
    sim = load(MODEL)
    fields = np.array([sim.sensor("mag").read().field_t for _ in range(500)])
    assert fields.std(axis=0) == pytest.approx([1e-6, 0.0, 0.0], rel=0.12, abs=1e-12)


def test_what_gives_no_data_says_why(load: Load) -> None:
    sim = load(MODEL)
    with pytest.raises(
        GazelleError, match="'m::l::look' is of type 'logical_camera', which is not"
    ):
        sim.sensor("look").read()
    with pytest.raises(
        GazelleError, match="force_torque sensor 'm::l::ft' does not sit in a joint"
    ):
        sim.sensor("ft").read()
