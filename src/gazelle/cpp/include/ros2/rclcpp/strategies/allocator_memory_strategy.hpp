#pragma once

#include <memory>

#include "rclcpp/memory_strategy.hpp"

namespace rclcpp {
namespace memory_strategies {
namespace allocator_memory_strategy {

template <typename Alloc = std::allocator<void>>
class AllocatorMemoryStrategy : public memory_strategy::MemoryStrategy {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(AllocatorMemoryStrategy)
  AllocatorMemoryStrategy() = default;
  explicit AllocatorMemoryStrategy(std::shared_ptr<Alloc> allocator)
      : allocator_(std::move(allocator)) {}

 private:
  std::shared_ptr<Alloc> allocator_;
};

}  // namespace allocator_memory_strategy
}  // namespace memory_strategies
}  // namespace rclcpp
