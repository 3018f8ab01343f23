#pragma once

#include <sensor_msgs/msg/point_cloud.hpp>
#include <sensor_msgs/msg/point_cloud2.hpp>
#include <sensor_msgs/msg/point_field.hpp>

#include <gazelle/clouds/point_cloud2.hpp>

#include <string>

namespace sensor_msgs {

inline int getPointCloud2FieldIndex(const ::sensor_msgs::msg::PointCloud2& cloud,
                                    const std::string& field_name) {
  return ::gazelle::clouds::field_index(cloud, field_name);
}

inline bool convertPointCloudToPointCloud2(const ::sensor_msgs::msg::PointCloud& input,
                                           ::sensor_msgs::msg::PointCloud2& output) {
  return ::gazelle::clouds::to_cloud2<::sensor_msgs::msg::PointField>(input, output);
}

// False where the cloud has no x, y and z.
inline bool convertPointCloud2ToPointCloud(const ::sensor_msgs::msg::PointCloud2& input,
                                           ::sensor_msgs::msg::PointCloud& output) {
  return ::gazelle::clouds::from_cloud2(input, output);
}

}  // namespace sensor_msgs
