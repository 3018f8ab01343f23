// Holds messages back until tf knows where they were taken.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "message_filters/connection.hpp"
#include "message_filters/message_traits.hpp"
#include "message_filters/simple_filter.hpp"
#include "rclcpp/rclcpp.hpp"
#include "tf2/buffer_core_interface.hpp"
#include "tf2/time.hpp"
#include "tf2_ros/async_buffer_interface.hpp"
#include "tf2_ros/buffer.hpp"
#include "tf2_ros/visibility_control.h"

namespace tf2_ros {

namespace filter_failure_reasons {
enum FilterFailureReason {
  Unknown,
  OutTheBack,        // older than all that tf keeps
  EmptyFrameID,      // the message names no frame
  NoTransformFound,  // the transform did not come in time
  QueueFull,         // newer messages took its place
  FilterFailureReasonCount,
};
}  // namespace filter_failure_reasons
using FilterFailureReason = filter_failure_reasons::FilterFailureReason;

inline std::string get_filter_failure_reason_string(FilterFailureReason reason) {
  switch (reason) {
    case filter_failure_reasons::OutTheBack:
      return "the timestamp on the message is earlier than all the data in the transform cache";
    case filter_failure_reasons::EmptyFrameID:
      return "the frame id of the message is empty";
    case filter_failure_reasons::NoTransformFound:
      return "did not find a valid transform, this usually happens at startup ...";
    case filter_failure_reasons::QueueFull:
      return "discarding message because the queue is full";
    default:
      return "unknown";
  }
}

class MessageFilterBase {
 public:
  typedef std::vector<std::string> V_string;

  virtual ~MessageFilterBase() = default;
  virtual void clear() = 0;
  virtual void setTargetFrame(const std::string& target_frame) = 0;
  virtual void setTargetFrames(const V_string& target_frames) = 0;
  virtual void setTolerance(const rclcpp::Duration& tolerance) = 0;
};

template <class M, class BufferT = tf2_ros::Buffer>
class MessageFilter : public MessageFilterBase, public message_filters::SimpleFilter<M> {
 public:
  using MConstPtr = std::shared_ptr<M const>;
  using MEvent = message_filters::MessageEvent<M const>;
  using FailureCallback = std::function<void(const MConstPtr&, FilterFailureReason)>;
  using Logging = rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr;
  using Clock = rclcpp::node_interfaces::NodeClockInterface::SharedPtr;

  // A queue size of 0 keeps any number.
  template <typename TimeRepT = int64_t, typename TimeT = std::nano>
  MessageFilter(BufferT& buffer, const std::string& target_frame, uint32_t queue_size,
                const rclcpp::Node::SharedPtr& node,
                std::chrono::duration<TimeRepT, TimeT> buffer_timeout =
                    std::chrono::duration<TimeRepT, TimeT>::max())
      : MessageFilter(buffer, target_frame, queue_size, node->get_node_logging_interface(),
                      node->get_node_clock_interface(), buffer_timeout) {}
  template <typename TimeRepT = int64_t, typename TimeT = std::nano>
  MessageFilter(BufferT& buffer, const std::string& target_frame, uint32_t queue_size,
                const Logging& node_logging, const Clock& node_clock,
                std::chrono::duration<TimeRepT, TimeT> buffer_timeout =
                    std::chrono::duration<TimeRepT, TimeT>::max())
      : logging_(node_logging),
        clock_(node_clock),
        buffer_(buffer),
        queue_size_(queue_size),
        timeout_(in_nanoseconds(buffer_timeout)),
        alive_(std::make_shared<Alive>()) {
    static_assert(std::is_base_of<tf2::BufferCoreInterface, BufferT>::value,
                  "Buffer type must implement tf2::BufferCoreInterface");
    static_assert(std::is_base_of<tf2_ros::AsyncBufferInterface, BufferT>::value,
                  "Buffer type must implement tf2_ros::AsyncBufferInterface");
    setTargetFrame(target_frame);
  }
  template <class F, typename TimeRepT = int64_t, typename TimeT = std::nano>
  MessageFilter(F& f, BufferT& buffer, const std::string& target_frame, uint32_t queue_size,
                const rclcpp::Node::SharedPtr& node,
                std::chrono::duration<TimeRepT, TimeT> buffer_timeout =
                    std::chrono::duration<TimeRepT, TimeT>::max())
      : MessageFilter(buffer, target_frame, queue_size, node, buffer_timeout) {
    connectInput(f);
  }
  template <class F, typename TimeRepT = int64_t, typename TimeT = std::nano>
  MessageFilter(F& f, BufferT& buffer, const std::string& target_frame, uint32_t queue_size,
                const Logging& node_logging, const Clock& node_clock,
                std::chrono::duration<TimeRepT, TimeT> buffer_timeout =
                    std::chrono::duration<TimeRepT, TimeT>::max())
      : MessageFilter(buffer, target_frame, queue_size, node_logging, node_clock, buffer_timeout) {
    connectInput(f);
  }
  ~MessageFilter() override {
    input_.disconnect();
    clear();
    // Waits for an answer that is under way; later ones find nobody.
    std::lock_guard<std::recursive_mutex> hold(alive_->lock);
    alive_->is_alive = false;
  }
  MessageFilter(const MessageFilter&) = delete;
  MessageFilter& operator=(const MessageFilter&) = delete;

