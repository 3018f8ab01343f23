// Publishers and subscriptions of all types.
#include <algorithm>
#include <cstring>
#include <deque>
#include <mutex>
#include <utility>

#include "endpoint_events.hpp"
#include "gazelle/core.hpp"
#include "gazelle/message.hpp"
#include "name_errors.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/serialization.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rmw/rmw.h"
#include "topic_statistics.hpp"

namespace rclcpp {
namespace {

gazelle::Bytes copy_of(const rcl_serialized_message_t& message) {
  return gazelle::Bytes(
      std::vector<std::uint8_t>(message.buffer, message.buffer + message.buffer_length));
}

MessageInfo info_of(const gazelle::MessageInfo& given) {
  rmw_message_info_t info{};
  info.source_timestamp = given.stamp_ns;
  info.received_timestamp = gazelle::clock::wall_ns();
  info.publication_sequence_number = given.sequence;
  info.reception_sequence_number = RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED;
  info.publisher_gid.implementation_identifier = rmw_get_implementation_identifier();
  std::copy(given.gid.begin(), given.gid.end(), info.publisher_gid.data);
  info.from_intra_process = false;
  return MessageInfo(info);
}

void check_depth(const QoS& qos) {
  const auto& profile = qos.get_rmw_qos_profile();
  if (profile.history != RMW_QOS_POLICY_HISTORY_KEEP_LAST || profile.depth != 0) return;
  RCLCPP_WARN_ONCE(get_logger("rclcpp"),
                   "A zero depth with KEEP_LAST doesn't make sense; no data could be stored. "
                   "This will be interpreted as SYSTEM_DEFAULT");
}

}  // namespace

// ---- Publishers ---------------------------------------------------------------------------------

class PublisherBase::Impl {
 public:
  Impl(node_interfaces::NodeBaseInterface* node, const QoS& given,
       const PublisherOptionsBase& options)
      : qos(given),
        events(std::make_shared<detail::EndpointEvents>(options.event_callbacks, given)),
        graph_node(node->graph_node()) {
    check_depth(qos);
    handle = std::make_shared<rcl_publisher_t>();
    handle->impl = this;
    handlers = events->handlers();
  }

  gazelle::PublisherOptions options() {
    gazelle::PublisherOptions made;
    if (events->any()) {
      std::weak_ptr<detail::EndpointEvents> weak = events;
      made.matched = [weak](std::size_t count) {
        if (const auto strong = weak.lock()) strong->on_matched(count);
      };
    }
    return made;
  }

  void opened() {
    gid.implementation_identifier = rmw_get_implementation_identifier();
    const auto& bytes = publisher->gid();
    std::copy(bytes.begin(), bytes.end(), gid.data);
    std::weak_ptr<gazelle::Publisher> weak = publisher;
    events->topic = [weak]() {
      const auto strong = weak.lock();
      return strong ? strong->topic() : std::string();
    };
    events->start();
    if (events->any()) events->on_matched(publisher->subscription_count());
  }

  void sent() {
    if (!events->any()) return;
    events->on_activity();
    events->on_alive();
  }

