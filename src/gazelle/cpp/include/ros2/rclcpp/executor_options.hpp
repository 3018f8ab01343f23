#pragma once

#include <cstddef>

#include "rclcpp/context.hpp"
#include "rclcpp/memory_strategies.hpp"

namespace rclcpp {

struct ExecutorOptions {
  memory_strategy::MemoryStrategy::SharedPtr memory_strategy =
      memory_strategies::create_default_strategy();
  Context::SharedPtr context = contexts::get_global_default_context();
  std::size_t max_conditions = 0;
};

}  // namespace rclcpp
