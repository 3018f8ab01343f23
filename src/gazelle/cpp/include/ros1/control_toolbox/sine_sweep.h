#pragma once

#include <ros/duration.h>
#include <ros/time.h>

#include <cmath>

namespace control_toolbox {

// A sine whose frequency grows exponentially from one to another.
class SineSweep {
 public:
  bool init(double start_freq, double end_freq, double duration, double amplitude) {
    if (start_freq > end_freq || duration <= 0.0 || amplitude < 0.0) return false;
    amplitude_ = amplitude;
    duration_ = ros::Duration(duration);
    const double from = 2.0 * M_PI * start_freq, to = 2.0 * M_PI * end_freq;
    growth_ = duration / std::log(to / from);
    scale_ = from * growth_;
    command_ = 0.0;
    return true;
  }
  double update(ros::Duration dt) {
    command_ = dt <= duration_
                   ? amplitude_ * std::sin(scale_ * (std::exp(dt.toSec() / growth_) - 1.0))
                   : 0.0;
    return command_;
  }

 private:
  double amplitude_ = 0.0;
  ros::Duration duration_;
  double scale_ = 0.0;
  double growth_ = 1.0;
  double command_ = 0.0;
};

}  // namespace control_toolbox
