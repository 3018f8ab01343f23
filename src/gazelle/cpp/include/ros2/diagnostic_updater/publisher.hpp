#pragma once

#include <memory>
#include <utility>

#include "diagnostic_updater/update_functions.hpp"
#include "rclcpp/publisher.hpp"

namespace diagnostic_updater {

// A publisher that watches itself.
template <class MessageT, typename AllocatorT = std::allocator<void>>
class DiagnosedPublisher : public TopicDiagnostic {
 public:
  using PublisherT = rclcpp::Publisher<MessageT, AllocatorT>;

  DiagnosedPublisher(const typename PublisherT::SharedPtr& pub, Updater& diag,
                     const FrequencyStatusParam& freq, const TimeStampStatusParam& stamp)
      : TopicDiagnostic(pub->get_topic_name(), diag, freq, stamp), publisher_(pub) {}

  virtual void publish(std::unique_ptr<MessageT> message) {
    tick(message->header.stamp);
    publisher_->publish(std::move(message));
  }
  virtual void publish(const MessageT& message) {
    tick(message.header.stamp);
    publisher_->publish(message);
  }
  typename PublisherT::SharedPtr getPublisher() const { return publisher_; }
  void setPublisher(typename PublisherT::SharedPtr pub) { publisher_ = pub; }

 private:
  typename PublisherT::SharedPtr publisher_;
};

}  // namespace diagnostic_updater
