#pragma once

#include <sensor_msgs/msg/point_field.hpp>

#include <gazelle/clouds/point_cloud2.hpp>

namespace sensor_msgs {

inline int sizeOfPointField(int datatype) { return ::gazelle::clouds::size_of_kind(datatype); }

template <typename T>
T readPointCloud2BufferValue(const unsigned char* data_ptr, const unsigned char datatype) {
  return ::gazelle::clouds::read_number<T>(data_ptr, datatype);
}

template <typename T>
void writePointCloud2BufferValue(unsigned char* data_ptr, const unsigned char datatype, T value) {
  ::gazelle::clouds::write_number(data_ptr, datatype, value);
}

}  // namespace sensor_msgs
