// Services and those who ask them.

#include <ros/console.h>
#include <ros/names.h>
#include <ros/node_handle.h>
#include <ros/service.h>

#include "ends.hpp"

namespace ros {

// ---- Servers

void ServiceServer::Impl::close(bool waiting) {
  if (is_closed.exchange(true)) return;
  if (server) server->close();
  if (queue && waiting) queue->removeByID(owner);
}
ServiceServer::Impl::~Impl() { close(true); }

void ServiceServer::shutdown() {
  if (impl_) impl_->close(true);
  impl_.reset();
}
std::string ServiceServer::getService() const { return isValid() ? impl_->service : std::string(); }
bool ServiceServer::isValid() const { return impl_ && !impl_->is_closed; }

// ---- Clients

void ServiceClient::Impl::close(bool) {
  if (is_closed.exchange(true)) return;
  std::shared_ptr<gazelle::ServiceClient> end;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    end.swap(client);
  }
  if (end) end->close();
}
ServiceClient::Impl::~Impl() { close(false); }

std::shared_ptr<gazelle::ServiceClient> ServiceClient::Impl::clientOf(
    const gazelle::ServiceType& type) {
  const std::lock_guard<std::mutex> lock(mutex);
  if (is_closed) return nullptr;
  if (!client) {
    const std::shared_ptr<gazelle::GraphNode> node = detail::graphNode();
    if (node) client = node->client(service, type);
  }
  return client;
}

bool ServiceClient::askBytes(std::vector<uint8_t> request, gazelle::Bytes& response,
                             const gazelle::ServiceType& type) const {
  if (!impl_ || impl_->is_closed) {
    ROS_DEBUG("call() on an invalid service client");
    return false;
  }
  if (!impl_->md5sum.empty() && impl_->md5sum != "*" && impl_->md5sum != type.md5) {
    ROS_ERROR(
        "Call to service [%s] with md5sum [%s] does not match md5sum when the handle was created "
        "([%s])",
        impl_->service.c_str(), type.md5, impl_->md5sum.c_str());
    return false;
  }
  gazelle::CallResult result;
  try {
    const std::shared_ptr<gazelle::ServiceClient> client = impl_->clientOf(type);
    if (!client) return false;
    result = client->call(std::move(request));
  } catch (const gazelle::Error& error) {
    ROS_ERROR("Service call failed: service [%s]: %s", impl_->service.c_str(), error.what());
    return false;
  }
  if (result.status == gazelle::CallStatus::kOk) {
    response = result.response;
    return true;
  }
  if (result.status == gazelle::CallStatus::kFailed && gazelle::ok())
    ROS_ERROR("Service call failed: service [%s] responded with an error: %s",
              impl_->service.c_str(), result.text.c_str());
  else
    ROS_DEBUG("Service call failed: service [%s]: %s", impl_->service.c_str(), result.text.c_str());
  return false;
}

bool ServiceClient::readResponse(const gazelle::Bytes& answer, void* response,
                                 const gazelle::ServiceType& type) const {
  try {
    if (type.response->layout) {
      gazelle::decode_cdr(*type.response->layout, response, answer.data(), answer.size());
      return true;
    }
    ROS_ERROR("The response class of %s cannot be read from the graph", type.name);
  } catch (const gazelle::Error& error) {
    ROS_ERROR("The response of service [%s] cannot be read: %s", impl_->service.c_str(),
              error.what());
  }
  return false;
}

bool ServiceClient::isPersistent() const { return impl_ && impl_->is_persistent; }
bool ServiceClient::isValid() const { return impl_ && !impl_->is_closed; }
void ServiceClient::shutdown() {
  if (impl_) impl_->close(true);
  impl_.reset();
}
std::string ServiceClient::getService() { return impl_ ? impl_->service : std::string(); }
bool ServiceClient::exists() { return impl_ && service::exists(impl_->service, false); }
bool ServiceClient::waitForExistence(Duration timeout) {
  return impl_ && service::waitForService(impl_->service, timeout);
}

namespace service {

bool exists(const std::string& service_name, bool print_failure_reason) {
  const std::string name = names::resolve(service_name);
  try {
    if (gazelle::call("service/exists", gazelle::Json::object({{"name", name}})).as_bool())
      return true;
  } catch (const gazelle::Error& error) {
    ROS_DEBUG("Whether %s is there cannot be asked: %s", name.c_str(), error.what());
  }
  if (print_failure_reason)
    ROS_INFO("waitForService: Service [%s] has not been advertised, waiting...", name.c_str());
  return false;
}

bool waitForService(const std::string& service_name, int32_t timeout) {
  return waitForService(service_name, Duration(timeout / 1000.0));
}

bool waitForService(const std::string& service_name, Duration timeout) {
  // The machine's time: a service that is awaited may be the one that starts simulated time.
  const int64_t begin = gazelle::clock::steady_ns();
  bool is_told = false;
  while (!exists(service_name, false)) {
    if (!gazelle::ok()) return false;
    if (timeout >= Duration(0) && gazelle::clock::steady_ns() - begin >= timeout.toNSec())
      return false;
    if (!is_told && gazelle::clock::steady_ns() - begin > 200000000ll)
      is_told = !exists(service_name, true);
    WallDuration(0.02).sleep();
  }
  if (is_told)
    ROS_INFO("waitForService: Service [%s] is now available.",
             names::resolve(service_name).c_str());
  return true;
}

}  // namespace service

}  // namespace ros
