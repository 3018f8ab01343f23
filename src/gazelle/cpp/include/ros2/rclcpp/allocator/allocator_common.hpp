#pragma once

#include <memory>

#include "rcl/allocator.h"
#include "rclcpp/allocator/allocator_deleter.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {
namespace allocator {

template <typename T, typename Alloc>
using AllocRebind = typename std::allocator_traits<Alloc>::template rebind_traits<T>;

template <typename T, typename Alloc>
rcl_allocator_t get_rcl_allocator(Alloc&) {
  return rcl_get_default_allocator();
}

}  // namespace allocator
}  // namespace rclcpp
