#pragma once

#include <cstdlib>
#include <set>
#include <stdexcept>
#include <string>

namespace sensor_msgs {
namespace image_encodings {

#include <gazelle/clouds/image_encodings.hpp>

}  // namespace image_encodings
}  // namespace sensor_msgs
