#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gazelle/cdr.hpp"
#include "gazelle/core.hpp"
#include "gazelle/message.hpp"
#include "rcl/handles.h"
#include "rcl/service_introspection.h"
#include "rclcpp/clock.hpp"
#include "rclcpp/context.hpp"
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

template <typename FutureT>
struct FutureAndRequestId {
  FutureT future;
  int64_t request_id;

  FutureAndRequestId(FutureT given, int64_t id) : future(std::move(given)), request_id(id) {}
  operator FutureT&() { return future; }  // NOLINT(runtime/explicit)
  auto get() { return this->future.get(); }
  bool valid() const noexcept { return this->future.valid(); }
  void wait() const { return this->future.wait(); }
  template <class Rep, class Period>
  std::future_status wait_for(const std::chrono::duration<Rep, Period>& timeout) const {
    return this->future.wait_for(timeout);
  }
  template <class Clock, class Duration>
  std::future_status wait_until(const std::chrono::time_point<Clock, Duration>& when) const {
    return this->future.wait_until(when);
  }
  FutureAndRequestId(FutureAndRequestId&&) noexcept = default;
  FutureAndRequestId(const FutureAndRequestId&) = delete;
  FutureAndRequestId& operator=(FutureAndRequestId&&) noexcept = default;
  FutureAndRequestId& operator=(const FutureAndRequestId&) = delete;
  ~FutureAndRequestId() = default;
};

/// What happens to the response of one request.
using ResponseCallback = std::function<void(const gazelle::Bytes&)>;

}  // namespace detail

/// What clients of all types share.
class RCLCPP_PUBLIC ClientBase : public detail::Executable,
                                 public std::enable_shared_from_this<ClientBase> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(ClientBase)
  ClientBase(node_interfaces::NodeBaseInterface* node, const std::string& name,
             const gazelle::ServiceType& type, const QoS& qos);
  ~ClientBase() override;

  const char* get_service_name() const;
  std::shared_ptr<rcl_client_t> get_client_handle();
  bool service_is_ready() const;
  template <typename Rep = int64_t, typename Ratio = std::milli>
  bool wait_for_service(
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return wait_for_service_nanoseconds(
        std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }
  QoS get_request_publisher_actual_qos() const;
  QoS get_response_subscription_actual_qos() const;
  void set_on_new_response_callback(std::function<void(std::size_t)> callback) {
    set_on_new_work(std::move(callback));
  }
  void clear_on_new_response_callback() { set_on_new_work(nullptr); }
  void configure_introspection(Clock::SharedPtr clock, const QoS& qos,
                               rcl_service_introspection_state_t state);
  bool remove_pending_request(int64_t request_id);
  std::size_t prune_pending_requests();

  detail::WorkKind kind() const override { return detail::WorkKind::kClient; }
  bool has_work() override;
  bool do_work() override;
  /// Take a response without a callback (wait sets); runs the request's own.
  bool take_type_erased_response(void* response, rmw_request_id_t& id);

 protected:
  int64_t send(const void* request, detail::ResponseCallback callback);
  bool wait_for_service_nanoseconds(std::chrono::nanoseconds timeout);
  std::vector<int64_t> prune_older_than(std::chrono::system_clock::time_point when);

 public:
  class Impl;

 private:
  std::shared_ptr<Impl> impl_;
};

/// Asks a service of one type; responses come while an executor spins.
template <typename ServiceT>
class Client : public ClientBase {
 public:
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;
  using SharedRequest = typename ServiceT::Request::SharedPtr;
  using SharedResponse = typename ServiceT::Response::SharedPtr;
  using Promise = std::promise<SharedResponse>;
  using PromiseWithRequest = std::promise<std::pair<SharedRequest, SharedResponse>>;
  using SharedPromise = std::shared_ptr<Promise>;
  using SharedPromiseWithRequest = std::shared_ptr<PromiseWithRequest>;
  using Future = std::future<SharedResponse>;
  using SharedFuture = std::shared_future<SharedResponse>;
  using SharedFutureWithRequest = std::shared_future<std::pair<SharedRequest, SharedResponse>>;
  using CallbackType = std::function<void(SharedFuture)>;
  using CallbackWithRequestType = std::function<void(SharedFutureWithRequest)>;
  RCLCPP_SMART_PTR_DEFINITIONS(Client)

