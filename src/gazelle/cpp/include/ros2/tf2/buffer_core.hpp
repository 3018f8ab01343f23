// The buffer of transforms, with ROS 2's times and messages around gazelle::FrameTree.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gazelle/frame_tree.hpp"
#include "geometry_msgs/msg/transform_stamped.hpp"
#include "geometry_msgs/msg/velocity_stamped.hpp"
#include "tf2/LinearMath/Transform.h"
#include "tf2/buffer_core_interface.hpp"
#include "tf2/exceptions.h"
#include "tf2/time.hpp"
#include "tf2/transform_storage.hpp"
#include "tf2/visibility_control.h"

namespace tf2 {

using P_TimeAndFrameID = std::pair<TimePoint, CompactFrameID>;
using TransformableRequestHandle = std::uint64_t;

enum TransformableResult { TransformAvailable, TransformFailure };

static constexpr Duration BUFFER_CORE_DEFAULT_CACHE_TIME = std::chrono::seconds(10);

class BufferCore : public BufferCoreInterface {
 public:
  static const std::uint32_t MAX_GRAPH_DEPTH = 1000UL;

  explicit BufferCore(Duration cache_time = BUFFER_CORE_DEFAULT_CACHE_TIME)
      : tree_(cache_time.count(), gazelle::FrameTree::Words::ros2) {}
  BufferCore(const BufferCore&) = delete;
  BufferCore& operator=(const BufferCore&) = delete;

  void clear() override { tree_.clear(); }
  bool setTransform(const geometry_msgs::msg::TransformStamped& transform,
                    const std::string& authority, bool is_static = false) {
    const auto& t = transform.transform.translation;
    const auto& q = transform.transform.rotation;
    const std::int64_t stamp_ns =
        std::int64_t{transform.header.stamp.sec} * 1000000000 + transform.header.stamp.nanosec;
    return tree_.set(transform.header.frame_id, transform.child_frame_id, stamp_ns,
                     Vector3(t.x, t.y, t.z), Quaternion(q.x, q.y, q.z, q.w), authority, is_static);
  }

  geometry_msgs::msg::TransformStamped lookupTransform(const std::string& target_frame,
                                                       const std::string& source_frame,
                                                       const TimePoint& time) const override {
    return message_of(tree_.look_up(target_frame, source_frame, ns(time)), target_frame,
                      source_frame);
  }
  geometry_msgs::msg::TransformStamped lookupTransform(
      const std::string& target_frame, const TimePoint& target_time,
      const std::string& source_frame, const TimePoint& source_time,
      const std::string& fixed_frame) const override {
    return message_of(
        tree_.look_up(target_frame, ns(target_time), source_frame, ns(source_time), fixed_frame),
        target_frame, source_frame);
  }
  // The velocity of one frame seen from another, over an interval about a time.
  geometry_msgs::msg::VelocityStamped lookupVelocity(const std::string& tracking_frame,
                                                     const std::string& observation_frame,
                                                     const TimePoint& time,
                                                     const Duration& averaging_interval) const {
    return lookupVelocity(tracking_frame, observation_frame, observation_frame,
                          Vector3(0.0, 0.0, 0.0), tracking_frame, time, averaging_interval);
  }
  geometry_msgs::msg::VelocityStamped lookupVelocity(const std::string& tracking_frame,
                                                     const std::string& observation_frame,
                                                     const std::string& reference_frame,
                                                     const Vector3& reference_point,
                                                     const std::string& reference_point_frame,
                                                     const TimePoint& time,
                                                     const Duration& duration) const;

  bool canTransform(const std::string& target_frame, const std::string& source_frame,
                    const TimePoint& time, std::string* error_msg = nullptr) const override {
    return tree_.can(target_frame, source_frame, ns(time), error_msg);
  }
  bool canTransform(const std::string& target_frame, const TimePoint& target_time,
                    const std::string& source_frame, const TimePoint& source_time,
                    const std::string& fixed_frame,
                    std::string* error_msg = nullptr) const override {
    return tree_.can(target_frame, ns(target_time), source_frame, ns(source_time), fixed_frame,
                     error_msg);
  }

