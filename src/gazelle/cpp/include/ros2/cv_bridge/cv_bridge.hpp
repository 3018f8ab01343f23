// Images of ROS 2 and OpenCV.
#pragma once

#include <memory>
#include <string>

#include "gazelle/cv_encodings.hpp"
#include "sensor_msgs/image_encodings.hpp"
#include "sensor_msgs/msg/compressed_image.hpp"
#include "sensor_msgs/msg/image.hpp"
#include "std_msgs/msg/header.hpp"

#define GAZELLE_MSG(package, Name) ::package::msg::Name
#define GAZELLE_POINTER std
#define GAZELLE_CONST_PTR(package, Name) ::package::msg::Name::ConstSharedPtr
#include "gazelle/cv_bridge.inc"
#undef GAZELLE_CONST_PTR
#undef GAZELLE_POINTER
#undef GAZELLE_MSG
