// Services and clients of all types.
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "gazelle/core.hpp"
#include "gazelle/message.hpp"
#include "name_errors.hpp"
#include "rclcpp/client.hpp"
#include "rclcpp/generic_client.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/service.hpp"

namespace rclcpp {

// ---- Services -----------------------------------------------------------------------------------

class ServiceBase::Impl {
 public:
  using Key = std::pair<std::array<std::uint8_t, 16>, std::int64_t>;

  static Key key_of(const rmw_request_id_t& id) {
    Key key;
    std::memcpy(key.first.data(), id.writer_guid, key.first.size());
    key.second = id.sequence_number;
    return key;
  }

  std::shared_ptr<gazelle::GraphNode> node;
  std::shared_ptr<gazelle::ServiceServer> server;
  std::string name;
  const gazelle::ServiceType* type = nullptr;
  QoS qos = ServicesQoS();
  detail::RequestCallback callback;
  std::shared_ptr<rcl_service_t> handle = std::make_shared<rcl_service_t>();
  std::mutex mutex;
  std::deque<std::pair<gazelle::RequestId, gazelle::Bytes>> queue;
  std::map<Key, gazelle::RequestId> open;
  ServiceBase* owner = nullptr;
};

ServiceBase::ServiceBase(node_interfaces::NodeBaseInterface* node, const std::string& name,
                         const gazelle::ServiceType& type, const QoS& qos)
    : impl_(std::make_shared<Impl>()) {
  impl_->node = node->graph_node();
  impl_->name = name;
  impl_->type = &type;
  impl_->qos = qos;
  impl_->owner = this;
  impl_->handle->impl = this;
}

ServiceBase::~ServiceBase() {
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->owner = nullptr;
  }
  if (impl_->server) impl_->server->close();
}

void ServiceBase::start(detail::RequestCallback callback) {
  impl_->callback = std::move(callback);
  std::weak_ptr<Impl> weak = impl_;
  detail::with_service_errors(impl_->name, [this, weak]() {
    impl_->server = impl_->node->offer(
        impl_->name, *impl_->type, [weak](gazelle::RequestId id, gazelle::Bytes request) {
          const auto impl = weak.lock();
          if (!impl) return;
          std::lock_guard<std::mutex> lock(impl->mutex);
          if (!impl->owner) return;
          impl->queue.emplace_back(std::move(id), std::move(request));
          impl->owner->announce_work();
        });
  });
  impl_->name = impl_->server->name();
}

const char* ServiceBase::get_service_name() { return impl_->name.c_str(); }
std::shared_ptr<rcl_service_t> ServiceBase::get_service_handle() { return impl_->handle; }
QoS ServiceBase::get_response_subscription_actual_qos() const { return impl_->qos; }
QoS ServiceBase::get_request_publisher_actual_qos() const { return impl_->qos; }
void ServiceBase::configure_introspection(Clock::SharedPtr, const QoS&,
                                          rcl_service_introspection_state_t state) {
  if (state == RCL_SERVICE_INTROSPECTION_OFF) return;
  RCLCPP_WARN_ONCE(
      get_logger("rclcpp"),
      "introspection of services is not there: nothing is published on _service_event");
}

bool ServiceBase::has_work() {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  return !impl_->queue.empty();
}

bool ServiceBase::take_bytes(gazelle::Bytes& request, rmw_request_id_t& id) {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  if (impl_->queue.empty()) return false;
  auto& first = impl_->queue.front();
  std::memcpy(id.writer_guid, first.first.client.data(), first.first.client.size());
  id.sequence_number = first.first.sequence;
  request = std::move(first.second);
  impl_->open[Impl::key_of(id)] = std::move(first.first);
  impl_->queue.pop_front();
  return true;
}

bool ServiceBase::take_type_erased_request(void* request, rmw_request_id_t& id) {
  gazelle::Bytes bytes;
  if (!take_bytes(bytes, id)) return false;
  gazelle::decode_cdr(*impl_->type->request->layout, request, bytes.data(), bytes.size());
  return true;
}

bool ServiceBase::do_work() {
  auto id = std::make_shared<rmw_request_id_t>();
  gazelle::Bytes bytes;
  if (!take_bytes(bytes, *id)) return false;
  const std::shared_ptr<Impl> kept = impl_;
  try {
    kept->callback(id, bytes);
  } catch (const gazelle::Error& error) {
    // The request was no message of the type.
    RCLCPP_ERROR(get_logger("rclcpp"), "a request of '%s' is refused: %s", kept->name.c_str(),
                 error.what());
    std::lock_guard<std::mutex> lock(kept->mutex);
    const auto found = kept->open.find(Impl::key_of(*id));
    if (found != kept->open.end()) {
      kept->server->fail(found->second, error.what());
      kept->open.erase(found);
    }
  }
  return true;
}

void ServiceBase::respond(const rmw_request_id_t& id, const void* response) {
  gazelle::RequestId request;
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    const auto found = impl_->open.find(Impl::key_of(id));
    if (found == impl_->open.end()) return;
    request = std::move(found->second);
    impl_->open.erase(found);
  }
  std::vector<std::uint8_t> cdr;
  impl_->type->response->encode(response, cdr);
  impl_->server->respond(request, gazelle::Bytes(std::move(cdr)));
}

// ---- Clients ------------------------------------------------------------------------------------

class ClientBase::Impl {
 public:
  struct Pending {
    detail::ResponseCallback callback;
    std::chrono::system_clock::time_point when;
    std::int64_t call = 0;  // the core's number
  };