  std::vector<std::string> getAllFrameNames() const override { return tree_.names(); }
  std::string allFramesAsYAML(TimePoint current_time) const {
    return tree_.as_yaml(timeToSec(current_time));
  }
  std::string allFramesAsYAML() const { return tree_.as_yaml(0.0); }
  std::string allFramesAsString() const { return tree_.as_text(); }

  using TransformableCallback = std::function<void(
      TransformableRequestHandle request_handle, const std::string& target_frame,
      const std::string& source_frame, TimePoint time, TransformableResult result)>;
  // 0: it is there already; 0xffffffffffffffff: it never will be.
  TransformableRequestHandle addTransformableRequest(const TransformableCallback& cb,
                                                     const std::string& target_frame,
                                                     const std::string& source_frame,
                                                     TimePoint time) {
    return tree_.request(target_frame, source_frame, ns(time),
                         [=](TransformableRequestHandle handle, bool is_available) {
                           cb(handle, target_frame, source_frame, time,
                              is_available ? TransformAvailable : TransformFailure);
                         });
  }
  void cancelTransformableRequest(TransformableRequestHandle handle) { tree_.cancel(handle); }

  void setUsingDedicatedThread(bool value) { using_dedicated_thread_ = value; }
  bool isUsingDedicatedThread() const { return using_dedicated_thread_; }

  bool _frameExists(const std::string& frame_id) const { return tree_.exists(frame_id); }
  bool _getParent(const std::string& frame_id, TimePoint time, std::string& parent) const {
    return tree_.parent(frame_id, ns(time), parent);
  }
  void _getFrameStrings(std::vector<std::string>& ids) const { ids = tree_.names(); }
  CompactFrameID _lookupFrameNumber(const std::string& frame_id) const {
    return tree_.number(frame_id);
  }
  CompactFrameID _lookupOrInsertFrameNumber(const std::string& frame_id) {
    return tree_.number_or_new(frame_id);
  }
  TF2Error _getLatestCommonTime(CompactFrameID target_frame, CompactFrameID source_frame,
                                TimePoint& time, std::string* error_string) const {
    std::int64_t stamp_ns = 0;
    const auto fault = tree_.latest_common_time(target_frame, source_frame, stamp_ns, error_string);
    time = TimePoint(Duration(stamp_ns));
    if (fault == gazelle::FrameFault::connectivity) return TF2Error::TF2_CONNECTIVITY_ERROR;
    return fault == gazelle::FrameFault::none ? TF2Error::TF2_NO_ERROR : TF2Error::TF2_LOOKUP_ERROR;
  }
  CompactFrameID _validateFrameId(const char* function_name_arg,
                                  const std::string& frame_id) const {
    return tree_.checked_number(function_name_arg, frame_id);
  }
  Duration getCacheLength() { return Duration(tree_.cache_ns()); }
  std::string _allFramesAsDot(TimePoint current_time) const {
    return tree_.as_dot(timeToSec(current_time));
  }
  std::string _allFramesAsDot() const { return tree_.as_dot(0.0); }
  void _chainAsVector(const std::string& target_frame, TimePoint target_time,
                      const std::string& source_frame, TimePoint source_time,
                      const std::string& fixed_frame, std::vector<std::string>& output) const {
    output = tree_.chain(target_frame, ns(target_time), source_frame, ns(source_time), fixed_frame);
  }

  // Of ours: what waits for transforms waits on it.
  const gazelle::FrameTree& gazelle_tree() const { return tree_; }
  gazelle::FrameTree& gazelle_tree() { return tree_; }

