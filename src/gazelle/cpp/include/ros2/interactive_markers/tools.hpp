#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "visualization_msgs/msg/interactive_marker.hpp"

namespace interactive_markers {

using ColorMsg = std_msgs::msg::ColorRGBA;
using InteractiveMarker = visualization_msgs::msg::InteractiveMarker;
using InteractiveMarkerControl = visualization_msgs::msg::InteractiveMarkerControl;
using Marker = visualization_msgs::msg::Marker;
using PointMsg = geometry_msgs::msg::Point;
using QuaternionMsg = geometry_msgs::msg::Quaternion;

#include "gazelle/interactive_markers/tools.inc"

}  // namespace interactive_markers
