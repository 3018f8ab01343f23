#pragma once

#include <cstddef>
#include <cstdint>
#include <typeinfo>

#include <boost/shared_array.hpp>
#include <boost/shared_ptr.hpp>

namespace ros {

// A message as ROS 1's bytes, with their length before them where a connection sends it so.
class SerializedMessage {
 public:
  boost::shared_array<uint8_t> buf;
  size_t num_bytes;
  uint8_t* message_start;

  boost::shared_ptr<void const> message;
  const std::type_info* type_info;

  SerializedMessage()
      : buf(boost::shared_array<uint8_t>()),
        num_bytes(0),
        message_start(nullptr),
        type_info(nullptr) {}
  SerializedMessage(boost::shared_array<uint8_t> buffer, size_t size)
      : buf(buffer),
        num_bytes(size),
        message_start(buffer ? buffer.get() : nullptr),
        type_info(nullptr) {}
};

}  // namespace ros
