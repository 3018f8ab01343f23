#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "urdf_model/joint.h"

namespace pr2_mechanism_model {

class JointState;

// What a joint has gone through since somebody asked last.
class JointStatistics {
 public:
  JointStatistics() { reset(); }

  void update(JointState* joint);
  void reset() {
    odometer_ = 0.0;
    max_abs_velocity_ = max_abs_effort_ = 0.0;
    violated_limits_ = false;
    initialized_ = false;
  }

  double odometer_ = 0.0;
  double min_position_ = 0.0;
  double max_position_ = 0.0;
  double max_abs_velocity_ = 0.0;
  double max_abs_effort_ = 0.0;
  bool violated_limits_ = false;

 private:
  friend class JointState;
  bool initialized_ = false;
  double old_position_ = 0.0;
};

// One joint as controllers see it: read what is measured, write commanded_effort_ in update().
class JointState {
 public:
  // Bring the commanded effort within the joint's limits.
  void enforceLimits() {
    double low, high;
    getLimits(low, high);
    commanded_effort_ = std::min(std::max(commanded_effort_, low), high);
  }
  void getLimits(double& effort_low, double& effort_high) {
    effort_low = -std::numeric_limits<double>::infinity();
    effort_high = -effort_low;
    if (!joint_ || !joint_->limits) return;
    const urdf::JointLimits& limits = *joint_->limits;
    if (limits.effort > 0.0) {
      effort_low = -limits.effort;
      effort_high = limits.effort;
    }
    if (!joint_->safety) return;
    // The soft limits: the velocity that is allowed shrinks towards them, and the effort with how
    // far the velocity is from what is allowed.
    const urdf::JointSafety& safety = *joint_->safety;
    double speed_low = -limits.velocity, speed_high = limits.velocity;
    if (joint_->type == urdf::Joint::REVOLUTE || joint_->type == urdf::Joint::PRISMATIC) {
      const auto speed = [&](double limit) {
        const double wanted = -safety.k_position * (position_ - limit);
        return std::min(std::max(wanted, -limits.velocity), limits.velocity);
      };
      speed_low = speed(safety.soft_lower_limit);
      speed_high = speed(safety.soft_upper_limit);
    }
    const auto effort = [&](double allowed) {
      const double wanted = -safety.k_velocity * (velocity_ - allowed);
      return std::min(std::max(wanted, -limits.effort), limits.effort);
    };
    effort_low = effort(speed_low);
    effort_high = effort(speed_high);
  }

  std::shared_ptr<const urdf::Joint> joint_;

  double position_ = 0.0;         // rad or m
  double velocity_ = 0.0;         // rad/s or m/s
  double measured_effort_ = 0.0;  // N·m or N

  double commanded_effort_ = 0.0;

  bool calibrated_ = false;
  double reference_position_ = 0.0;
  JointStatistics joint_statistics_;
};

enum {
  JOINT_NONE,
  JOINT_ROTARY,
  JOINT_CONTINUOUS,
  JOINT_PRISMATIC,
  JOINT_FIXED,
  JOINT_PLANAR,
  JOINT_TYPES_MAX
};

inline void JointStatistics::update(JointState* joint) {
  if (initialized_) {
    odometer_ += std::fabs(old_position_ - joint->position_);
    min_position_ = std::min(joint->position_, min_position_);
    max_position_ = std::max(joint->position_, max_position_);
    max_abs_velocity_ = std::max(std::fabs(joint->velocity_), max_abs_velocity_);
    max_abs_effort_ = std::max(std::fabs(joint->measured_effort_), max_abs_effort_);
  } else {
    min_position_ = max_position_ = joint->position_;
    initialized_ = true;
  }
  old_position_ = joint->position_;
}

}  // namespace pr2_mechanism_model
