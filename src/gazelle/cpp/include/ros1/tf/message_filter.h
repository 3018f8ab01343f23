// Holds messages back until tf knows where they were taken.
#pragma once

#include <string>

#include "message_filters/simple_filter.h"
#include "ros/node_handle.h"
#include "tf/tf.h"
#include "tf2_ros/message_filter.h"

namespace tf {

namespace filter_failure_reasons {
enum FilterFailureReason { Unknown, OutTheBack, EmptyFrameID };
}  // namespace filter_failure_reasons
using FilterFailureReason = filter_failure_reasons::FilterFailureReason;

class MessageFilterBase {
 public:
  virtual ~MessageFilterBase() = default;
  virtual void clear() = 0;
  virtual void setTargetFrame(const std::string& target_frame) = 0;
  virtual void setTargetFrames(const std::vector<std::string>& target_frames) = 0;
  virtual void setTolerance(const ros::Duration& tolerance) = 0;
  virtual void setQueueSize(uint32_t new_queue_size) = 0;
  virtual uint32_t getQueueSize() = 0;
};

// tf2's filter over the transformer's buffer.
template <class M>
class MessageFilter : public MessageFilterBase, public message_filters::SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> MEvent;
  typedef boost::function<void(const MConstPtr&, FilterFailureReason)> FailureCallback;

  MessageFilter(Transformer& tf, const std::string& target_frame, uint32_t queue_size,
                ros::NodeHandle nh = ros::NodeHandle(),
                ros::Duration max_rate = ros::Duration(0.01))
      : buffer_(tf.getTF2BufferPtr()),
        filter_(*buffer_, strip_leading_slash(target_frame), queue_size, nh) {
    static_cast<void>(max_rate);  // answers come with transforms, not at a rate
    filter_.registerCallback(&MessageFilter::ready, this);
  }
  template <class F>
  MessageFilter(F& f, Transformer& tf, const std::string& target_frame, uint32_t queue_size,
                ros::NodeHandle nh = ros::NodeHandle(),
                ros::Duration max_rate = ros::Duration(0.01))
      : MessageFilter(tf, target_frame, queue_size, nh, max_rate) {
    connectInput(f);
  }

  template <class F>
  void connectInput(F& f) {
    filter_.connectInput(f);
  }
  void setTargetFrame(const std::string& target_frame) override {
    filter_.setTargetFrame(target_frame);
  }
  void setTargetFrames(const std::vector<std::string>& target_frames) override {
    filter_.setTargetFrames(target_frames);
  }
  std::string getTargetFramesString() { return filter_.getTargetFramesString(); }
  void setTolerance(const ros::Duration& tolerance) override { filter_.setTolerance(tolerance); }
  void clear() override { filter_.clear(); }
  void add(const MEvent& event) { filter_.add(event); }
  void add(const MConstPtr& message) { filter_.add(message); }
  void setQueueSize(uint32_t new_queue_size) override { filter_.setQueueSize(new_queue_size); }
  uint32_t getQueueSize() override { return filter_.getQueueSize(); }
  message_filters::Connection registerFailureCallback(const FailureCallback& callback) {
    return filter_.registerFailureCallback(
        [callback](const MConstPtr& message, tf2_ros::FilterFailureReason reason) {
          callback(message, static_cast<FilterFailureReason>(reason));
        });
  }

 private:
  void ready(const MEvent& event) { this->signalMessage(event); }

  std::shared_ptr<tf2_ros::Buffer> buffer_;
  tf2_ros::MessageFilter<M> filter_;
};

}  // namespace tf