  std::shared_ptr<gazelle::ServiceClient> client;
  const gazelle::ServiceType* type = nullptr;
  QoS qos = ServicesQoS();
  std::shared_ptr<rcl_client_t> handle = std::make_shared<rcl_client_t>();
  std::mutex mutex;
  std::int64_t last_number = 0;
  std::map<std::int64_t, Pending> pending;
  std::deque<std::pair<std::int64_t, gazelle::Bytes>> responses;
  ClientBase* owner = nullptr;
};

ClientBase::ClientBase(node_interfaces::NodeBaseInterface* node, const std::string& name,
                       const gazelle::ServiceType& type, const QoS& qos)
    : impl_(std::make_shared<Impl>()) {
  impl_->type = &type;
  impl_->qos = qos;
  impl_->owner = this;
  impl_->handle->impl = this;
  detail::with_service_errors(name,
                              [&]() { impl_->client = node->graph_node()->client(name, type); });
}

ClientBase::~ClientBase() {
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->owner = nullptr;
  }
  if (impl_->client) impl_->client->close();
}

const char* ClientBase::get_service_name() const { return impl_->client->name().c_str(); }
std::shared_ptr<rcl_client_t> ClientBase::get_client_handle() { return impl_->handle; }
bool ClientBase::service_is_ready() const { return impl_->client->is_ready(); }
QoS ClientBase::get_request_publisher_actual_qos() const { return impl_->qos; }
QoS ClientBase::get_response_subscription_actual_qos() const { return impl_->qos; }
void ClientBase::configure_introspection(Clock::SharedPtr, const QoS&,
                                         rcl_service_introspection_state_t state) {
  if (state == RCL_SERVICE_INTROSPECTION_OFF) return;
  RCLCPP_WARN_ONCE(
      get_logger("rclcpp"),
      "introspection of services is not there: nothing is published on _service_event");
}

bool ClientBase::wait_for_service_nanoseconds(std::chrono::nanoseconds timeout) {
  return impl_->client->wait_for(timeout.count() < 0 ? -1.0
                                                     : static_cast<double>(timeout.count()) / 1e9);
}

std::int64_t ClientBase::send(const void* request, detail::ResponseCallback callback) {
  std::vector<std::uint8_t> cdr;
  impl_->type->request->encode(request, cdr);
  std::int64_t number;
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    number = ++impl_->last_number;
    impl_->pending[number] = {std::move(callback), std::chrono::system_clock::now(), 0};
  }
  std::weak_ptr<Impl> weak = impl_;
  const std::int64_t call = impl_->client->call_async(
      gazelle::Bytes(std::move(cdr)), [weak, number](gazelle::CallResult result) {
        const auto impl = weak.lock();
        if (!impl) return;
        std::lock_guard<std::mutex> lock(impl->mutex);
        if (!impl->owner || !impl->pending.count(number)) return;
        if (result.status != gazelle::CallStatus::kOk) {
          // As in ROS 2, who asks a service that does not answer is not told; only the log is.
          RCLCPP_DEBUG(get_logger("rclcpp"), "no response: %s", result.text.c_str());
          return;
        }
        impl->responses.emplace_back(number, std::move(result.response));
        impl->owner->announce_work();
      });
  std::lock_guard<std::mutex> lock(impl_->mutex);
  const auto found = impl_->pending.find(number);
  if (found != impl_->pending.end()) found->second.call = call;
  return number;
}

bool ClientBase::has_work() {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  return !impl_->responses.empty();
}

bool ClientBase::do_work() {
  detail::ResponseCallback callback;
  gazelle::Bytes bytes;
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    if (impl_->responses.empty()) return false;
    const std::int64_t number = impl_->responses.front().first;
    bytes = std::move(impl_->responses.front().second);
    impl_->responses.pop_front();
    const auto found = impl_->pending.find(number);
    if (found == impl_->pending.end()) return true;
    callback = std::move(found->second.callback);
    impl_->pending.erase(found);
  }
  callback(bytes);
  return true;
}

bool ClientBase::take_type_erased_response(void* response, rmw_request_id_t& id) {
  detail::ResponseCallback callback;
  gazelle::Bytes bytes;
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    if (impl_->responses.empty()) return false;
    id.sequence_number = impl_->responses.front().first;
    bytes = std::move(impl_->responses.front().second);
    impl_->responses.pop_front();
    const auto found = impl_->pending.find(id.sequence_number);
    if (found != impl_->pending.end()) callback = std::move(found->second.callback);
    if (found != impl_->pending.end()) impl_->pending.erase(found);
  }
  gazelle::decode_cdr(*impl_->type->response->layout, response, bytes.data(), bytes.size());
  if (callback) callback(bytes);
  return true;
}

bool ClientBase::remove_pending_request(std::int64_t request_id) {
  std::int64_t call = 0;
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    const auto found = impl_->pending.find(request_id);
    if (found == impl_->pending.end()) return false;
    call = found->second.call;
    impl_->pending.erase(found);
  }
  if (call) impl_->client->cancel(call);
  return true;
}

std::size_t ClientBase::prune_pending_requests() {
  return prune_older_than(std::chrono::system_clock::time_point::max()).size();
}

std::vector<std::int64_t> ClientBase::prune_older_than(std::chrono::system_clock::time_point when) {
  std::vector<std::int64_t> numbers;
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    for (const auto& one : impl_->pending) {
      if (one.second.when < when) numbers.push_back(one.first);
    }
  }
  for (const std::int64_t number : numbers) remove_pending_request(number);
  return numbers;
}

const gazelle::ServiceType& GenericClient::service_of(const std::string& type) {
  throw exceptions::RCLError(RCL_RET_UNSUPPORTED,
                             "no class of the service " + type + " is in this program");
}

}  // namespace rclcpp
