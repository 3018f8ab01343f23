#pragma once

#include <sensor_msgs/msg/point_cloud2.hpp>
#include <sensor_msgs/msg/point_field.hpp>

#include <gazelle/clouds/point_cloud2.hpp>

#include <string>

namespace sensor_msgs {

class PointCloud2Modifier : public ::gazelle::clouds::Modifier<::sensor_msgs::msg::PointCloud2,
                                                               ::sensor_msgs::msg::PointField> {
 public:
  explicit PointCloud2Modifier(::sensor_msgs::msg::PointCloud2& cloud_msg) : Modifier(cloud_msg) {}
};

template <typename T>
class PointCloud2Iterator : public ::gazelle::clouds::Iterator<T, ::sensor_msgs::msg::PointCloud2,
                                                               PointCloud2Iterator<T>> {
 public:
  PointCloud2Iterator() = default;
  PointCloud2Iterator(::sensor_msgs::msg::PointCloud2& cloud_msg, const std::string& field_name)
      : PointCloud2Iterator::Iterator(cloud_msg, field_name) {}
};

template <typename T>
class PointCloud2ConstIterator
    : public ::gazelle::clouds::Iterator<const T, const ::sensor_msgs::msg::PointCloud2,
                                         PointCloud2ConstIterator<T>> {
 public:
  PointCloud2ConstIterator() = default;
  PointCloud2ConstIterator(const ::sensor_msgs::msg::PointCloud2& cloud_msg,
                           const std::string& field_name)
      : PointCloud2ConstIterator::Iterator(cloud_msg, field_name) {}
};

}  // namespace sensor_msgs
