#pragma once

#include <string>

namespace sensor_msgs {
namespace distortion_models {

inline const std::string PLUMB_BOB = "plumb_bob";
inline const std::string RATIONAL_POLYNOMIAL = "rational_polynomial";
inline const std::string EQUIDISTANT = "equidistant";

}  // namespace distortion_models
}  // namespace sensor_msgs
