#pragma once

#include <future>
#include <memory>
#include <string>
#include <utility>

#include "rclcpp/client.hpp"

namespace rclcpp {

/// Asks a service of a type that is named when the program runs; messages are objects of the
/// classes that the service has in this program.
class RCLCPP_PUBLIC GenericClient : public ClientBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GenericClient)
  using Request = void*;
  using Response = void*;
  using SharedResponse = std::shared_ptr<void>;
  using Promise = std::promise<SharedResponse>;
  using Future = std::future<SharedResponse>;
  using SharedFuture = std::shared_future<SharedResponse>;
  struct FutureAndRequestId : detail::FutureAndRequestId<Future> {
    using detail::FutureAndRequestId<Future>::FutureAndRequestId;
    SharedFuture share() noexcept { return this->future.share(); }
  };

  GenericClient(node_interfaces::NodeBaseInterface* node, const std::string& name,
                const std::string& type, const QoS& qos)
      : ClientBase(node, name, service_of(type), qos), type_(service_of(type)) {}

  FutureAndRequestId async_send_request(const Request request) {
    auto promise = std::make_shared<Promise>();
    auto future = promise->get_future();
    const gazelle::MessageType* response = type_.response;
    const int64_t number = send(request, [promise, response](const gazelle::Bytes& bytes) {
      promise->set_value(response->decode(bytes.data(), bytes.size()));
    });
    return FutureAndRequestId(std::move(future), number);
  }

 private:
  /// Throws where this program has no class of the service.
  static const gazelle::ServiceType& service_of(const std::string& type);
  const gazelle::ServiceType& type_;
};

}  // namespace rclcpp
