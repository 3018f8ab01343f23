// Subscribers and the messages that wait for them.

#include <ros/console.h>
#include <ros/names.h>
#include <ros/subscriber.h>
#include <ros/this_node.h>

#include "ends.hpp"

namespace ros {

namespace detail {

VoidConstPtr objectOf(const gazelle::Delivered& delivered, const gazelle::MessageType& type,
                      bool wants_own, bool& own) {
  own = wants_own;
  if (wants_own) return gazelle::to_boost(delivered.own_object(type));
  return gazelle::to_boost(delivered.object(type));
}

}  // namespace detail

SubscriptionQueue::SubscriptionQueue(const SubscribeOptions& options)
    : queue(options.callback_queue),
      helper_(options.helper),
      topic_(options.topic),
      size_(options.queue_size),
      is_concurrent_(options.allow_concurrent_callbacks),
      is_tracked_(static_cast<bool>(options.tracked_object)),
      tracked_(options.tracked_object) {}

void SubscriptionQueue::push(gazelle::Delivered delivered) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_closed_) return;
    const bool is_full = size_ != 0 && waiting_.size() >= size_;
    if (is_full) {
      waiting_.pop_front();
      if (!was_full_)
        ROS_DEBUG(
            "Incoming queue was full for topic \"%s\". Discarded oldest message (current queue "
            "size [%zu])",
            topic_.c_str(), waiting_.size());
    }
    was_full_ = is_full;
    waiting_.push_back({std::move(delivered), Time::now()});
    if (is_full) return;  // the one that went leaves its place among the callbacks
  }
  queue->addCallback(shared_from_this(), owner);
}

void SubscriptionQueue::close() {
  std::deque<Waiting> dropped;
  const std::lock_guard<std::mutex> lock(mutex_);
  is_closed_ = true;
  dropped.swap(waiting_);
}

bool SubscriptionQueue::ready() { return is_concurrent_ || calling_.load() == 0; }

CallbackInterface::CallResult SubscriptionQueue::call() {
  if (calling_.fetch_add(1) != 0 && !is_concurrent_) {
    --calling_;
    return TryAgain;
  }
  struct Done {
    std::atomic<int>& calling;
    ~Done() { --calling; }
  } done{calling_};

  VoidConstPtr tracked;
  if (is_tracked_) {
    tracked = tracked_.lock();
    if (!tracked) return Invalid;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  if (is_closed_ || waiting_.empty()) return Invalid;
  const Waiting next = std::move(waiting_.front());
  waiting_.pop_front();
  lock.unlock();
  deliver(next);
  return Success;
}

void SubscriptionQueue::deliver(const Waiting& waiting) {
  SubscriptionCallbackHelperCallParams params;
  try {
    const boost::shared_ptr<M_string>& header = headerOf(waiting.delivered);
    bool own = false;
    const VoidConstPtr message = helper_->receive(waiting.delivered, header, own);
    params.event = MessageEvent<void const>(message, header, waiting.receipt, !own,
                                            MessageEvent<void const>::CreateFunction());
  } catch (const gazelle::Error& error) {
    ROS_ERROR("A message of %s on %s cannot be read: %s", waiting.delivered.type_name().c_str(),
              topic_.c_str(), error.what());
    return;
  }
  helper_->call(params);
}

const boost::shared_ptr<M_string>& SubscriptionQueue::headerOf(
    const gazelle::Delivered& delivered) {
  const std::lock_guard<std::mutex> lock(headers_mutex_);
  const std::string& publisher = delivered.info().publisher;
  boost::shared_ptr<M_string>& header = headers_[publisher];
  if (!header) {
    header = boost::make_shared<M_string>();
    (*header)["callerid"] = publisher;
    (*header)["topic"] = topic_;
    (*header)["latching"] = "0";
    const std::string& type = delivered.type_name();
    (*header)["type"] = detail::ros1TypeName(type);
    const gazelle::MessageType* native =
        delivered.type() ? delivered.type() : helper_->messageType();
    (*header)["md5sum"] = native ? native->md5 : detail::md5Of(type);
    (*header)["message_definition"] =
        native ? native->definition() : detail::definitionOf(type).c_str();
  }
  return header;
}

void Subscriber::Impl::close(bool waiting) {
  if (is_closed.exchange(true)) return;
  if (messages) messages->close();
  if (subscription) subscription->close();
  if (messages && waiting) messages->queue->removeByID(messages->owner);
}

Subscriber::Impl::~Impl() { close(true); }

void Subscriber::shutdown() {
  if (impl_) impl_->close(true);
  impl_.reset();
}
std::string Subscriber::getTopic() const { return isValid() ? impl_->topic : std::string(); }
uint32_t Subscriber::getNumPublishers() const {
  return isValid() ? static_cast<uint32_t>(impl_->subscription->publisher_count()) : 0;
}
bool Subscriber::isValid() const { return impl_ && !impl_->is_closed; }

}  // namespace ros
