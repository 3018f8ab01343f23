// Images of ROS 1 and OpenCV.
#pragma once

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <string>

#include "gazelle/cv_encodings.hpp"
#include "sensor_msgs/CompressedImage.h"
#include "sensor_msgs/Image.h"
#include "sensor_msgs/image_encodings.h"

#define GAZELLE_MSG(package, Name) ::package::Name
#define GAZELLE_POINTER boost
#define GAZELLE_CONST_PTR(package, Name) ::package::Name##ConstPtr
#include "gazelle/cv_bridge.inc"
#undef GAZELLE_CONST_PTR
#undef GAZELLE_POINTER
#undef GAZELLE_MSG
