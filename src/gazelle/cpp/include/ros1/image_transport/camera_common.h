#pragma once

#include <image_transport/exports.h>

#include <string>

namespace image_transport {

/// "camera_info" beside the images' topic.
IMAGE_TRANSPORT_DECL std::string getCameraInfoTopic(const std::string& base_topic);

}  // namespace image_transport
