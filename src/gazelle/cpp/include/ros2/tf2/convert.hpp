// Conversions between message types and others, as packages specialise and overload them.
#pragma once

#include <algorithm>
#include <array>
#include <string>

#include "builtin_interfaces/msg/time.hpp"
#include "geometry_msgs/msg/transform_stamped.hpp"
#include "rosidl_runtime_cpp/traits.hpp"
#include "tf2/exceptions.h"
#include "tf2/time.hpp"
#include "tf2/transform_datatypes.hpp"

namespace tf2 {

template <class T>
void doTransform(const T& data_in, T& data_out,
                 const geometry_msgs::msg::TransformStamped& transform);
template <class T>
TimePoint getTimestamp(const T& t);
template <class T>
std::string getFrameId(const T& t);
template <class T>
std::array<std::array<double, 6>, 6> getCovarianceMatrix(const T& t);

template <class P>
TimePoint getTimestamp(const Stamped<P>& t) {
  return t.stamp_;
}
template <class P>
std::string getFrameId(const Stamped<P>& t) {
  return t.frame_id_;
}
template <class P>
TimePoint getTimestamp(const WithCovarianceStamped<P>& t) {
  return t.stamp_;
}
template <class P>
std::string getFrameId(const WithCovarianceStamped<P>& t) {
  return t.frame_id_;
}
template <class P>
std::array<std::array<double, 6>, 6> getCovarianceMatrix(const WithCovarianceStamped<P>& t) {
  return t.cov_mat_;
}

template <typename A, typename B>
B toMsg(const A& a);
template <typename A, typename B>
void fromMsg(const A& a, B& b);

// A message becomes something else, something else a message, or one thing another by way of the
// message that both know. toMsg and fromMsg are looked up in the arguments' namespaces.
template <class A, class B>
void convert(const A& a, B& b) {
  constexpr bool from_message = rosidl_generator_traits::is_message<A>::value;
  constexpr bool to_message = rosidl_generator_traits::is_message<B>::value;
  if constexpr (from_message) {
    fromMsg(a, b);
  } else if constexpr (to_message) {
    b = toMsg(a);
  } else {
    fromMsg(toMsg(a), b);
  }
}
template <class A>
void convert(const A& a1, A& a2) {
  if (&a1 != &a2) a2 = a1;
}

inline std::array<std::array<double, 6>, 6> covarianceRowMajorToNested(
    const std::array<double, 36>& row_major) {
  std::array<std::array<double, 6>, 6> nested{};
  for (std::size_t i = 0; i < 36; ++i) nested[i / 6][i % 6] = row_major[i];
  return nested;
}
inline std::array<double, 36> covarianceNestedToRowMajor(
    const std::array<std::array<double, 6>, 6>& nested) {
  std::array<double, 36> row_major{};
  for (std::size_t i = 0; i < 36; ++i) row_major[i] = nested[i / 6][i % 6];
  return row_major;
}

}  // namespace tf2
