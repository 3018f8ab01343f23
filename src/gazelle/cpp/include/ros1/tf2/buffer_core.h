// The buffer of transforms, with ROS 1's times and messages around gazelle::FrameTree.
#pragma once

#include <boost/function.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "gazelle/frame_tree.hpp"
#include "geometry_msgs/TransformStamped.h"
#include "ros/duration.h"
#include "ros/time.h"
#include "tf2/exceptions.h"
#include "tf2/transform_storage.h"

namespace tf2 {

using P_TimeAndFrameID = std::pair<ros::Time, CompactFrameID>;
using TransformableCallbackHandle = std::uint32_t;
using TransformableRequestHandle = std::uint64_t;

enum TransformableResult { TransformAvailable, TransformFailure };

// Ends the listening of who was told of new transforms.
class ChangeConnection {
 public:
  ChangeConnection() = default;
  explicit ChangeConnection(std::uint64_t number) : number_(number) {}
  std::uint64_t number() const { return number_; }
  bool connected() const { return number_ != 0; }

 private:
  std::uint64_t number_ = 0;
};

class BufferCore {
 public:
  static const int DEFAULT_CACHE_TIME = 10;  // seconds
  static const uint32_t MAX_GRAPH_DEPTH = 1000UL;

  explicit BufferCore(ros::Duration cache_time = ros::Duration(DEFAULT_CACHE_TIME))
      : cache_time_(cache_time), tree_(cache_time.toNSec()) {}
  virtual ~BufferCore() = default;
  BufferCore(const BufferCore&) = delete;
  BufferCore& operator=(const BufferCore&) = delete;

  void clear() { tree_.clear(); }
  bool setTransform(const geometry_msgs::TransformStamped& transform, const std::string& authority,
                    bool is_static = false);

  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame,
                                                  const std::string& source_frame,
                                                  const ros::Time& time) const;
  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame,
                                                  const ros::Time& target_time,
                                                  const std::string& source_frame,
                                                  const ros::Time& source_time,
                                                  const std::string& fixed_frame) const;
  bool canTransform(const std::string& target_frame, const std::string& source_frame,
                    const ros::Time& time, std::string* error_msg = nullptr) const;
  bool canTransform(const std::string& target_frame, const ros::Time& target_time,
                    const std::string& source_frame, const ros::Time& source_time,
                    const std::string& fixed_frame, std::string* error_msg = nullptr) const;

  std::string allFramesAsYAML(double current_time) const { return tree_.as_yaml(current_time); }
  std::string allFramesAsYAML() const { return tree_.as_yaml(0.0); }
  std::string allFramesAsString() const { return tree_.as_text(); }

  using TransformableCallback = boost::function<void(
      TransformableRequestHandle request_handle, const std::string& target_frame,
      const std::string& source_frame, ros::Time time, TransformableResult result)>;
  TransformableCallbackHandle addTransformableCallback(const TransformableCallback& cb);
  void removeTransformableCallback(TransformableCallbackHandle handle);
  TransformableRequestHandle addTransformableRequest(TransformableCallbackHandle handle,
                                                     const std::string& target_frame,
                                                     const std::string& source_frame,
                                                     ros::Time time);
  void cancelTransformableRequest(TransformableRequestHandle handle) { tree_.cancel(handle); }

  void setUsingDedicatedThread(bool value) { using_dedicated_thread_ = value; }
  bool isUsingDedicatedThread() const { return using_dedicated_thread_; }

  ChangeConnection _addTransformsChangedListener(boost::function<void(void)> callback) {
    return ChangeConnection(tree_.add_listener([callback] { callback(); }));
  }
  void _removeTransformsChangedListener(ChangeConnection c) { tree_.remove_listener(c.number()); }
  bool _frameExists(const std::string& frame_id) const { return tree_.exists(frame_id); }
  bool _getParent(const std::string& frame_id, ros::Time time, std::string& parent) const;
  void _getFrameStrings(std::vector<std::string>& ids) const { ids = tree_.names(); }
  CompactFrameID _lookupFrameNumber(const std::string& frame_id) const {
    return tree_.number(frame_id);
  }
  CompactFrameID _lookupOrInsertFrameNumber(const std::string& frame_id) {
    return tree_.number_or_new(frame_id);
  }
  int _getLatestCommonTime(CompactFrameID target_frame, CompactFrameID source_frame,
                           ros::Time& time, std::string* error_string) const;
  CompactFrameID _validateFrameId(const char* function_name_arg,
                                  const std::string& frame_id) const {
    return tree_.checked_number(function_name_arg, frame_id);
  }
  ros::Duration getCacheLength() { return cache_time_; }
  std::string _allFramesAsDot(double current_time) const { return tree_.as_dot(current_time); }
  std::string _allFramesAsDot() const { return tree_.as_dot(0.0); }
  void _chainAsVector(const std::string& target_frame, ros::Time target_time,
                      const std::string& source_frame, ros::Time source_time,
                      const std::string& fixed_frame, std::vector<std::string>& output) const;

  // Of ours: what waits for transforms waits on it.
  const gazelle::FrameTree& gazelle_tree() const { return tree_; }

 private:
  // A function that is told of transforms. Removing it waits for a call that is under way, so
  // that whoever gave it can go afterwards; within the call itself it may be removed, too.
  struct Told {
    std::recursive_mutex lock;
    TransformableCallback function;
  };

  ros::Duration cache_time_;
  std::mutex told_lock_;
  std::map<TransformableCallbackHandle, std::shared_ptr<Told>> told_;
  TransformableCallbackHandle last_told_ = 0;
  gazelle::FrameTree tree_;
  bool using_dedicated_thread_ = false;
};

