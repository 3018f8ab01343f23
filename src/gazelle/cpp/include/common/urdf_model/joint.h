#pragma once

#include <string>

#include "urdf_model/pose.h"
#include "urdf_model/types.h"

namespace urdf {

class JointDynamics {
 public:
  void clear() { damping = friction = 0.0; }

  double damping = 0.0;
  double friction = 0.0;
};

class JointLimits {
 public:
  void clear() { lower = upper = effort = velocity = 0.0; }

  double lower = 0.0;
  double upper = 0.0;
  double effort = 0.0;
  double velocity = 0.0;
};

class JointSafety {
 public:
  void clear() { soft_upper_limit = soft_lower_limit = k_position = k_velocity = 0.0; }

  double soft_upper_limit = 0.0;
  double soft_lower_limit = 0.0;
  double k_position = 0.0;
  double k_velocity = 0.0;
};

class JointCalibration {
 public:
  void clear() {
    reference_position = 0.0;
    rising.reset();
    falling.reset();
  }

  double reference_position = 0.0;
  std::shared_ptr<double> rising;
  std::shared_ptr<double> falling;
};

class JointMimic {
 public:
  void clear() {
    offset = multiplier = 0.0;
    joint_name.clear();
  }

  double offset = 0.0;
  double multiplier = 1.0;
  std::string joint_name;
};

class Joint {
 public:
  enum { UNKNOWN, REVOLUTE, CONTINUOUS, PRISMATIC, FLOATING, PLANAR, FIXED };

  void clear() { *this = Joint(); }

  std::string name;
  int type = UNKNOWN;
  Vector3 axis;
  std::string child_link_name;
  std::string parent_link_name;
  Pose parent_to_joint_origin_transform;
  JointDynamicsSharedPtr dynamics;
  JointLimitsSharedPtr limits;
  JointSafetySharedPtr safety;
  JointCalibrationSharedPtr calibration;
  JointMimicSharedPtr mimic;
};

}  // namespace urdf
