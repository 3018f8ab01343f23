#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "gazelle/cdr.hpp"
#include "gazelle/core.hpp"
#include "gazelle/message.hpp"
#include "rcl/handles.h"
#include "rcl/service_introspection.h"
#include "rclcpp/clock.hpp"
#include "rclcpp/detail/executable.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/visibility_control.hpp"
#include "rmw/types.h"

namespace rclcpp {

namespace node_interfaces {
class NodeBaseInterface;
}

namespace detail {
/// How a request reaches the user's function.
using RequestCallback =
    std::function<void(const std::shared_ptr<rmw_request_id_t>&, const gazelle::Bytes&)>;
}  // namespace detail

/// What services of all types share.
class RCLCPP_PUBLIC ServiceBase : public detail::Executable,
                                  public std::enable_shared_from_this<ServiceBase> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(ServiceBase)
  ServiceBase(node_interfaces::NodeBaseInterface* node, const std::string& name,
              const gazelle::ServiceType& type, const QoS& qos);
  ~ServiceBase() override;

  const char* get_service_name();
  std::shared_ptr<rcl_service_t> get_service_handle();
  QoS get_response_subscription_actual_qos() const;
  QoS get_request_publisher_actual_qos() const;
  void set_on_new_request_callback(std::function<void(std::size_t)> callback) {
    set_on_new_work(std::move(callback));
  }
  void clear_on_new_request_callback() { set_on_new_work(nullptr); }
  void configure_introspection(Clock::SharedPtr clock, const QoS& qos,
                               rcl_service_introspection_state_t state);
  bool take_type_erased_request(void* request, rmw_request_id_t& id);
  std::shared_ptr<rmw_request_id_t> create_request_header() {
    return std::make_shared<rmw_request_id_t>();
  }

  detail::WorkKind kind() const override { return detail::WorkKind::kService; }
  bool has_work() override;
  bool do_work() override;

 protected:
  /// Start to listen; requests are handed over by the executor.
  void start(detail::RequestCallback callback);
  void respond(const rmw_request_id_t& id, const void* response);
  bool take_bytes(gazelle::Bytes& request, rmw_request_id_t& id);

 public:
  class Impl;

 private:
  std::shared_ptr<Impl> impl_;
};

/// Answers requests of one type.
template <typename ServiceT>
class Service : public ServiceBase {
 public:
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;
  using CallbackType =
      std::function<void(const std::shared_ptr<Request>, std::shared_ptr<Response>)>;
  using CallbackWithHeaderType =
      std::function<void(const std::shared_ptr<rmw_request_id_t>, const std::shared_ptr<Request>,
                         std::shared_ptr<Response>)>;
  RCLCPP_SMART_PTR_DEFINITIONS(Service)

  template <typename CallbackT>
  Service(node_interfaces::NodeBaseInterface* node, const std::string& name, CallbackT&& callback,
          const QoS& qos)
      : ServiceBase(node, name, gazelle::service_type<ServiceT>(), qos) {
    using F = std::decay_t<CallbackT>;
    auto kept = std::make_shared<F>(std::forward<CallbackT>(callback));
    start([this, kept](const std::shared_ptr<rmw_request_id_t>& id, const gazelle::Bytes& bytes) {
      F& call = *kept;
      auto request = std::make_shared<Request>();
      gazelle::from_cdr(*request, bytes.data(), bytes.size());
      using Id = std::shared_ptr<rmw_request_id_t>;
      using Asked = std::shared_ptr<Request>;
      using Answer = std::shared_ptr<Response>;
      if constexpr (std::is_invocable_v<F&, Asked, Answer>) {
        auto response = std::make_shared<Response>();
        call(request, response);
        respond(*id, response.get());
      } else if constexpr (std::is_invocable_v<F&, Id, Asked, Answer>) {
        auto response = std::make_shared<Response>();
        call(id, request, response);
        respond(*id, response.get());
      } else if constexpr (std::is_invocable_v<F&, std::shared_ptr<Service>, Id, Asked>) {
        call(std::static_pointer_cast<Service>(shared_from_this()), id, request);
      } else {
        static_assert(std::is_invocable_v<F&, Id, Asked>,
                      "a service's callback takes (request, response), (header, request, "
                      "response), (header, request) or (service, header, request)");
        call(id, request);
      }
    });
  }

  void send_response(rmw_request_id_t& id, Response& response) { respond(id, &response); }
  bool take_request(Request& request, rmw_request_id_t& id) {
    return take_type_erased_request(&request, id);
  }
};

}  // namespace rclcpp
