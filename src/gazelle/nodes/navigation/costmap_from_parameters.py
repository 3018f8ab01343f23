"""Costmaps from parameters: sizes, outlines, layers and their sensors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.navigation.costmap import (
    LAYER_TYPES,
    REFUSED_LAYERS,
    CostmapOptions,
    Footprint,
    InflationLayer,
    InflationOptions,
    Layer,
    LayeredCostmap,
    ObstacleLayer,
    ObstacleOptions,
    SourceOptions,
    StaticLayer,
    StaticOptions,
    VoxelOptions,
)
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import ParameterTable
from gazelle.parameters.dataclass_tables import table_of
from gazelle.parameters.reader import ParameterReader

__all__ = ["COSTMAP_TABLES", "INHERITED", "Assembly", "assemble", "costmap_table", "layer_table"]

RosVersion = Literal[1, 2]

_LIVE = {
    CostmapOptions: ("transform_tolerance", "update_frequency", "publish_frequency", "footprint",
                     "robot_radius", "footprint_padding"),
    StaticOptions: ("enabled",),
    ObstacleOptions: ("enabled", "footprint_clearing_enabled", "max_obstacle_height",
                      "combination_method"),
    VoxelOptions: ("enabled", "footprint_clearing_enabled", "max_obstacle_height",
                   "combination_method"),
    InflationOptions: ("enabled", "cost_scaling_factor", "inflation_radius", "inflate_unknown"),
    SourceOptions: (),
}  # fmt: skip
_FAMILIES = {
    CostmapOptions: ("costmap", "A costmap as a whole."),
    StaticOptions: ("static layer", "A map as a layer."),
    ObstacleOptions: ("obstacle layer", "What sensors see, as a layer."),
    VoxelOptions: ("voxel layer", "What sensors see at several heights, as a layer."),
    InflationOptions: ("inflation layer", "Costs around what is lethal, as a layer."),
    SourceOptions: ("observation source", "A sensor of an obstacle or voxel layer."),
}
# 256 MiB: 800 m × 800 m at 5 cm.
_MAX_CELLS = 1 << 28
_OUTLINE = ("footprint", "robot_radius")
_RANGES = ("obstacle_range", "raytrace_range")
INHERITED = (*_OUTLINE, *_RANGES)
"""Parameters that costmaps of ROS 1 look for in the namespaces above theirs, too."""

# What of a costmap without plugins belongs to which layer (costmap_2d, resetOldParameters).
_OLD_STATIC = ("map_topic", "unknown_cost_value", "lethal_cost_threshold", "track_unknown_space")
_OLD_INFLATION = ("cost_scaling_factor", "inflation_radius")
_OLD_OBSTACLES = ("max_obstacle_height", "raytrace_range", "obstacle_range", "track_unknown_space",
                  "observation_sources", "origin_z", "z_resolution", "z_voxels", "mark_threshold",
                  "unknown_threshold", "publish_voxel_map")  # fmt: skip
_OLD_OWN = ("static_map", "map_type")


@dataclass(slots=True)
class Assembly:
    """A costmap and what its parameters were.

    Attributes:
        costmap: the layers.
        base_footprint: the outline without padding.
        settings: of the costmap itself.
        layers: settings of each layer, by name.
        frames: of each sensor: (layer's name, source's name) → options.
    """

    costmap: LayeredCostmap
    base_footprint: Footprint
    settings: ParameterReader
    layers: dict[str, ParameterReader] = field(default_factory=dict)

    @property
    def sources(self) -> dict[tuple[str, str], SourceOptions]:
        """Sensors by the names of layer and sensor."""
        return {
            (layer.name, name): source
            for layer in self.costmap.layers
            if isinstance(layer, ObstacleLayer)
            for name, source in layer.sources.items()
        }


def costmap_table(ros_version: RosVersion = 1) -> ParameterTable:
    """Return the parameters of a costmap as a whole."""
    return _table(CostmapOptions, ros_version)


def layer_table(options: type, ros_version: RosVersion = 1) -> ParameterTable:
    """Return the parameters of a layer or of a sensor."""
    return _table(options, ros_version)


COSTMAP_TABLES: tuple[ParameterTable, ...] = ()
"""The tables of ROS 1, for the documentation; filled below."""


def assemble(
    tree: Mapping[str, Any],
    name: str,
    diagnostics: Diagnostics,
    *,
    ros_version: RosVersion = 1,
    above: Mapping[str, Any] | None = None,
) -> Assembly:
    """Make a costmap of its parameters; what is wrong with them is reported.

    Args:
        tree: the parameters, nested.
        name: what messages call it, such as ``/move_base/local_costmap``.
        diagnostics: receives what is wrong.
        ros_version: whose defaults and layout of layers.
        above: parameters of the node, where ROS 1 also looks for outline and ranges.
    """
    tree, above = dict(tree), above or {}
    is_old = ros_version == 1 and "plugins" not in tree
    rows = (
        _old_layers(tree, diagnostics, name)
        if is_old
        else _rows(tree, ros_version, name, diagnostics)
    )
    own = {key: value for key, value in tree.items() if key not in {row.name for row in rows}}
    for key in _OUTLINE:
        if key not in own and key in above:
            own[key] = above[key]
    outline = own.get("footprint")
    if isinstance(outline, list):
        own["footprint"] = repr(outline)
    settings = node_reader(costmap_table(ros_version), own, name, diagnostics)
    options = _sized(
        settings, settings.fill(CostmapOptions, plugins=tuple(row.name for row in rows))
    )
    settings.tree.pop("plugins", None)
    inherited = _RANGES if ros_version == 1 else ()
    settings.report_unknown("filters", *inherited, *_left_out(settings))
    footprint = _footprint(settings, options)
    made = Assembly(
        LayeredCostmap(options, (), footprint.padded(options.footprint_padding)),
        footprint,
        settings,
    )
    made.costmap.layers = [
        _layer(row, made, diagnostics, ros_version, (tree, above)) for row in rows
    ]
    return made


@dataclass(frozen=True, slots=True)
class _LayerRow:
    name: str
    options: type
    tree: dict[str, Any]


def _table(options: type, ros_version: RosVersion) -> ParameterTable:
    family, summary = _FAMILIES[options]
    names = tuple(name for name, kind in LAYER_TYPES.items() if kind is options)
    defaults = getattr(options, "NAV2_DEFAULTS", {}) if ros_version == 2 else {}
    return table_of(options, family, summary, names, defaults=defaults, live=_LIVE[options])


def _rows(
    tree: Mapping[str, Any], ros_version: RosVersion, name: str, diagnostics: Diagnostics
) -> list[_LayerRow]:
    """Return the layers that ``plugins`` names."""
    default = CostmapOptions.NAV2_DEFAULTS["plugins"] if ros_version == 2 else ()
    found = []
    for item in _listed(tree.get("plugins", default), name, diagnostics):
        if isinstance(item, Mapping):
            layer, kind = str(item.get("name", "")), str(item.get("type", ""))
            below = tree.get(layer)
        else:
            layer = str(item)
            below = tree.get(layer)
            kind = str(below.get("plugin", "")) if isinstance(below, Mapping) else ""
            kind = kind or _NAV2_DEFAULT_TYPES.get(layer, "")
        own = dict(below) if isinstance(below, Mapping) else {}
        own.pop("plugin", None)
        options = LAYER_TYPES.get(kind)
        if options is None:
            _refuse_layer(layer, kind, name, diagnostics)
        else:
            found.append(_LayerRow(layer, options, own))
    return found


_NAV2_DEFAULT_TYPES = {
    "static_layer": "nav2_costmap_2d::StaticLayer",
    "obstacle_layer": "nav2_costmap_2d::ObstacleLayer",
    "voxel_layer": "nav2_costmap_2d::VoxelLayer",
    "inflation_layer": "nav2_costmap_2d::InflationLayer",
}


def _left_out(settings: ParameterReader) -> list[str]:
    """Tell of layers with parameters that ``plugins`` does not name, as Nav2's own files have."""
    names = [
        key
        for key, below in settings.tree.items()
        if isinstance(below, Mapping)
        and (key in _NAV2_DEFAULT_TYPES or below.get("plugin") in LAYER_TYPES)
    ]
    for name in names:
        text = f"layer '{name}' has parameters and is not one of plugins; it is not made"
        settings.report("parameter.idle", text, "add it to plugins, or leave it out")
    return names


