// What every generated header of ROS 2 needs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <rosidl_runtime_cpp/bounded_vector.hpp>
#include <rosidl_runtime_cpp/message_initialization.hpp>
#include <rosidl_runtime_cpp/traits.hpp>

#include <gazelle/message.hpp>

// The names that a message's class has for pointers to itself.
#define GAZELLE_ROS2_POINTERS(Name)                                       \
  using RawPtr = Name*;                                                   \
  using ConstRawPtr = const Name*;                                        \
  using SharedPtr = std::shared_ptr<Name>;                                \
  using ConstSharedPtr = std::shared_ptr<const Name>;                     \
  template <typename Deleter = std::default_delete<Name>>                 \
  using UniquePtrWithDeleter = std::unique_ptr<Name, Deleter>;            \
  using UniquePtr = UniquePtrWithDeleter<>;                               \
  template <typename Deleter = std::default_delete<Name>>                 \
  using ConstUniquePtrWithDeleter = std::unique_ptr<const Name, Deleter>; \
  using ConstUniquePtr = ConstUniquePtrWithDeleter<>;                     \
  using WeakPtr = std::weak_ptr<Name>;                                    \
  using ConstWeakPtr = std::weak_ptr<const Name>;                         \
  using Ptr = SharedPtr;                                                  \
  using ConstPtr = ConstSharedPtr;
