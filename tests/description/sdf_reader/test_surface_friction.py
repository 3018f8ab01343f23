from __future__ import annotations

import math

import pytest

from gazelle.description.model import Surface
from gazelle.description.sdf_reader.surface_friction import read_surface


def test_silence_is_none_everywhere(tag, context):
    assert read_surface(None, context) == Surface()
    surface = tag(
        "<surface><bounce/><friction><ode/></friction><contact><ode/></contact></surface>"
    )
    found = read_surface(surface, context)
    assert (found.mu1, found.kp, found.restitution, found.torsional_mu) == (None,) * 4


def test_all_words_of_ode(tag, context):
    found = read_surface(
        tag(
            "<surface><friction><ode><mu>1</mu><mu2>2</mu2><fdir1>0 3 4</fdir1><slip1>5</slip1>"
            "<slip2>6</slip2></ode></friction><bounce><restitution_coefficient>.7"
            "</restitution_coefficient><threshold>8</threshold></bounce><contact>"
            "<collide_bitmask>0x0f</collide_bitmask><collide_without_contact>1"
            "</collide_without_contact><ode><soft_cfm>9</soft_cfm><soft_erp>10</soft_erp>"
            "<kp>11</kp><kd>12</kd><max_vel>13</max_vel><min_depth>14</min_depth></ode></contact>"
            "</surface>"
        ),
        context,
    )
    assert (found.mu1, found.mu2, found.slip1, found.slip2) == (1, 2, 5, 6)
    assert found.fdir1 == pytest.approx((0, 0.6, 0.8))
    assert (found.restitution, found.bounce_threshold_m_s) == (0.7, 8)
    assert (found.collide_bitmask, found.collide_without_contact) == (15, True)
    assert (found.soft_cfm, found.soft_erp, found.kp, found.kd) == (9, 10, 11, 12)
    assert (found.max_vel_m_s, found.min_depth_m) == (13, 14)


def test_null_direction_means_automatic(tag, context):
    text = "<surface><friction><ode><fdir1>0 0 0</fdir1></ode></friction></surface>"
    assert read_surface(tag(text), context).fdir1 is None


def test_bullets_words_count_where_odes_are_missing(tag, context):
    text = (
        "<surface><friction><bullet><friction>.5</friction><friction2>.6</friction2>"
        "<rolling_friction>.1</rolling_friction></bullet></friction>"
        "<contact><bullet><kp>7</kp><kd>8</kd></bullet></contact></surface>"
    )
    found = read_surface(tag(text), context)
    assert (found.mu1, found.mu2, found.rolling_mu, found.kp, found.kd) == (0.5, 0.6, 0.1, 7, 8)


def test_torsional_friction(tag, context):
    text = (
        "<surface><friction><torsional><coefficient>.3</coefficient><patch_radius>.02"
        "</patch_radius></torsional></friction></surface>"
    )
    found = read_surface(tag(text), context)
    assert (found.torsional_mu, found.torsional_patch_radius_m) == (0.3, 0.02)


def test_surface_radius_stands_for_a_patch(tag, context):
    text = (
        "<surface><friction><torsional><use_patch_radius>0</use_patch_radius><surface_radius>.1"
        "</surface_radius></torsional></friction></surface>"
    )
    found = read_surface(tag(text), context)
    assert found.torsional_patch_radius_m == pytest.approx(math.sqrt(0.1 * 0.001))
