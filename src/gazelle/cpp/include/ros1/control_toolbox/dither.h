#pragma once

#include <random>

namespace control_toolbox {

// White noise of a normal distribution, the same after every start.
class Dither {
 public:
  bool init(const double& amplitude, const double& seed) {
    if (amplitude < 0.0) return false;
    amplitude_ = amplitude;
    source_.seed(static_cast<std::mt19937::result_type>(seed));
    return true;
  }
  double update() { return amplitude_ * normal_(source_); }

 private:
  double amplitude_ = 0.0;
  std::mt19937 source_;
  std::normal_distribution<double> normal_{0.0, 1.0};
};

}  // namespace control_toolbox
