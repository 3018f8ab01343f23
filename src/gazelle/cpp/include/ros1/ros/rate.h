#pragma once

#include <ros/duration.h>
#include <ros/macros.h>
#include <ros/time.h>

namespace ros {

/// Keeps a loop at a frequency of ros::Time.
class ROSTIME_DECL Rate {
 public:
  Rate(double frequency);
  explicit Rate(const Duration& cycle);
  /// Sleeps until the cycle is over; false where it was over before.
  bool sleep();
  void reset();
  Duration cycleTime() const { return actual_cycle_time_; }
  Duration expectedCycleTime() const { return expected_cycle_time_; }

 private:
  Time start_;
  Duration expected_cycle_time_, actual_cycle_time_;
};

/// Keeps a loop at a frequency of the machine's time.
class ROSTIME_DECL WallRate {
 public:
  WallRate(double frequency);
  explicit WallRate(const Duration& cycle);
  bool sleep();
  void reset();
  WallDuration cycleTime() const { return actual_cycle_time_; }
  WallDuration expectedCycleTime() const { return expected_cycle_time_; }

 private:
  WallTime start_;
  WallDuration expected_cycle_time_, actual_cycle_time_;
};

}  // namespace ros
