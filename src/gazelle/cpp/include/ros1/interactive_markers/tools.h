#pragma once

#include <visualization_msgs/InteractiveMarker.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace interactive_markers {

using ColorMsg = std_msgs::ColorRGBA;
using InteractiveMarker = visualization_msgs::InteractiveMarker;
using InteractiveMarkerControl = visualization_msgs::InteractiveMarkerControl;
using Marker = visualization_msgs::Marker;
using PointMsg = geometry_msgs::Point;
using QuaternionMsg = geometry_msgs::Quaternion;

#include "gazelle/interactive_markers/tools.inc"

}  // namespace interactive_markers
