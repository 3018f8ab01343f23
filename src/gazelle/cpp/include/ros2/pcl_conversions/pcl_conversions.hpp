// Point clouds of ROS 2 and of PCL, which must be installed.
#pragma once

#include <pcl/PCLHeader.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/PCLPointField.h>
#include <pcl/conversions.h>
#include <pcl/point_cloud.h>

#include <cstdint>
#include <string>
#include <vector>

#include "rclcpp/time.hpp"
#include "sensor_msgs/msg/point_cloud2.hpp"
#include "std_msgs/msg/header.hpp"

namespace pcl_conversions {
namespace impl {

inline std::uint64_t microseconds(const rclcpp::Time& stamp) {
  return static_cast<std::uint64_t>(stamp.nanoseconds() / 1000);
}
inline rclcpp::Time stamp_of(std::uint64_t us) {
  return rclcpp::Time(static_cast<std::int64_t>(us) * 1000);
}
// Headers of ROS 2 have no number.
inline std::uint32_t sequence(const std_msgs::msg::Header&) { return 0; }
inline void set_sequence(std_msgs::msg::Header&, std::uint32_t) {}

}  // namespace impl
}  // namespace pcl_conversions

#define GAZELLE_MSG(package, Name) ::package::msg::Name
#define GAZELLE_STAMP rclcpp::Time
#include "gazelle/pcl_conversions.inc"
#undef GAZELLE_STAMP
#undef GAZELLE_MSG