  const QoS qos;
  std::shared_ptr<detail::EndpointEvents> events;
  std::shared_ptr<gazelle::GraphNode> graph_node;
  std::shared_ptr<gazelle::Publisher> publisher;
  const gazelle::MessageType* type = nullptr;
  std::shared_ptr<rcl_publisher_t> handle;
  std::unordered_map<int, std::shared_ptr<Waitable>> handlers;
  rmw_gid_t gid{};
};

PublisherBase::PublisherBase(node_interfaces::NodeBaseInterface* node, const std::string& topic,
                             const gazelle::MessageType& type, const QoS& qos,
                             const PublisherOptionsBase& options)
    : impl_(std::make_shared<Impl>(node, qos, options)) {
  impl_->type = &type;
  detail::with_topic_errors(topic, [&]() {
    impl_->publisher = impl_->graph_node->advertise(topic, type, qos.to_graph(), impl_->options());
  });
  impl_->opened();
}

PublisherBase::PublisherBase(node_interfaces::NodeBaseInterface* node, const std::string& topic,
                             const std::string& type_name, const QoS& qos,
                             const PublisherOptionsBase& options)
    : impl_(std::make_shared<Impl>(node, qos, options)) {
  detail::with_topic_errors(topic, [&]() {
    impl_->publisher = impl_->graph_node->advertise(topic, type_name, std::string(), qos.to_graph(),
                                                    impl_->options());
  });
  impl_->opened();
}

PublisherBase::~PublisherBase() {
  impl_->events->stop();
  if (impl_->publisher) impl_->publisher->close();
}

const char* PublisherBase::get_topic_name() const { return impl_->publisher->topic().c_str(); }
std::size_t PublisherBase::get_queue_size() const { return impl_->qos.depth(); }
const rmw_gid_t& PublisherBase::get_gid() const { return impl_->gid; }
std::shared_ptr<rcl_publisher_t> PublisherBase::get_publisher_handle() { return impl_->handle; }
std::shared_ptr<const rcl_publisher_t> PublisherBase::get_publisher_handle() const {
  return impl_->handle;
}
const std::unordered_map<int, std::shared_ptr<Waitable>>& PublisherBase::get_event_handlers()
    const {
  return impl_->handlers;
}
std::size_t PublisherBase::get_subscription_count() const {
  return impl_->publisher->subscription_count();
}
std::size_t PublisherBase::get_intra_process_subscription_count() const {
  return impl_->publisher->local_subscription_count();
}
bool PublisherBase::assert_liveliness() const {
  impl_->events->on_alive();
  return !impl_->publisher->closed();
}
QoS PublisherBase::get_actual_qos() const {
  QoS actual = impl_->qos;
  const auto graph = actual.to_graph();
  // What was left to the transport is what it does.
  if (actual.reliability() == ReliabilityPolicy::SystemDefault ||
      actual.reliability() == ReliabilityPolicy::BestAvailable) {
    actual.reliable();
  }
  if (actual.durability() == DurabilityPolicy::SystemDefault ||
      actual.durability() == DurabilityPolicy::BestAvailable) {
    actual.durability_volatile();
  }
  if (actual.history() == HistoryPolicy::SystemDefault) actual.keep_last(graph.depth);
  if (actual.liveliness() == LivelinessPolicy::SystemDefault) {
    actual.liveliness(LivelinessPolicy::Automatic);
  }
  const rmw_time_t infinite = RMW_DURATION_INFINITE;
  if (!graph.deadline_ns) actual.deadline(infinite);
  if (!graph.lifespan_ns) actual.lifespan(infinite);
  if (!graph.lease_ns) actual.liveliness_lease_duration(infinite);
  return actual;
}
bool PublisherBase::operator==(const rmw_gid_t& gid) const {
  return std::memcmp(gid.data, impl_->gid.data, sizeof(gid.data)) == 0;
}
bool PublisherBase::is_wanted() const { return impl_->publisher->wanted(); }

void PublisherBase::publish_object(std::shared_ptr<const void> message) {
  impl_->publisher->publish(std::move(message), *impl_->type);
  impl_->sent();
}

void PublisherBase::publish_look(const void* message,
                                 std::shared_ptr<const void> (*copy)(const void*)) {
  impl_->publisher->publish_copy(message, *impl_->type, copy);
  impl_->sent();
}

void PublisherBase::publish_bytes(const rcl_serialized_message_t& message) {
  impl_->publisher->publish_cdr(copy_of(message));
  impl_->sent();
}

// ---- Subscriptions ------------------------------------------------------------------------------

class SubscriptionBase::Impl {
 public:
  Impl(node_interfaces::NodeBaseInterface* node, const QoS& given,
       const SubscriptionOptionsBase& options, detail::MessageCallback call)
      : qos(given),
        callback(std::move(call)),
        events(std::make_shared<detail::EndpointEvents>(options.event_callbacks, given)),
        graph_node(node->graph_node()) {
    check_depth(qos);
    const auto graph = qos.to_graph();
    depth = graph.keep_all ? 0 : graph.depth;
    handle = std::make_shared<rcl_subscription_t>();
    handle->impl = this;
    handlers = events->handlers();
  }

