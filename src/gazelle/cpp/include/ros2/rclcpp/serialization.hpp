#pragma once

#include <stdexcept>

#include "gazelle/message.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// Writes and reads messages as CDR.
class RCLCPP_PUBLIC SerializationBase {
 public:
  explicit SerializationBase(const gazelle::MessageType& type) : type_(&type) {}
  virtual ~SerializationBase() = default;
  void serialize_message(const void* ros_message, SerializedMessage* serialized) const;
  void deserialize_message(const SerializedMessage* serialized, void* ros_message) const;

 private:
  virtual void assign(void* target, void* source) const = 0;
  const gazelle::MessageType* type_;
};

template <typename MessageT>
class Serialization : public SerializationBase {
 public:
  Serialization() : SerializationBase(gazelle::message_type<MessageT>()) {}

 private:
  void assign(void* target, void* source) const override {
    *static_cast<MessageT*>(target) = std::move(*static_cast<MessageT*>(source));
  }
};

}  // namespace rclcpp
