#pragma once

#include <memory>
#include <utility>

#define RCLCPP_DISABLE_COPY(...)            \
  __VA_ARGS__(const __VA_ARGS__&) = delete; \
  __VA_ARGS__& operator=(const __VA_ARGS__&) = delete;

#define GAZELLE_RCLCPP_SHARED_ALIASES(...)        \
  using SharedPtr = std::shared_ptr<__VA_ARGS__>; \
  using ConstSharedPtr = std::shared_ptr<const __VA_ARGS__>;
#define GAZELLE_RCLCPP_WEAK_ALIASES(...)      \
  using WeakPtr = std::weak_ptr<__VA_ARGS__>; \
  using ConstWeakPtr = std::weak_ptr<const __VA_ARGS__>;
#define GAZELLE_RCLCPP_UNIQUE_ALIASES(...) using UniquePtr = std::unique_ptr<__VA_ARGS__>;
#define GAZELLE_RCLCPP_MAKE_SHARED(...)                                     \
  template <typename... Args>                                               \
  static std::shared_ptr<__VA_ARGS__> make_shared(Args&&... arguments) {    \
    return std::make_shared<__VA_ARGS__>(std::forward<Args>(arguments)...); \
  }
#define GAZELLE_RCLCPP_MAKE_UNIQUE(...)                                     \
  template <typename... Args>                                               \
  static std::unique_ptr<__VA_ARGS__> make_unique(Args&&... arguments) {    \
    return std::make_unique<__VA_ARGS__>(std::forward<Args>(arguments)...); \
  }

#define RCLCPP_SMART_PTR_DEFINITIONS(...)    \
  GAZELLE_RCLCPP_SHARED_ALIASES(__VA_ARGS__) \
  GAZELLE_RCLCPP_MAKE_SHARED(__VA_ARGS__)    \
  GAZELLE_RCLCPP_WEAK_ALIASES(__VA_ARGS__)   \
  GAZELLE_RCLCPP_UNIQUE_ALIASES(__VA_ARGS__) \
  GAZELLE_RCLCPP_MAKE_UNIQUE(__VA_ARGS__)

#define RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(...) \
  GAZELLE_RCLCPP_SHARED_ALIASES(__VA_ARGS__)           \
  GAZELLE_RCLCPP_MAKE_SHARED(__VA_ARGS__)              \
  GAZELLE_RCLCPP_WEAK_ALIASES(__VA_ARGS__)             \
  GAZELLE_RCLCPP_UNIQUE_ALIASES(__VA_ARGS__)

#define RCLCPP_SMART_PTR_ALIASES_ONLY(...)   \
  GAZELLE_RCLCPP_SHARED_ALIASES(__VA_ARGS__) \
  GAZELLE_RCLCPP_WEAK_ALIASES(__VA_ARGS__)   \
  GAZELLE_RCLCPP_MAKE_SHARED(__VA_ARGS__)

#define RCLCPP_SHARED_PTR_DEFINITIONS(...)   \
  GAZELLE_RCLCPP_SHARED_ALIASES(__VA_ARGS__) \
  GAZELLE_RCLCPP_MAKE_SHARED(__VA_ARGS__)

#define RCLCPP_WEAK_PTR_DEFINITIONS(...) GAZELLE_RCLCPP_WEAK_ALIASES(__VA_ARGS__)

#define RCLCPP_UNIQUE_PTR_DEFINITIONS(...)   \
  GAZELLE_RCLCPP_UNIQUE_ALIASES(__VA_ARGS__) \
  GAZELLE_RCLCPP_MAKE_UNIQUE(__VA_ARGS__)

#define RCLCPP_STRING_JOIN(first, second) first##second
#define RCLCPP_UNUSED(...) static_cast<void>(sizeof(__VA_ARGS__))