  gazelle::SubscriptionOptions options(const SubscriptionOptionsBase& given) {
    gazelle::SubscriptionOptions made;
    made.latched = qos.to_graph().transient_local;
    made.ignore_local = given.ignore_local_publications;
    if (events->any()) {
      std::weak_ptr<detail::EndpointEvents> weak = events;
      made.matched = [weak](std::size_t count) {
        if (const auto strong = weak.lock()) strong->on_matched(count);
      };
    }
    return made;
  }

  void opened() {
    std::weak_ptr<gazelle::Subscription> weak = subscription;
    events->topic = [weak]() {
      const auto strong = weak.lock();
      return strong ? strong->topic() : std::string();
    };
    events->start();
    if (events->any()) events->on_matched(subscription->publisher_count());
  }

  void push(gazelle::Delivered&& delivered) {
    if (events->any()) {
      events->on_activity();
      if (events->counts_lost()) events->on_sequence(delivered.info());
    }
    std::lock_guard<std::mutex> lock(mutex);
    if (depth && queue.size() >= depth) queue.pop_front();
    queue.push_back(std::move(delivered));
    size.store(queue.size(), std::memory_order_release);
  }

  std::optional<gazelle::Delivered> pop() {
    std::optional<gazelle::Delivered> taken;
    std::lock_guard<std::mutex> lock(mutex);
    if (queue.empty()) return taken;
    taken.emplace(std::move(queue.front()));
    queue.pop_front();
    size.store(queue.size(), std::memory_order_release);
    return taken;
  }

