"""Parameters without effect in files of ROS 2."""

from __future__ import annotations

from pathlib import Path

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.parameters import check_parameter_file

_TEXT = """\
amcl:
  ros__parameters:
    max_beams: 60
    do_beamskip: true
    beam_skip_distance: 0.5
local_costmap:
  local_costmap:
    ros__parameters:
      plugins: [static_layer]
      static_layer:
        plugin: nav2_costmap_2d::StaticLayer
        map_subscribe_transient_local: true
my_driver:
  ros__parameters:
    beam_skip_distance: 0.5
"""


def test_parameters_without_effect_are_told_at_their_lines(tmp_path: Path) -> None:
    path = tmp_path / "nav2_params.yaml"
    path.write_text(_TEXT)
    diagnostics = Diagnostics()
    check_parameter_file(path, diagnostics=diagnostics)
    found = diagnostics.by_code("parameter.idle")
    last = found[-1]
    assert last.span is not None
    assert (last.span.line, last.span.column) == (12, 9)
    assert last.message.startswith(
        "/local_costmap/local_costmap: parameter 'static_layer.map_subscribe_transient_local' has "
    )
    assert all("my_driver" not in item.message for item in found)
