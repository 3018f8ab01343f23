#pragma once

#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <gazelle/clouds/point_cloud2.hpp>

#include <string>

namespace sensor_msgs {

inline bool fillImage(::sensor_msgs::Image& image, const std::string& encoding_arg,
                      uint32_t rows_arg, uint32_t cols_arg, uint32_t step_arg,
                      const void* data_arg) {
  return ::gazelle::clouds::fill_image(image, encoding_arg, rows_arg, cols_arg, step_arg, data_arg);
}

inline void clearImage(::sensor_msgs::Image& image) { image.data.clear(); }

}  // namespace sensor_msgs
