#pragma once

#include <camera_calibration_parsers/parse.h>

namespace camera_calibration_parsers {

inline bool writeCalibrationYml(const std::string& file_name, const std::string& camera_name,
                                const sensor_msgs::CameraInfo& cam_info) {
  return writeCalibration(file_name, camera_name, cam_info);
}
inline bool readCalibrationYml(const std::string& file_name, std::string& camera_name,
                               sensor_msgs::CameraInfo& cam_info) {
  return readCalibration(file_name, camera_name, cam_info);
}

}  // namespace camera_calibration_parsers
