// Holds messages back until tf knows where they were taken.
#pragma once

#include <algorithm>
#include <atomic>
#include <boost/bind/bind.hpp>
#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "message_filters/connection.h"
#include "message_filters/simple_filter.h"
#include "ros/callback_queue_interface.h"
#include "ros/message_event.h"
#include "ros/message_traits.h"
#include "ros/node_handle.h"
#include "tf2/buffer_core.h"

namespace tf2_ros {

namespace filter_failure_reasons {
enum FilterFailureReason {
  Unknown,
  OutTheBack,    // older than all that tf keeps
  EmptyFrameID,  // the message names no frame
};
}  // namespace filter_failure_reasons
using FilterFailureReason = filter_failure_reasons::FilterFailureReason;

class MessageFilterBase {
 public:
  typedef std::vector<std::string> V_string;

  virtual ~MessageFilterBase() = default;
  virtual void clear() = 0;
  virtual void setTargetFrame(const std::string& target_frame) = 0;
  virtual void setTargetFrames(const V_string& target_frames) = 0;
  virtual void setTolerance(const ros::Duration& tolerance) = 0;
};

template <class M>
class MessageFilter : public MessageFilterBase, public message_filters::SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> MEvent;
  typedef boost::function<void(const MConstPtr&, FilterFailureReason)> FailureCallback;

  // A queue size of 0 keeps any number. Callbacks run in the queue, or at once where it is null.
  MessageFilter(tf2::BufferCore& bc, const std::string& target_frame, uint32_t queue_size,
                const ros::NodeHandle& nh)
      : MessageFilter(bc, target_frame, queue_size, nh.getCallbackQueue()) {}
  template <class F>
  MessageFilter(F& f, tf2::BufferCore& bc, const std::string& target_frame, uint32_t queue_size,
                const ros::NodeHandle& nh)
      : MessageFilter(f, bc, target_frame, queue_size, nh.getCallbackQueue()) {}
  MessageFilter(tf2::BufferCore& bc, const std::string& target_frame, uint32_t queue_size,
                ros::CallbackQueueInterface* cbqueue)
      : buffer_(bc), queue_size_(queue_size), queue_(cbqueue) {
    ask();
    setTargetFrame(target_frame);
  }
  template <class F>
  MessageFilter(F& f, tf2::BufferCore& bc, const std::string& target_frame, uint32_t queue_size,
                ros::CallbackQueueInterface* cbqueue)
      : MessageFilter(bc, target_frame, queue_size, cbqueue) {
    connectInput(f);
  }
  ~MessageFilter() override {
    input_.disconnect();
    forget();
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
  void setTolerance(const ros::Duration& tolerance) override {
    std::lock_guard<std::mutex> hold(lock_);
    tolerance_ = tolerance;
  }
  void clear() override {
    forget();
    ask();
  }
  virtual void setQueueSize(uint32_t new_queue_size) { queue_size_ = new_queue_size; }
  virtual uint32_t getQueueSize() { return queue_size_; }

  void add(const MEvent& event) {
    namespace mt = ros::message_traits;
    const MConstPtr& message = event.getConstMessage();
    auto waits = std::make_shared<Waiting>();
    waits->event = event;
    waits->frame = without_slash(mt::FrameId<M>::value(*message));
    waits->stamp = mt::TimeStamp<M>::value(*message);
    V_string frames;
    ros::Duration tolerance;
    {
      std::lock_guard<std::mutex> hold(lock_);
      frames = frames_;
      tolerance = tolerance_;
    }
    if (frames.empty()) return;
    if (waits->frame.empty()) {
      give_up(event, filter_failure_reasons::EmptyFrameID);
      return;
    }
    std::vector<ros::Time> stamps{waits->stamp};
    if (!tolerance.isZero()) stamps.push_back(waits->stamp + tolerance);
    MEvent oldest;
    bool is_full = false;
    {
      std::lock_guard<std::mutex> hold(lock_);
      // First in the list, as the buffer may answer before its number is known here.
      waits->left = frames.size() * stamps.size();
      waiting_.push_back(waits);
    }
    for (const std::string& target : frames) {
      for (const ros::Time& stamp : stamps) {
        const tf2::TransformableRequestHandle handle =
            buffer_.addTransformableRequest(handle_, target, waits->frame, stamp);
        if (handle == gazelle::FrameTree::never) {
          if (take_out(waits)) give_up(event, filter_failure_reasons::OutTheBack);
          return;
        }
        if (handle == 0) {
          arrived(waits, true);
          continue;
        }
        bool came_before = false, is_available = false;
        {
          std::lock_guard<std::mutex> hold(lock_);
          const auto early = std::find_if(early_.begin(), early_.end(),
                                          [&](const auto& one) { return one.first == handle; });
          came_before = early != early_.end();
          if (came_before) {
            is_available = early->second;
            early_.erase(early);
          } else {
            waits->handles.push_back(handle);
          }
        }
        if (came_before) arrived(waits, is_available);
      }
    }
    {
      std::lock_guard<std::mutex> hold(lock_);
      is_full = queue_size_ != 0 && waiting_.size() > queue_size_;
      if (is_full) {
        oldest = waiting_.front()->event;
        for (const auto one : waiting_.front()->handles) buffer_.cancelTransformableRequest(one);
        waiting_.pop_front();
      }
    }
    if (is_full) give_up(oldest, filter_failure_reasons::Unknown);
  }
  void add(const MConstPtr& message) {
    boost::shared_ptr<std::map<std::string, std::string>> header(
        new std::map<std::string, std::string>);
    (*header)["callerid"] = "unknown";
    const ros::WallTime now = ros::WallTime::now();
    add(MEvent(message, header, ros::Time(now.sec, now.nsec)));
  }

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
    std::string frame;
    ros::Time stamp;
    std::vector<tf2::TransformableRequestHandle> handles;
    std::size_t left = 0;
  };

