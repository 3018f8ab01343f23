// Messages of ROS 1 in ROS 1's own bytes: for bags, ros::serialization and ShapeShifter.
#pragma once

#include <gazelle/message.hpp>

namespace gazelle {

template <class M>
void to_ros1(const M& message, std::vector<std::uint8_t>& bytes) {
  encode_ros1(Description<M>::layout(), &message, bytes);
}

template <class M>
std::size_t from_ros1(M& message, const std::uint8_t* bytes, std::size_t size) {
  return decode_ros1(Description<M>::layout(), &message, bytes, size);
}

template <class M>
std::size_t ros1_size(const M& message) {
  return ros1_size(Description<M>::layout(), &message);
}

}  // namespace gazelle