  template <class F>
  void connectInput(F& f) {
    input_.disconnect();
    input_ = f.registerCallback(&MessageFilter::add_event, this);
  }

  void setTargetFrame(const std::string& target_frame) override {
    setTargetFrames(V_string{target_frame});
  }
  void setTargetFrames(const V_string& target_frames) override {
    std::lock_guard<std::mutex> hold(lock_);
    frames_.clear();
    for (const std::string& one : target_frames) frames_.push_back(without_slash(one));
  }
  std::string getTargetFramesString() {
    std::lock_guard<std::mutex> hold(lock_);
    std::string out;
    for (const std::string& one : frames_) out += one + " ";
    return out;
  }
  // Transforms are wanted for the stamp and for so much later, too.
  void setTolerance(const rclcpp::Duration& tolerance) override {
    std::lock_guard<std::mutex> hold(lock_);
    tolerance_ = tolerance;
  }
  void clear() override {
    std::list<std::shared_ptr<Waiting>> given_up;
    {
      std::lock_guard<std::mutex> hold(lock_);
      given_up.swap(waiting_);
    }
    for (const auto& one : given_up) cancel(*one);
  }
  virtual void setQueueSize(uint32_t new_queue_size) { queue_size_ = new_queue_size; }
  virtual uint32_t getQueueSize() { return queue_size_; }

  void add(const MEvent& event) {
    namespace mt = message_filters::message_traits;
    const MConstPtr& message = event.getMessage();
    auto waits = std::make_shared<Waiting>();
    waits->event = event;
    const std::string frame = without_slash(mt::FrameId<M>::value(*message));
    const rclcpp::Time stamp = mt::TimeStamp<M>::value(*message);
    V_string frames;
    rclcpp::Duration tolerance(0, 0);
    {
      std::lock_guard<std::mutex> hold(lock_);
      frames = frames_;
      tolerance = tolerance_;
    }
    if (frames.empty()) return;
    if (frame.empty()) {
      give_up(event, filter_failure_reasons::EmptyFrameID);
      return;
    }
    std::vector<rclcpp::Time> stamps{stamp};
    if (tolerance.nanoseconds() != 0) stamps.push_back(stamp + tolerance);
    waits->left = frames.size() * stamps.size();
    std::shared_ptr<Waiting> oldest;
    {
      std::lock_guard<std::mutex> hold(lock_);
      if (queue_size_ != 0 && waiting_.size() + 1 > queue_size_) {
        oldest = waiting_.front();
        waiting_.pop_front();
      }
      waiting_.push_back(waits);
    }
    if (oldest) {
      cancel(*oldest);
      give_up(oldest->event, filter_failure_reasons::QueueFull);
    }
    for (const std::string& target : frames) {
      for (const rclcpp::Time& one : stamps) {
        const auto alive = alive_;
        TransformStampedFuture future =
            buffer_.waitForTransform(target, frame, fromRclcpp(one), timeout_,
                                     [this, alive, waits](const TransformStampedFuture& answer) {
                                       std::lock_guard<std::recursive_mutex> hold(alive->lock);
                                       if (alive->is_alive) arrived(waits, answer);
                                     });
        const auto handle = future.getHandle();
        if (handle == 0 || handle == gazelle::FrameTree::never) continue;
        std::lock_guard<std::mutex> hold(lock_);
        waits->futures.push_back(std::move(future));
      }
    }
  }
  void add(const MConstPtr& message) { add(MEvent(message, clock_->get_clock()->now())); }

