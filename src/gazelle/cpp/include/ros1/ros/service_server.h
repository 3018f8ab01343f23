#pragma once

#include <ros/common.h>
#include <ros/forwards.h>

namespace ros {

/// A service that is offered until the last copy goes.
class ROSCPP_DECL ServiceServer {
 public:
  ServiceServer() {}
  void shutdown();
  std::string getService() const;

  operator void*() const { return isValid() ? reinterpret_cast<void*>(1) : 0; }
  bool operator<(const ServiceServer& other) const { return impl_ < other.impl_; }
  bool operator==(const ServiceServer& other) const { return impl_ == other.impl_; }
  bool operator!=(const ServiceServer& other) const { return impl_ != other.impl_; }

  class Impl;

 private:
  friend class NodeHandle;
  explicit ServiceServer(const boost::shared_ptr<Impl>& impl) : impl_(impl) {}
  bool isValid() const;

  boost::shared_ptr<Impl> impl_;
};
typedef std::vector<ServiceServer> V_ServiceServer;

}  // namespace ros