  struct Call : ros::CallbackInterface {
    explicit Call(boost::function<void()> does) : function(std::move(does)) {}
    CallResult call() override {
      function();
      return Success;
    }
    boost::function<void()> function;
  };

  static std::string without_slash(const std::string& frame) {
    return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
  }

  void ask() {
    handle_ = buffer_.addTransformableCallback([this](tf2::TransformableRequestHandle request,
                                                      const std::string&, const std::string&,
                                                      ros::Time, tf2::TransformableResult result) {
      std::shared_ptr<Waiting> found;
      const bool is_available = result == tf2::TransformAvailable;
      {
        std::lock_guard<std::mutex> hold(lock_);
        for (const auto& one : waiting_) {
          if (std::find(one->handles.begin(), one->handles.end(), request) != one->handles.end())
            found = one;
        }
        if (!found) {
          early_.emplace_back(request, is_available);
          if (early_.size() > 100) early_.pop_front();
        }
      }
      if (found) arrived(found, is_available);
    });
  }

  void forget() {
    buffer_.removeTransformableCallback(handle_);
    std::lock_guard<std::mutex> hold(lock_);
    for (const auto& one : waiting_) {
      for (const auto handle : one->handles) buffer_.cancelTransformableRequest(handle);
    }
    waiting_.clear();
    early_.clear();
    if (queue_ != nullptr) queue_->removeByID(reinterpret_cast<uint64_t>(this));
  }

  // False where it is not waiting any more.
  bool take_out(const std::shared_ptr<Waiting>& waits) {
    std::lock_guard<std::mutex> hold(lock_);
    const auto place = std::find(waiting_.begin(), waiting_.end(), waits);
    if (place == waiting_.end()) return false;
    waiting_.erase(place);
    return true;
  }

  void arrived(const std::shared_ptr<Waiting>& waits, bool is_available) {
    {
      std::lock_guard<std::mutex> hold(lock_);
      if (is_available && --waits->left > 0) return;
    }
    if (!take_out(waits)) return;
    if (!is_available) {
      give_up(waits->event, filter_failure_reasons::OutTheBack);
      return;
    }
    const MEvent event = waits->event;
    later([this, event] { this->signalMessage(event); });
  }

  void give_up(const MEvent& event, FilterFailureReason reason) {
    later([this, event, reason] {
      std::list<std::shared_ptr<FailureCallback>> told;
      {
        std::lock_guard<std::mutex> hold(lock_);
        told = failed_;
      }
      for (const auto& one : told) (*one)(event.getConstMessage(), reason);
    });
  }

  void later(boost::function<void()> does) {
    if (queue_ == nullptr) {
      does();
      return;
    }
    queue_->addCallback(ros::CallbackInterfacePtr(new Call(std::move(does))),
                        reinterpret_cast<uint64_t>(this));
  }

  void add_event(const MEvent& event) { add(event); }

  tf2::BufferCore& buffer_;
  std::atomic<uint32_t> queue_size_;
  ros::CallbackQueueInterface* queue_;
  tf2::TransformableCallbackHandle handle_ = 0;
  std::mutex lock_;
  V_string frames_;
  ros::Duration tolerance_;
  std::list<std::shared_ptr<Waiting>> waiting_;
  // Answers that came while their request was being made.
  std::list<std::pair<tf2::TransformableRequestHandle, bool>> early_;
  std::list<std::shared_ptr<FailureCallback>> failed_;
  message_filters::Connection input_;
};

}  // namespace tf2_ros
