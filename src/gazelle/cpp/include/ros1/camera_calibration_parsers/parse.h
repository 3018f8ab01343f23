#pragma once
// Calibrations of cameras in files of YAML.

#include <ros/macros.h>
#include <sensor_msgs/CameraInfo.h>

#include <string>

namespace camera_calibration_parsers {

/// By the file's ending (.yaml, .yml); false, and says why, where it cannot.
ROS_HELPER_EXPORT bool writeCalibration(const std::string& file_name,
                                        const std::string& camera_name,
                                        const sensor_msgs::CameraInfo& cam_info);
ROS_HELPER_EXPORT bool readCalibration(const std::string& file_name, std::string& camera_name,
                                       sensor_msgs::CameraInfo& cam_info);
/// A text; `format` is "yml" or "yaml".
ROS_HELPER_EXPORT bool parseCalibration(const std::string& buffer, const std::string& format,
                                        std::string& camera_name,
                                        sensor_msgs::CameraInfo& cam_info);

}  // namespace camera_calibration_parsers
