// Publishers.

#include "ends.hpp"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/publisher.h>
#include <ros/single_subscriber_publisher.h>

#include <cstring>

namespace ros {

void Publisher::Impl::close(bool waiting) {
  std::shared_ptr<gazelle::Publisher> end;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (is_closed.exchange(true)) return;
    end = publisher;
  }
  if (end) end->close();
  if (queue && waiting) queue->removeByID(owner);
}

Publisher::Impl::~Impl() { close(true); }

void Publisher::shutdown() {
  if (impl_) impl_->close(true);
  impl_.reset();
}
std::string Publisher::getTopic() const { return isValid() ? impl_->topic : std::string(); }
uint32_t Publisher::getNumSubscribers() const {
  return isValid() ? static_cast<uint32_t>(impl_->publisher->subscription_count()) : 0;
}
bool Publisher::isLatched() const { return isValid() && impl_->latch; }
bool Publisher::isValid() const { return impl_ && !impl_->is_closed; }

bool Publisher::accepts(const gazelle::MessageType& type) const {
  if (!isValid()) {
    // At the end of a node its loops publish once more: nothing to tell.
    if (ros::ok())
      ROS_ERROR("Call to publish() on an invalid Publisher%s%s", impl_ ? " of topic " : "",
                impl_ ? impl_->topic.c_str() : "");
    return false;
  }
  const gazelle::MessageType* const known = impl_->accepted.load(std::memory_order_acquire);
  if (known == &type) return true;
  if (impl_->md5sum != "*" && std::strcmp(type.md5, "*") != 0 && impl_->md5sum != type.md5) {
    ROS_ERROR("Trying to publish message of type [%s/%s] on a publisher with type [%s/%s]",
              type.ros1_name, type.md5, impl_->datatype.c_str(), impl_->md5sum.c_str());
    return false;
  }
  impl_->accepted.store(&type, std::memory_order_release);
  return true;
}

void Publisher::send(std::shared_ptr<const void> message, const gazelle::MessageType& type) const {
  impl_->publisher->publish(std::move(message), type);
}

void Publisher::sendCopy(const void* message, const gazelle::MessageType& type,
                         std::shared_ptr<const void> (*copy)(const void*)) const {
  impl_->publisher->publish_copy(message, type, copy);
}

void Publisher::sendRos1(const uint8_t* bytes, std::size_t size) const {
  if (!isValid()) {
    if (ros::ok()) ROS_ERROR("Call to publish() on an invalid Publisher");
    return;
  }
  if (!impl_->latch && !impl_->publisher->wanted()) return;
  try {
    impl_->publisher->publish_cdr(
        detail::cdrFromRos1(impl_->datatype, impl_->definition, bytes, size));
  } catch (const gazelle::Error& error) {
    ROS_ERROR("A message of type %s for %s cannot be published: %s", impl_->datatype.c_str(),
              impl_->topic.c_str(), error.what());
  }
}

}  // namespace ros