def _listed(value: Any, name: str, diagnostics: Diagnostics) -> Sequence[Any]:
    if isinstance(value, list | tuple):
        return value
    text = f"{name}: parameter 'plugins' is {value!r}, not a list; there are no layers"
    diagnostics.report("parameter.bad-value", text, fix="write a list of {name, type}")
    return ()


def _refuse_layer(layer: str, kind: str, name: str, diagnostics: Diagnostics) -> None:
    why = REFUSED_LAYERS.get(kind) or did_you_mean(kind, LAYER_TYPES)
    known = ", ".join(sorted({word.rpartition(":")[2] for word in LAYER_TYPES if "::" in word}))
    text = f"{name}: layer '{layer}' is of type '{kind}', which is not known; there are {known}"
    diagnostics.report("navigation.unknown-plugin", f"{text}. The costmap goes without it", fix=why)


def _old_layers(tree: dict[str, Any], diagnostics: Diagnostics, name: str) -> list[_LayerRow]:
    """Return the layers of a costmap without ``plugins``, as ROS 1 makes them.

    Parameters of the layers stand in the costmap itself; they are taken out of `tree`.
    """
    rows = []
    is_static = tree.get("static_map") is True
    is_voxel = tree.get("map_type") == "voxel"
    sources = str(tree.get("observation_sources", "")).split()

    def moved(keys: Sequence[str]) -> dict[str, Any]:
        return {key: tree[key] for key in keys if key in tree}

    if is_static:
        rows.append(_LayerRow("static_layer", StaticOptions, moved(_OLD_STATIC)))
    kind = VoxelOptions if is_voxel else ObstacleOptions
    rows.append(_LayerRow("obstacle_layer", kind, moved((*_OLD_OBSTACLES, *sources))))
    rows.append(_LayerRow("inflation_layer", InflationOptions, moved(_OLD_INFLATION)))
    kept = set(costmap_table().keys())
    for key in (*_OLD_STATIC, *_OLD_INFLATION, *_OLD_OBSTACLES, *_OLD_OWN, *sources):
        if key not in kept:
            tree.pop(key, None)
    for row in rows:
        below = tree.pop(row.name, None)
        if isinstance(below, Mapping):
            row.tree.update(below)
    return rows