  const QoS qos;
  detail::MessageCallback callback;
  std::shared_ptr<detail::EndpointEvents> events;
  std::shared_ptr<gazelle::GraphNode> graph_node;
  std::shared_ptr<gazelle::Subscription> subscription;
  std::shared_ptr<rcl_subscription_t> handle;
  std::unordered_map<int, std::shared_ptr<Waitable>> handlers;
  std::shared_ptr<detail::TopicStatistics> statistics;
  ContentFilterOptions filter;
  std::mutex mutex;
  std::deque<gazelle::Delivered> queue;
  std::atomic<std::size_t> size{0};
  std::size_t depth = 0;
};

SubscriptionBase::SubscriptionBase(node_interfaces::NodeBaseInterface* node,
                                   const std::string& topic, const gazelle::MessageType& type,
                                   const QoS& qos, const SubscriptionOptionsBase& options,
                                   detail::MessageCallback callback)
    : impl_(std::make_shared<Impl>(node, qos, options, std::move(callback))),
      type_(&type),
      type_name_(type.name) {
  detail::with_topic_errors(topic, [&]() {
    impl_->subscription = impl_->graph_node->subscribe(
        topic, &type, qos.to_graph(),
        [this](gazelle::Delivered delivered) {
          impl_->push(std::move(delivered));
          announce_work();
        },
        impl_->options(options));
  });
  impl_->opened();
}

SubscriptionBase::SubscriptionBase(node_interfaces::NodeBaseInterface* node,
                                   const std::string& topic, const std::string& type_name,
                                   const QoS& qos, const SubscriptionOptionsBase& options,
                                   detail::MessageCallback callback)
    : impl_(std::make_shared<Impl>(node, qos, options, std::move(callback))),
      type_name_(type_name) {
  detail::with_topic_errors(topic, [&]() {
    impl_->subscription = impl_->graph_node->subscribe(
        topic, type_name, qos.to_graph(),
        [this](gazelle::Delivered delivered) {
          impl_->push(std::move(delivered));
          announce_work();
        },
        impl_->options(options));
  });
  impl_->opened();
}

SubscriptionBase::~SubscriptionBase() {
  impl_->events->stop();
  if (impl_->subscription) impl_->subscription->close();
}

const char* SubscriptionBase::get_topic_name() const {
  return impl_->subscription->topic().c_str();
}
std::shared_ptr<rcl_subscription_t> SubscriptionBase::get_subscription_handle() {
  return impl_->handle;
}
std::shared_ptr<const rcl_subscription_t> SubscriptionBase::get_subscription_handle() const {
  return impl_->handle;
}
const std::unordered_map<int, std::shared_ptr<Waitable>>& SubscriptionBase::get_event_handlers()
    const {
  return impl_->handlers;
}
QoS SubscriptionBase::get_actual_qos() const { return impl_->qos; }
std::size_t SubscriptionBase::get_publisher_count() const {
  return impl_->subscription->publisher_count();
}

bool SubscriptionBase::has_work() { return impl_->size.load(std::memory_order_acquire) > 0; }

bool SubscriptionBase::do_work() {
  std::optional<gazelle::Delivered> taken = impl_->pop();
  if (!taken) return false;
  if (type_ && !serialized_) {
    try {
      taken->object(*type_);
    } catch (const gazelle::Error& error) {
      RCLCPP_ERROR(get_logger("rclcpp"), "a message on '%s' is dropped: %s", get_topic_name(),
                   error.what());
      return true;
    }
  }
  if (impl_->statistics) impl_->statistics->take(*taken, type_);
  const MessageInfo info = info_of(taken->info());
  // The callback may end the subscription; what it needs is kept until it is done.
  const std::shared_ptr<Impl> kept = impl_;
  kept->callback(std::move(*taken), info);
  return true;
}

std::shared_ptr<void> SubscriptionBase::create_message() {
  return type_ ? type_->create() : nullptr;
}

void SubscriptionBase::assign_message(void* target, std::shared_ptr<void> source) {
  std::vector<std::uint8_t> cdr;
  type_->encode(source.get(), cdr);
  gazelle::decode_cdr(*type_->layout, target, cdr.data(), cdr.size());
}

bool SubscriptionBase::take_type_erased(void* message, MessageInfo& info) {
  std::optional<gazelle::Delivered> taken = impl_->pop();
  if (!taken || !type_) return false;
  info = info_of(taken->info());
  assign_message(message, taken->own_object(*type_));
  return true;
}

bool SubscriptionBase::take_serialized(SerializedMessage& message, MessageInfo& info) {
  const std::optional<gazelle::Delivered> taken = impl_->pop();
  if (!taken) return false;
  info = info_of(taken->info());
  const gazelle::Bytes bytes = taken->cdr();
  message.assign(bytes.data(), bytes.size());
  return true;
}

void SubscriptionBase::handle_message(std::shared_ptr<void>& message, const MessageInfo& info) {
  impl_->callback(gazelle::Delivered(std::shared_ptr<const void>(message), type_, {}), info);
}

void SubscriptionBase::handle_serialized_message(const std::shared_ptr<SerializedMessage>& message,
                                                 const MessageInfo& info) {
  impl_->callback(
      gazelle::Delivered(copy_of(message->get_rcl_serialized_message()), type_name_, {}), info);
}

bool SubscriptionBase::is_cft_enabled() const { return false; }

void SubscriptionBase::set_content_filter(const std::string&, const std::vector<std::string>&) {
  throw exceptions::RCLError(RCL_RET_UNSUPPORTED,
                             "failed to set cft expression parameters: content filters are not "
                             "supported here; every message arrives");
}

ContentFilterOptions SubscriptionBase::get_content_filter() const { return impl_->filter; }

void SubscriptionBase::start_statistics(node_interfaces::NodeTopicsInterface* topics,
                                        const SubscriptionOptionsBase& options, bool by_default) {
  const auto& wanted = options.topic_stats_options;
  const bool enabled = wanted.state == TopicStatisticsState::Enable ||
                       (wanted.state == TopicStatisticsState::NodeDefault && by_default);
  if (!enabled) return;
  impl_->statistics = detail::TopicStatistics::create(topics, options);
}

// ---- Serialized messages ------------------------------------------------------------------------

SerializedMessage::SerializedMessage(const rcl_allocator_t& allocator)
    : SerializedMessage(0, allocator) {}

SerializedMessage::SerializedMessage(std::size_t initial_capacity,
                                     const rcl_allocator_t& allocator) {
  if (rmw_serialized_message_init(&message_, initial_capacity, &allocator) != RCUTILS_RET_OK) {
    throw std::bad_alloc();
  }
}

SerializedMessage::SerializedMessage(const SerializedMessage& other)
    : SerializedMessage(other.message_) {}

SerializedMessage::SerializedMessage(const rcl_serialized_message_t& other)
    : SerializedMessage(0, other.allocator) {
  assign(other.buffer, other.buffer_length);
}

SerializedMessage::SerializedMessage(SerializedMessage&& other)
    : SerializedMessage(std::move(other.message_)) {}

SerializedMessage::SerializedMessage(rcl_serialized_message_t&& other) : message_(other) {
  other.buffer = nullptr;
  other.buffer_length = other.buffer_capacity = 0;
}

SerializedMessage& SerializedMessage::operator=(const SerializedMessage& other) {
  return *this = other.message_;
}

SerializedMessage& SerializedMessage::operator=(const rcl_serialized_message_t& other) {
  if (&other != &message_) assign(other.buffer, other.buffer_length);
  return *this;
}

SerializedMessage& SerializedMessage::operator=(SerializedMessage&& other) {
  if (this != &other) std::swap(message_, other.message_);
  return *this;
}

SerializedMessage& SerializedMessage::operator=(rcl_serialized_message_t&& other) {
  if (&other != &message_) std::swap(message_, other);
  return *this;
}

SerializedMessage::~SerializedMessage() {
  if (message_.buffer) rmw_serialized_message_fini(&message_);
}

void SerializedMessage::reserve(std::size_t capacity) {
  if (rmw_serialized_message_resize(&message_, capacity) != RCUTILS_RET_OK) throw std::bad_alloc();
}

rcl_serialized_message_t SerializedMessage::release_rcl_serialized_message() {
  rcl_serialized_message_t released = message_;
  message_.buffer = nullptr;
  message_.buffer_length = message_.buffer_capacity = 0;
  return released;
}

void SerializedMessage::assign(const void* data, std::size_t size) {
  if (size > message_.buffer_capacity) reserve(size);
  if (size) std::memcpy(message_.buffer, data, size);
  message_.buffer_length = size;
}

void SerializationBase::serialize_message(const void* ros_message,
                                          SerializedMessage* serialized) const {
  if (!ros_message) throw std::invalid_argument("ROS message is nullpointer.");
  if (!serialized) throw std::invalid_argument("Serialized message is nullpointer.");
  std::vector<std::uint8_t> cdr;
  type_->encode(ros_message, cdr);
  serialized->assign(cdr.data(), cdr.size());
}

void SerializationBase::deserialize_message(const SerializedMessage* serialized,
                                            void* ros_message) const {
  if (!ros_message) throw std::invalid_argument("ROS message is nullpointer.");
  if (!serialized) throw std::invalid_argument("Serialized message is nullpointer.");
  const auto& bytes = serialized->get_rcl_serialized_message();
  if (bytes.buffer_capacity == 0 || bytes.buffer_length == 0 || !bytes.buffer) {
    throw std::invalid_argument("Failed to deserialize nullptr serialized message.");
  }
  try {
    const auto made = type_->decode(bytes.buffer, bytes.buffer_length);
    assign(ros_message, made.get());
  } catch (const gazelle::Error& error) {
    throw exceptions::RCLError(RCL_RET_ERROR, error.what());
  }
}

}  // namespace rclcpp