 private:
  static std::int64_t ns(const TimePoint& time) { return time.time_since_epoch().count(); }
  static geometry_msgs::msg::TransformStamped message_of(const gazelle::FoundTransform& found,
                                                         const std::string& target,
                                                         const std::string& source) {
    geometry_msgs::msg::TransformStamped out;
    out.header.stamp.sec = static_cast<std::int32_t>(found.stamp_ns / 1000000000);
    out.header.stamp.nanosec = static_cast<std::uint32_t>(found.stamp_ns % 1000000000);
    out.header.frame_id = target;
    out.child_frame_id = source;
    out.transform.translation.x = found.translation.x();
    out.transform.translation.y = found.translation.y();
    out.transform.translation.z = found.translation.z();
    out.transform.rotation.x = found.rotation.x();
    out.transform.rotation.y = found.rotation.y();
    out.transform.rotation.z = found.rotation.z();
    out.transform.rotation.w = found.rotation.w();
    return out;
  }

  gazelle::FrameTree tree_;
  bool using_dedicated_thread_ = false;
};

inline geometry_msgs::msg::VelocityStamped BufferCore::lookupVelocity(
    const std::string& tracking_frame, const std::string& observation_frame,
    const std::string& reference_frame, const Vector3& reference_point,
    const std::string& reference_point_frame, const TimePoint& time,
    const Duration& duration) const {
  const CompactFrameID tracked =
      tree_.checked_number("lookupTransform argument target_frame", tracking_frame);
  const CompactFrameID observer =
      tree_.checked_number("lookupTransform argument source_frame", observation_frame);
  std::int64_t latest = 0;
  std::string why;
  if (tree_.latest_common_time(observer, tracked, latest, &why) != gazelle::FrameFault::none)
    throw ConnectivityException(why);
  // The interval lies about the time, or before the latest where it would reach beyond.
  const std::int64_t half = duration.count() / 2, asked = ns(time);
  std::int64_t end = asked == 0 ? latest : asked + half;
  if (latest != 0 && end > latest) end = latest;
  const std::int64_t start = std::max<std::int64_t>(end - duration.count(), 0);
  const double length_s = static_cast<double>(end - start) / 1e9;
  if (length_s <= 0.0) throw ExtrapolationException("Velocity wants an interval of some length");
  const auto first = tree_.look_up(observation_frame, tracking_frame, start);
  const auto last = tree_.look_up(observation_frame, tracking_frame, end);
  Quaternion turned = last.rotation * first.rotation.inverse();
  if (turned.w() < 0) turned = -turned;
  Vector3 angular = turned.getAxis() * (turned.getAngle() / length_s);
  Vector3 linear = (last.translation - first.translation) / length_s;

  // To the reference's axes, and to the point that is asked about.
  const auto axes = tree_.look_up(reference_frame, observation_frame, asked);
  angular = quatRotate(axes.rotation, angular);
  linear = quatRotate(axes.rotation, linear);
  const auto to_point = tree_.look_up(reference_frame, reference_point_frame, asked);
  const auto to_tracked = tree_.look_up(reference_frame, tracking_frame, asked);
  const Vector3 lever = quatRotate(to_point.rotation, reference_point) + to_point.translation -
                        to_tracked.translation;
  linear += angular.cross(lever);

  geometry_msgs::msg::VelocityStamped out;
  const std::int64_t middle = start + (end - start) / 2;
  out.header.stamp.sec = static_cast<std::int32_t>(middle / 1000000000);
  out.header.stamp.nanosec = static_cast<std::uint32_t>(middle % 1000000000);
  out.header.frame_id = reference_frame;
  out.body_frame_id = tracking_frame;
  out.reference_frame_id = observation_frame;
  out.velocity.linear.x = linear.x();
  out.velocity.linear.y = linear.y();
  out.velocity.linear.z = linear.z();
  out.velocity.angular.x = angular.x();
  out.velocity.angular.y = angular.y();
  out.velocity.angular.z = angular.z();
  return out;
}

}  // namespace tf2
