#include "topics.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "host.hpp"
#include "registry.hpp"

namespace gazelle {

namespace {

Registry<PublisherEnd>& publishers() {
  static auto* all = new Registry<PublisherEnd>;
  return *all;
}

Registry<SubscriptionEnd>& subscriptions() {
  static auto* all = new Registry<SubscriptionEnd>;
  return *all;
}

// The subscriptions whose function this thread is in: one that closes itself waits for nobody.
thread_local std::vector<const SubscriptionEnd*> running_here;

struct Running {
  explicit Running(const SubscriptionEnd* one) { running_here.push_back(one); }
  ~Running() { running_here.pop_back(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
};

int digit(char character) {
  return character <= '9' ? character - '0' : (character | 0x20) - 'a' + 10;
}

std::array<std::uint8_t, 16> gid_of(const std::string& text) {
  std::array<std::uint8_t, 16> gid{};
  for (std::size_t i = 0; i < gid.size() && 2 * i + 1 < text.size(); ++i) {
    gid[i] = static_cast<std::uint8_t>(digit(text[2 * i]) << 4 | digit(text[2 * i + 1]));
  }
  return gid;
}

void replace(LocalTopic& topic, SubscriptionEnds ends) {
  std::atomic_store_explicit(
      &topic.subscriptions,
      std::shared_ptr<const SubscriptionEnds>(std::make_shared<SubscriptionEnds>(std::move(ends))),
      std::memory_order_release);
}

}  // namespace

std::shared_ptr<LocalTopic> local_topic(const std::string& name) {
  static auto* mutex = new std::mutex;
  static auto* topics = new std::unordered_map<std::string, std::shared_ptr<LocalTopic>>;
  std::lock_guard lock(*mutex);
  auto& found = (*topics)[name];
  if (!found) found = std::make_shared<LocalTopic>();
  return found;
}

// ---- Publishers ---------------------------------------------------------------------------------

PublisherEnd::PublisherEnd(std::uint64_t node, std::string node_name, const Qos& qos,
                           const PublisherOptions& options, const MessageType* type)
    : node_(node),
      node_name_(std::move(node_name)),
      qos_(qos),
      options_(options),
      type_(type),
      latched_(options.latch || qos.transient_local) {}

void PublisherEnd::open(Json request) {
  number_ = publishers().add(weak_from_this());
  request.set("node", node_).set("core", number_).set("latch", latched_);
  const Json made = call("topic/advertise", request);
  if (made.is_null()) return;  // the graph is left: what is published goes nowhere
  handle_ = static_cast<std::uint64_t>(made["handle"].as_int());
  topic_ = made["topic"].as_string();
  type_name_ = made["type"].as_string();
  gid_ = gid_of(made["gid"].as_string());
  local_ = local_topic(topic_);
  std::lock_guard lock(local_->mutex);
  local_->publishers.push_back(this);
  closed_ = false;
}

MessageInfo PublisherEnd::next_info() {
  MessageInfo info;
  info.sequence = sequence_.fetch_add(1) + 1;
  info.stamp_ns = clock::wall_ns();
  info.gid = gid_;
  info.publisher = node_name_;
  info.is_local = true;
  return info;
}

void PublisherEnd::publish(std::shared_ptr<const void> message, const MessageType& type) {
  if (closed() || !message) return;
  if (!latched_ && local_->listeners()->empty()) {
    if (is_wanted_elsewhere_.load(std::memory_order_relaxed)) {
      send(message.get(), type, next_info());
    } else {
      sequence_.fetch_add(1);
    }
    return;
  }
  deliver(Delivered(std::move(message), &type, next_info()));
}

void PublisherEnd::publish_copy(const void* message, const MessageType& type,
                                std::shared_ptr<const void> (*copy)(const void*)) {
  if (closed()) return;
  const bool is_kept = latched_ || !local_->listeners()->empty();
  if (!is_kept) {
    if (is_wanted_elsewhere_.load(std::memory_order_relaxed)) {
      send(message, type, next_info());
    } else {
      sequence_.fetch_add(1);
    }
    return;
  }
  if (copy != nullptr) {
    deliver(Delivered(copy(message), &type, next_info()));
    return;
  }
  std::vector<std::uint8_t> bytes;
  type.encode(message, bytes);
  deliver(Delivered(Bytes(std::move(bytes)), type.name, next_info()));
}

void PublisherEnd::publish_cdr(Bytes cdr) {
  if (closed()) return;
  deliver(Delivered(std::move(cdr), type_name_, next_info()));
}

void PublisherEnd::deliver(const Delivered& message) {
  if (!latched_) {
    hand(message, *local_->listeners());
    if (is_wanted_elsewhere_.load(std::memory_order_relaxed)) send(message);
    return;
  }
  // Of two threads that publish, here and elsewhere the same one has the last word.
  std::lock_guard turn(latching_);
  std::shared_ptr<const SubscriptionEnds> subscriptions;
  {
    std::lock_guard lock(local_->mutex);
    last_ = message;
    subscriptions = local_->listeners();
  }
  hand(message, *subscriptions);
  send(message);
}

void PublisherEnd::hand(const Delivered& message, const SubscriptionEnds& subscriptions) const {
  for (const auto& one : subscriptions) {
    if (one->takes(message.type_name(), node_name_)) one->take(message);
  }
}

void PublisherEnd::hand_latched(SubscriptionEnd& subscription) const {
  if (last_ && subscription.takes(last_->type_name(), node_name_)) subscription.take(*last_);
}

void PublisherEnd::send(const Delivered& message) {
  const Bytes bytes = message.cdr();
  send_bytes(bytes.data(), bytes.size(), message.info());
}

void PublisherEnd::send(const void* message, const MessageType& type, const MessageInfo& info) {
  // Kept by the thread: a large message then meets memory that is there already.
  static thread_local std::vector<std::uint8_t> bytes;
  type.encode(message, bytes);
  send_bytes(bytes.data(), bytes.size(), info);
}

void PublisherEnd::send_bytes(const std::uint8_t* data, std::size_t size, const MessageInfo& info) {
  if (const gazelle_host* host = host::table()) {
    host->publish(handle_, data, size, static_cast<std::int64_t>(info.sequence), info.stamp_ns);
  }
}

std::size_t PublisherEnd::subscription_count() const { return count_.load(); }

std::size_t PublisherEnd::local_subscription_count() const {
  return closed() ? 0 : local_->listeners()->size();
}

bool PublisherEnd::wanted() const {
  return !closed() && (latched_ || is_wanted_elsewhere_.load() || !local_->listeners()->empty());
}

void PublisherEnd::on_matched(std::size_t count, bool is_wanted_elsewhere) {
  is_wanted_elsewhere_ = is_wanted_elsewhere;
  if (count_.exchange(count) != count && options_.matched) options_.matched(count);
}

void PublisherEnd::on_subscriber(const std::string& node, bool is_there) {
  if (options_.subscriber_changed) options_.subscriber_changed(node, is_there);
}

void PublisherEnd::close() {
  publishers().remove(number_);
  if (closed_.exchange(true)) return;
  {
    std::lock_guard lock(local_->mutex);
    auto& all = local_->publishers;
    all.erase(std::remove(all.begin(), all.end(), this), all.end());
  }
  host::call_at_end("end/close", Json::object({{"handle", handle_}}));
}

// ---- Subscriptions ------------------------------------------------------------------------------

SubscriptionEnd::SubscriptionEnd(std::uint64_t node, std::string node_name, const MessageType* type,
                                 const Qos& qos, std::function<void(Delivered)> function,
                                 const SubscriptionOptions& options)
    : node_(node),
      node_name_(std::move(node_name)),
      type_(type),
      qos_(qos),
      function_(std::move(function)),
      options_(options) {}

void SubscriptionEnd::open(Json request) {
  number_ = subscriptions().add(weak_from_this());
  request.set("node", node_).set("core", number_).set("latched", options_.latched);
  // What comes before the verb has returned is taken already.
  type_name_ = request["type"].as_string();
  closed_ = false;
  Json made;
  try {
    made = call("topic/subscribe", request);
  } catch (...) {
    closed_ = true;
    throw;
  }
  if (made.is_null()) {
    closed_ = true;
    return;
  }
  handle_ = static_cast<std::uint64_t>(made["handle"].as_int());
  topic_ = made["topic"].as_string();
  local_ = local_topic(topic_);
  std::lock_guard lock(local_->mutex);
  if (options_.latched) {
    for (const PublisherEnd* one : local_->publishers) one->hand_latched(*this);
  }
  SubscriptionEnds ends = *local_->listeners();
  ends.push_back(shared_from_this());
  replace(*local_, std::move(ends));
}

bool SubscriptionEnd::takes(const std::string& type_name, const std::string& node_name) {
  if (options_.ignore_local && node_name == node_name_) return false;
  if (type_name_.empty() || type_name_ == type_name) return true;
  {
    std::lock_guard lock(refused_mutex_);
    if (!refused_.insert(type_name).second) return false;
  }
  call("topic/refuse",
       Json::object(
           {{"node", node_}, {"topic", topic_}, {"wanted", type_name_}, {"type", type_name}}));
  return false;
}

void SubscriptionEnd::take(Delivered message) {
  std::shared_lock lock(running_, std::defer_lock);
  const bool is_inside =
      std::find(running_here.begin(), running_here.end(), this) != running_here.end();
  if (!is_inside) lock.lock();
  if (closed_.load(std::memory_order_acquire)) return;
  const Running here(this);
  function_(std::move(message));
}

void SubscriptionEnd::on_matched(std::size_t count) {
  if (count_.exchange(count) != count && options_.matched) options_.matched(count);
}

void SubscriptionEnd::close() {
  subscriptions().remove(number_);
  if (closed_.exchange(true)) return;
  if (local_) {
    std::lock_guard lock(local_->mutex);
    SubscriptionEnds ends = *local_->listeners();
    const auto mine = std::find_if(ends.begin(), ends.end(),
                                   [this](const auto& one) { return one.get() == this; });
    if (mine != ends.end()) ends.erase(mine);
    replace(*local_, std::move(ends));
  }
  host::call_at_end("end/close", Json::object({{"handle", handle_}}));
  if (std::find(running_here.begin(), running_here.end(), this) == running_here.end()) {
    std::unique_lock wait(running_);
  }
}

}  // namespace gazelle

extern "C" {

GAZELLE_EXPORT void gazelle_on_message(std::uint64_t subscription, const std::uint8_t* cdr,
                                       std::size_t size, void* owner, const char* type_name,
                                       std::int64_t sequence, std::int64_t stamp_ns,
                                       const std::uint8_t* gid, const char* publisher) {
  using namespace gazelle;  // NOLINT: the whole of it is ours
  Bytes bytes = host::lent(cdr, size, owner);
  const auto end = subscriptions().find(subscription);
  if (!end) return;
  MessageInfo info;
  info.sequence = static_cast<std::uint64_t>(sequence);
  info.stamp_ns = stamp_ns;
  std::copy(gid, gid + info.gid.size(), info.gid.begin());
  info.publisher = publisher;
  end->take(Delivered(std::move(bytes), type_name, std::move(info)));
}

GAZELLE_EXPORT void gazelle_on_matched(std::uint64_t end, std::uint64_t count,
                                       int is_wanted_elsewhere) {
  using namespace gazelle;  // NOLINT
  // One number for both kinds: those of subscriptions come with -1.
  if (is_wanted_elsewhere < 0) {
    if (const auto found = subscriptions().find(end)) found->on_matched(count);
  } else if (const auto found = publishers().find(end)) {
    found->on_matched(count, is_wanted_elsewhere != 0);
  }
}

GAZELLE_EXPORT void gazelle_on_subscriber(std::uint64_t publisher, const char* node, int is_there) {
  using namespace gazelle;  // NOLINT
  if (const auto found = publishers().find(publisher)) found->on_subscriber(node, is_there != 0);
}

}  // extern "C"
