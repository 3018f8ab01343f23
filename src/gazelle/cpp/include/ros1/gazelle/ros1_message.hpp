// What every generated header of ROS 1 needs.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <boost/array.hpp>
#include <boost/shared_ptr.hpp>

#include <ros/builtin_message_traits.h>
#include <ros/message_operations.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>
#include <ros/time.h>
#include <ros/types.h>

#include <gazelle/message.hpp>

namespace gazelle {
namespace ros1 {

template <class Allocator>
using String =
    std::basic_string<char, std::char_traits<char>,
                      typename std::allocator_traits<Allocator>::template rebind_alloc<char>>;

template <class T, class Allocator>
using Vector = std::vector<T, typename std::allocator_traits<Allocator>::template rebind_alloc<T>>;

}  // namespace ros1
}  // namespace gazelle