namespace impl {

inline std::int64_t nanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.toNSec());
}
inline ros::Time time_of(std::int64_t stamp_ns) {
  ros::Time out;
  return out.fromNSec(static_cast<std::uint64_t>(stamp_ns));
}
inline geometry_msgs::TransformStamped message_of(const gazelle::FoundTransform& found,
                                                  const std::string& target,
                                                  const std::string& source) {
  geometry_msgs::TransformStamped out;
  out.header.stamp = time_of(found.stamp_ns);
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

}  // namespace impl

inline bool BufferCore::setTransform(const geometry_msgs::TransformStamped& transform,
                                     const std::string& authority, bool is_static) {
  const auto& t = transform.transform.translation;
  const auto& q = transform.transform.rotation;
  return tree_.set(transform.header.frame_id, transform.child_frame_id,
                   impl::nanoseconds(transform.header.stamp), Vector3(t.x, t.y, t.z),
                   Quaternion(q.x, q.y, q.z, q.w), authority, is_static);
}

inline geometry_msgs::TransformStamped BufferCore::lookupTransform(const std::string& target_frame,
                                                                   const std::string& source_frame,
                                                                   const ros::Time& time) const {
  return impl::message_of(tree_.look_up(target_frame, source_frame, impl::nanoseconds(time)),
                          target_frame, source_frame);
}
inline geometry_msgs::TransformStamped BufferCore::lookupTransform(
    const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
    const ros::Time& source_time, const std::string& fixed_frame) const {
  return impl::message_of(tree_.look_up(target_frame, impl::nanoseconds(target_time), source_frame,
                                        impl::nanoseconds(source_time), fixed_frame),
                          target_frame, source_frame);
}
inline bool BufferCore::canTransform(const std::string& target_frame,
                                     const std::string& source_frame, const ros::Time& time,
                                     std::string* error_msg) const {
  return tree_.can(target_frame, source_frame, impl::nanoseconds(time), error_msg);
}
inline bool BufferCore::canTransform(const std::string& target_frame, const ros::Time& target_time,
                                     const std::string& source_frame, const ros::Time& source_time,
                                     const std::string& fixed_frame, std::string* error_msg) const {
  return tree_.can(target_frame, impl::nanoseconds(target_time), source_frame,
                   impl::nanoseconds(source_time), fixed_frame, error_msg);
}

inline TransformableCallbackHandle BufferCore::addTransformableCallback(
    const TransformableCallback& cb) {
  std::lock_guard<std::mutex> hold(told_lock_);
  auto told = std::make_shared<Told>();
  told->function = cb;
  told_[++last_told_] = told;
  return last_told_;
}
inline void BufferCore::removeTransformableCallback(TransformableCallbackHandle handle) {
  std::shared_ptr<Told> told;
  {
    std::lock_guard<std::mutex> hold(told_lock_);
    const auto found = told_.find(handle);
    if (found == told_.end()) return;
    told = found->second;
    told_.erase(found);
  }
  // Requests that are left answer nobody.
  std::lock_guard<std::recursive_mutex> hold(told->lock);
  told->function.clear();
}
inline TransformableRequestHandle BufferCore::addTransformableRequest(
    TransformableCallbackHandle handle, const std::string& target_frame,
    const std::string& source_frame, ros::Time time) {
  std::shared_ptr<Told> told;
  {
    std::lock_guard<std::mutex> hold(told_lock_);
    const auto found = told_.find(handle);
    if (found == told_.end()) return gazelle::FrameTree::never;
    told = found->second;
  }
  const auto done = [told, target_frame, source_frame, time](TransformableRequestHandle request,
                                                             bool is_available) {
    std::lock_guard<std::recursive_mutex> hold(told->lock);
    if (!told->function) return;
    const TransformableCallback function = told->function;
    function(request, target_frame, source_frame, time,
             is_available ? TransformAvailable : TransformFailure);
  };
  return tree_.request(target_frame, source_frame, impl::nanoseconds(time), done);
}

inline bool BufferCore::_getParent(const std::string& frame_id, ros::Time time,
                                   std::string& parent) const {
  return tree_.parent(frame_id, impl::nanoseconds(time), parent);
}
inline int BufferCore::_getLatestCommonTime(CompactFrameID target_frame,
                                            CompactFrameID source_frame, ros::Time& time,
                                            std::string* error_string) const {
  std::int64_t stamp_ns = 0;
  const gazelle::FrameFault fault =
      tree_.latest_common_time(target_frame, source_frame, stamp_ns, error_string);
  time = impl::time_of(stamp_ns);
  if (fault == gazelle::FrameFault::connectivity)
    return static_cast<int>(TF2Error::TF2_CONNECTIVITY_ERROR);
  return static_cast<int>(fault == gazelle::FrameFault::none ? TF2Error::TF2_NO_ERROR
                                                             : TF2Error::TF2_LOOKUP_ERROR);
}
inline void BufferCore::_chainAsVector(const std::string& target_frame, ros::Time target_time,
                                       const std::string& source_frame, ros::Time source_time,
                                       const std::string& fixed_frame,
                                       std::vector<std::string>& output) const {
  output = tree_.chain(target_frame, impl::nanoseconds(target_time), source_frame,
                       impl::nanoseconds(source_time), fixed_frame);
}

}  // namespace tf2