  message_filters::Connection registerFailureCallback(const FailureCallback& callback) {
    std::lock_guard<std::mutex> hold(lock_);
    auto told = std::make_shared<FailureCallback>(callback);
    failed_.push_back(told);
    return message_filters::Connection([this, told] {
      std::lock_guard<std::mutex> held(lock_);
      failed_.remove(told);
    });
  }

 private:
  struct Waiting {
    MEvent event;
    std::list<TransformStampedFuture> futures;
    std::size_t left = 0;
  };
  struct Alive {
    std::recursive_mutex lock;
    bool is_alive = true;
  };

  template <class Length>
  static tf2::Duration in_nanoseconds(Length length) {
    using Longest = std::chrono::duration<double>;
    if (Longest(length) > Longest(tf2::Duration::max())) return tf2::Duration::max();
    return std::chrono::duration_cast<tf2::Duration>(length);
  }
  static std::string without_slash(const std::string& frame) {
    return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
  }

  void add_event(const MEvent& event) { add(event); }

  void cancel(Waiting& waits) {
    std::list<TransformStampedFuture> futures;
    {
      std::lock_guard<std::mutex> hold(lock_);
      futures.swap(waits.futures);
    }
    for (const auto& one : futures) buffer_.cancel(one);
  }

  void arrived(const std::shared_ptr<Waiting>& waits, const TransformStampedFuture& answer) {
    FilterFailureReason reason = filter_failure_reasons::Unknown;
    bool is_available = true;
    try {
      answer.get();
    } catch (const tf2::TimeoutException&) {
      is_available = false;
      reason = filter_failure_reasons::NoTransformFound;
    } catch (const std::exception&) {
      is_available = false;
      reason = filter_failure_reasons::OutTheBack;
    }
    {
      std::lock_guard<std::mutex> hold(lock_);
      const auto place = std::find(waiting_.begin(), waiting_.end(), waits);
      if (place == waiting_.end()) return;
      if (is_available && --waits->left > 0) return;
      waiting_.erase(place);
    }
    if (is_available) {
      this->signalMessage(waits->event);
    } else {
      cancel(*waits);
      give_up(waits->event, reason);
    }
  }

  void give_up(const MEvent& event, FilterFailureReason reason) {
    namespace mt = message_filters::message_traits;
    const MConstPtr& message = event.getMessage();
    const rclcpp::Time stamp = mt::TimeStamp<M>::value(*message);
    RCLCPP_INFO(logging_->get_logger(),
                "Message Filter dropping message: frame '%s' at time %.3f for reason '%s'",
                without_slash(mt::FrameId<M>::value(*message)).c_str(), stamp.seconds(),
                get_filter_failure_reason_string(reason).c_str());
    std::list<std::shared_ptr<FailureCallback>> told;
    {
      std::lock_guard<std::mutex> hold(lock_);
      told = failed_;
    }
    for (const auto& one : told) (*one)(message, reason);
  }

  const Logging logging_;
  const Clock clock_;
  BufferT& buffer_;
  std::atomic<uint32_t> queue_size_;
  const tf2::Duration timeout_;
  std::shared_ptr<Alive> alive_;
  std::mutex lock_;
  V_string frames_;
  rclcpp::Duration tolerance_{0, 0};
  std::list<std::shared_ptr<Waiting>> waiting_;
  std::list<std::shared_ptr<FailureCallback>> failed_;
  message_filters::Connection input_;
};

}  // namespace tf2_ros
