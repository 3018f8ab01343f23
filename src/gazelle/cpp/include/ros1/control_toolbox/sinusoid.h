#pragma once

#include <cmath>

namespace control_toolbox {

// offset + amplitude·sin(2π·frequency·time + phase), with its first two derivatives.
class Sinusoid {
 public:
  Sinusoid() = default;
  Sinusoid(double offset, double amplitude, double frequency, double phase)
      : offset_(offset), amplitude_(amplitude), frequency_(frequency), phase_(phase) {}

  double update(double time, double& qd, double& qdd) {
    const double omega = 2.0 * M_PI * frequency_;
    const double angle = omega * time + phase_;
    qd = omega * amplitude_ * std::cos(angle);
    qdd = -omega * omega * amplitude_ * std::sin(angle);
    return offset_ + amplitude_ * std::sin(angle);
  }

 private:
  double offset_ = 0.0;
  double amplitude_ = 0.0;
  double frequency_ = 0.0;
  double phase_ = 0.0;
};

}  // namespace control_toolbox
