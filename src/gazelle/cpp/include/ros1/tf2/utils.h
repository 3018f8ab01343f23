// Angles of rotations.
#pragma once

#include <cmath>

#include "geometry_msgs/QuaternionStamped.h"
#include "tf2/LinearMath/Transform.h"
#include "tf2/convert.h"
#include "tf2/transform_datatypes.h"

#define GAZELLE_GEOMETRY(Name) ::geometry_msgs::Name
#include "gazelle/tf2_angles.inc"
#undef GAZELLE_GEOMETRY