extern "C" rmw_ret_t rmw_serialize(const void* message, const rosidl_message_type_support_t* type,
                                   rmw_serialized_message_t* serialized) {
  if (!message || !type || !serialized) return RMW_RET_INVALID_ARGUMENT;
  std::vector<std::uint8_t> cdr;
  static_cast<const gazelle::MessageType*>(type->data)->encode(message, cdr);
  if (serialized->buffer_capacity < cdr.size() &&
      rmw_serialized_message_resize(serialized, cdr.size()) != RCUTILS_RET_OK) {
    return RMW_RET_BAD_ALLOC;
  }
  std::memcpy(serialized->buffer, cdr.data(), cdr.size());
  serialized->buffer_length = cdr.size();
  return RMW_RET_OK;
}

extern "C" rmw_ret_t rmw_deserialize(const rmw_serialized_message_t* serialized,
                                     const rosidl_message_type_support_t* type, void* message) {
  if (!message || !type || !serialized) return RMW_RET_INVALID_ARGUMENT;
  const auto* layout = static_cast<const gazelle::MessageType*>(type->data)->layout;
  if (!layout) return RMW_RET_UNSUPPORTED;
  try {
    gazelle::decode_cdr(*layout, message, serialized->buffer, serialized->buffer_length);
  } catch (const gazelle::Error& error) {
    RCUTILS_SET_ERROR_MSG(error.what());
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
}
