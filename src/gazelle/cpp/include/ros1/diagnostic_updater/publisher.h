#pragma once

#include <ros/publisher.h>

#include <memory>

#include "diagnostic_updater/update_functions.h"

namespace diagnostic_updater {

// A publisher that watches itself.
template <class T>
class DiagnosedPublisher : public TopicDiagnostic {
 public:
  DiagnosedPublisher(const ros::Publisher& pub, Updater& diag, const FrequencyStatusParam& freq,
                     const TimeStampStatusParam& stamp)
      : TopicDiagnostic(pub.getTopic(), diag, freq, stamp), publisher_(pub) {}

  virtual void publish(const boost::shared_ptr<T>& message) {
    tick(message->header.stamp);
    publisher_.publish(message);
  }
  virtual void publish(const T& message) {
    tick(message.header.stamp);
    publisher_.publish(message);
  }
  ros::Publisher getPublisher() const { return publisher_; }
  void setPublisher(ros::Publisher pub) { publisher_ = pub; }

 private:
  ros::Publisher publisher_;
};

}  // namespace diagnostic_updater