def _layer(
    row: _LayerRow,
    made: Assembly,
    diagnostics: Diagnostics,
    ros_version: RosVersion,
    trees: Sequence[Mapping[str, Any]],
) -> Layer:
    name = f"{made.settings.name}/{row.name}"
    table = _table(row.options, ros_version)
    settings = node_reader(table, row.tree, name, diagnostics)
    made.layers[row.name] = settings
    if row.options is StaticOptions:
        settings.report_unknown()
        return StaticLayer(settings.fill(StaticOptions), row.name)
    if row.options is InflationOptions:
        settings.report_unknown()
        return InflationLayer(settings.fill(InflationOptions), row.name)
    own = made.costmap.options.track_unknown_space
    names = settings.text("observation_sources").split()
    kind: type[ObstacleOptions] = row.options
    options = settings.fill(kind, track_unknown_space=settings.flag("track_unknown_space", own))
    sources = {
        source: _source(source, settings, ros_version, (row.tree, *trees)) for source in names
    }
    settings.report_unknown(*names)
    return ObstacleLayer(options, sources, row.name)


def _source(
    source: str, layer: ParameterReader, ros_version: RosVersion, trees: Sequence[Mapping[str, Any]]
) -> SourceOptions:
    """Return a sensor; ranges that it does not say are those of the layer or above."""
    settings = layer.below(source, _table(SourceOptions, ros_version))
    for key in _RANGES if ros_version == 1 else ():
        above = next((tree[key] for tree in trees if key in tree), None)
        if above is not None:
            settings.tree.setdefault(key, above)
    default = "PointCloud" if ros_version == 1 else "LaserScan"
    options = settings.fill(
        SourceOptions,
        topic=settings.text("topic") or source,
        data_type=settings.text("data_type", default),
    )
    settings.report_unknown()
    return options


def _sized(settings: ParameterReader, options: CostmapOptions) -> CostmapOptions:
    """Return options of a costmap that has no more cells than a machine can hold."""
    cells = options.width / options.resolution * (options.height / options.resolution)
    if cells <= _MAX_CELLS:
        return options
    usual = CostmapOptions()
    settings.report(
        "parameter.bad-value",
        f"parameters 'width' ({options.width:g} m) and 'height' ({options.height:g} m) are "
        f"{cells:.3g} cells of {options.resolution:g} m, {_MAX_CELLS:.3g} can be held; "
        f"{usual.width:g} m and {usual.height:g} m are used",
        "write a smaller window or a coarser resolution",
    )
    return replace(options, width=usual.width, height=usual.height)


def _footprint(settings: ParameterReader, options: CostmapOptions) -> Footprint:
    text = options.footprint.strip()
    if text in ("", "[]"):
        return Footprint.of_radius(options.robot_radius)
    try:
        return Footprint.parse(text)
    except ValueError as error:
        radius = options.robot_radius
        message = f"parameter 'footprint': {error}; a circle of {radius:g} m is used"
        settings.report("parameter.bad-value", message, "write [[x1, y1], [x2, y2], [x3, y3]]")
        return Footprint.of_radius(radius)


COSTMAP_TABLES = tuple(_table(options, 1) for options in _FAMILIES)
