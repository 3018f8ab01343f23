// Angles of rotations.
#pragma once

#include <cmath>

#include "geometry_msgs/msg/quaternion_stamped.hpp"
#include "tf2/LinearMath/Transform.h"
#include "tf2/convert.hpp"
#include "tf2/transform_datatypes.hpp"

#define GAZELLE_GEOMETRY(Name) ::geometry_msgs::msg::Name
#include "gazelle/tf2_angles.inc"
#undef GAZELLE_GEOMETRY
