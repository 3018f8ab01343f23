#pragma once

#include <cstdint>
#include <ostream>
#include <string>

#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// Where packets of a topic go by; this graph has no such places.
class NetworkFlowEndpoint {
 public:
  const std::string& transport_protocol() const { return transport_; }
  const std::string& internet_protocol() const { return internet_; }
  uint16_t transport_port() const { return 0; }
  uint32_t flow_label() const { return 0; }
  uint8_t dscp() const { return 0; }
  const std::string& internet_address() const { return address_; }
  friend bool operator==(const NetworkFlowEndpoint&, const NetworkFlowEndpoint&) { return true; }
  friend bool operator!=(const NetworkFlowEndpoint&, const NetworkFlowEndpoint&) { return false; }
  friend std::ostream& operator<<(std::ostream& out, const NetworkFlowEndpoint&) {
    return out << "{}";
  }

 private:
  std::string transport_, internet_, address_;
};

}  // namespace rclcpp
