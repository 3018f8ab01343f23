#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/subscription_callback_helper.h>

namespace ros {

/// A subscription; it ends when the last copy goes.
class ROSCPP_DECL Subscriber {
 public:
  Subscriber() {}

  void shutdown();
  std::string getTopic() const;
  uint32_t getNumPublishers() const;

  operator void*() const { return isValid() ? reinterpret_cast<void*>(1) : 0; }
  bool operator<(const Subscriber& other) const { return impl_ < other.impl_; }
  bool operator==(const Subscriber& other) const { return impl_ == other.impl_; }
  bool operator!=(const Subscriber& other) const { return impl_ != other.impl_; }

  class Impl;

 private:
  friend class NodeHandle;
  explicit Subscriber(const boost::shared_ptr<Impl>& impl) : impl_(impl) {}
  bool isValid() const;

  boost::shared_ptr<Impl> impl_;
};
typedef std::vector<Subscriber> V_Subscriber;

}  // namespace ros
