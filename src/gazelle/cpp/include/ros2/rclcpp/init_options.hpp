#pragma once

#include <cstddef>
#include <memory>

#include "rcl/allocator.h"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// What `init` is told; the graph's number is the environment's unless it is set here.
class RCLCPP_PUBLIC InitOptions {
 public:
  explicit InitOptions(rcl_allocator_t allocator = rcl_get_default_allocator()) { (void)allocator; }
  bool shutdown_on_signal = true;
  bool auto_initialize_logging() const { return logging_; }
  InitOptions& auto_initialize_logging(bool initialize) {
    logging_ = initialize;
    return *this;
  }
  void set_domain_id(std::size_t number) { domain_ = number; }
  std::size_t get_domain_id() const { return domain_; }
  void use_default_domain_id() { domain_ = 0; }

 private:
  bool logging_ = true;
  std::size_t domain_ = 0;
};

}  // namespace rclcpp