  struct FutureAndRequestId : detail::FutureAndRequestId<Future> {
    using detail::FutureAndRequestId<Future>::FutureAndRequestId;
    operator SharedFuture() { return this->future.share(); }  // NOLINT(runtime/explicit)
    SharedFuture share() noexcept { return this->future.share(); }
  };
  struct SharedFutureAndRequestId : detail::FutureAndRequestId<SharedFuture> {
    using detail::FutureAndRequestId<SharedFuture>::FutureAndRequestId;
  };
  struct SharedFutureWithRequestAndRequestId : detail::FutureAndRequestId<SharedFutureWithRequest> {
    using detail::FutureAndRequestId<SharedFutureWithRequest>::FutureAndRequestId;
  };

  Client(node_interfaces::NodeBaseInterface* node, const std::string& name, const QoS& qos)
      : ClientBase(node, name, gazelle::service_type<ServiceT>(), qos) {}

  FutureAndRequestId async_send_request(SharedRequest request) {
    auto promise = std::make_shared<Promise>();
    auto future = promise->get_future();
    const int64_t number = send(
        request.get(), [promise](const gazelle::Bytes& bytes) { promise->set_value(read(bytes)); });
    return FutureAndRequestId(std::move(future), number);
  }

  template <typename CallbackT,
            std::enable_if_t<std::is_invocable_v<std::decay_t<CallbackT>&, SharedFuture>, int> = 0>
  SharedFutureAndRequestId async_send_request(SharedRequest request, CallbackT&& callback) {
    auto promise = std::make_shared<Promise>();
    SharedFuture future = promise->get_future().share();
    auto kept = std::make_shared<std::decay_t<CallbackT>>(std::forward<CallbackT>(callback));
    const int64_t number =
        send(request.get(), [promise, future, kept](const gazelle::Bytes& bytes) {
          promise->set_value(read(bytes));
          (*kept)(future);
        });
    return SharedFutureAndRequestId(future, number);
  }

  template <
      typename CallbackT,
      std::enable_if_t<std::is_invocable_v<std::decay_t<CallbackT>&, SharedFutureWithRequest> &&
                           !std::is_invocable_v<std::decay_t<CallbackT>&, SharedFuture>,
                       int> = 0>
  SharedFutureWithRequestAndRequestId async_send_request(SharedRequest request,
                                                         CallbackT&& callback) {
    auto promise = std::make_shared<PromiseWithRequest>();
    SharedFutureWithRequest future = promise->get_future().share();
    auto kept = std::make_shared<std::decay_t<CallbackT>>(std::forward<CallbackT>(callback));
    const int64_t number =
        send(request.get(), [promise, future, kept, request](const gazelle::Bytes& bytes) {
          promise->set_value(std::make_pair(request, read(bytes)));
          (*kept)(future);
        });
    return SharedFutureWithRequestAndRequestId(future, number);
  }

  using ClientBase::remove_pending_request;
  bool remove_pending_request(const FutureAndRequestId& future) {
    return ClientBase::remove_pending_request(future.request_id);
  }
  bool remove_pending_request(const SharedFutureAndRequestId& future) {
    return ClientBase::remove_pending_request(future.request_id);
  }
  bool remove_pending_request(const SharedFutureWithRequestAndRequestId& future) {
    return ClientBase::remove_pending_request(future.request_id);
  }
  template <typename AllocatorT = std::allocator<int64_t>>
  std::size_t prune_requests_older_than(std::chrono::time_point<std::chrono::system_clock> when,
                                        std::vector<int64_t, AllocatorT>* pruned = nullptr) {
    const auto numbers = prune_older_than(when);
    if (pruned) pruned->insert(pruned->end(), numbers.begin(), numbers.end());
    return numbers.size();
  }
  bool take_response(Response& response, rmw_request_id_t& id) {
    return take_type_erased_response(&response, id);
  }

 private:
  static SharedResponse read(const gazelle::Bytes& bytes) {
    auto response = std::make_shared<Response>();
    gazelle::from_cdr(*response, bytes.data(), bytes.size());
    return response;
  }
};

}  // namespace rclcpp
