// A transform as a buffer keeps it.
#pragma once

#include <cstdint>

#include "ros/time.h"
#include "tf2/LinearMath/Transform.h"

namespace tf2 {

using CompactFrameID = std::uint32_t;

struct TransformStorage {
  Quaternion rotation_{0.0, 0.0, 0.0, 1.0};
  Vector3 translation_{0.0, 0.0, 0.0};
  ros::Time stamp_;
  CompactFrameID frame_id_ = 0;
  CompactFrameID child_frame_id_ = 0;
};

}  // namespace tf2
