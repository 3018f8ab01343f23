#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "rclcpp_lifecycle/visibility_control.h"

namespace rclcpp_lifecycle {

/// A state of a managed node.
class State {
 public:
  State() = default;
  State(uint8_t id, const std::string& label) : id_(id), label_(label) {
    if (label.empty()) throw std::runtime_error("Lifecycle State cannot have an empty label.");
  }
  virtual ~State() = default;
  uint8_t id() const { return id_; }
  std::string label() const { return label_; }

 protected:
  uint8_t id_ = 0;
  std::string label_ = "unknown";
};

}  // namespace rclcpp_lifecycle
