// What a node sees of the graph.
#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <set>
#include <utility>

#include "endpoint_events.hpp"
#include "gazelle/core.hpp"
#include "node_parts.hpp"

namespace rclcpp {
namespace {

using gazelle::Json;
using node_interfaces::NodeBaseInterface;
using node_interfaces::NodeGraphInterface;

std::pair<std::string, std::string> split(const std::string& full) {
  const std::size_t at = full.rfind('/');
  if (at == std::string::npos) return {full, "/"};
  return {full.substr(at + 1), at == 0 ? "/" : full.substr(0, at)};
}

/// Everybody who waits for a change of the graph.
class Changes : public std::enable_shared_from_this<Changes> {
 public:
  void start() {
    std::weak_ptr<Changes> weak = shared_from_this();
    number_ = gazelle::on_graph_change([weak]() {
      if (const auto self = weak.lock()) self->tell();
    });
  }
  ~Changes() {
    if (number_) gazelle::remove_graph_listener(number_);
  }
  void tell() {
    std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& one : events_) {
      if (const auto event = one.lock()) event->set();
    }
    condition_.notify_all();
  }
  Event::SharedPtr event() {
    auto made = std::make_shared<Event>();
    std::lock_guard<std::mutex> lock(mutex_);
    events_.erase(std::remove_if(events_.begin(), events_.end(),
                                 [](const auto& one) { return one.expired(); }),
                  events_.end());
    events_.push_back(made);
    return made;
  }
  void wait(const Event::SharedPtr& event, std::chrono::nanoseconds timeout, Context& context) {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto over = [&]() { return event->check() || !context.is_valid(); };
    if (timeout < std::chrono::nanoseconds(0)) {
      condition_.wait(lock, over);
    } else {
      condition_.wait_for(lock, timeout, over);
    }
  }
  bool knows(const Event::SharedPtr& event) {
    std::lock_guard<std::mutex> lock(mutex_);
    return std::any_of(events_.begin(), events_.end(),
                       [&](const auto& one) { return one.lock() == event; });
  }
  std::size_t users() {
    std::lock_guard<std::mutex> lock(mutex_);
    return events_.size();
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  std::vector<Event::WeakPtr> events_;
  std::uint64_t number_ = 0;
};

class Graph : public NodeGraphInterface {
 public:
  explicit Graph(NodeBaseInterface::SharedPtr base) : base_(std::move(base)) {}
  ~Graph() override {
    if (changes_) base_->get_context()->remove_on_shutdown_callback(ending_);
  }

  NamesAndTypes get_topic_names_and_types(bool) const override {
    return rows(gazelle::call("graph/topics", Json::object({{"ros2", true}, {"hidden", true}})));
  }
  NamesAndTypes get_service_names_and_types() const override {
    return rows(
        gazelle::call("graph/service_types", Json::object({{"ros2", true}, {"hidden", true}})));
  }
  NamesAndTypes get_service_names_and_types_by_node(const std::string& name,
                                                    const std::string& space) const override {
    return of_node("service", name, space);
  }
  NamesAndTypes get_client_names_and_types_by_node(const std::string& name,
                                                   const std::string& space) const override {
    return of_node("client", name, space);
  }
  NamesAndTypes get_publisher_names_and_types_by_node(const std::string& name,
                                                      const std::string& space,
                                                      bool) const override {
    return of_node("publisher", name, space);
  }
  NamesAndTypes get_subscriber_names_and_types_by_node(const std::string& name,
                                                       const std::string& space,
                                                       bool) const override {
    return of_node("subscription", name, space);
  }
  std::vector<std::string> get_node_names() const override {
    return gazelle::call("graph/nodes", Json::object({{"hidden", true}})).as_strings();
  }
  std::vector<std::tuple<std::string, std::string, std::string>> get_node_names_with_enclaves()
      const override {
    std::vector<std::tuple<std::string, std::string, std::string>> found;
    for (const auto& one : get_node_names_and_namespaces()) {
      found.emplace_back(one.first, one.second, "/");
    }
    return found;
  }
  std::vector<std::pair<std::string, std::string>> get_node_names_and_namespaces() const override {
    std::vector<std::pair<std::string, std::string>> found;
    for (const auto& one : get_node_names()) found.push_back(split(one));
    return found;
  }
  std::size_t count_publishers(const std::string& topic) const override {
    return count("publisher", topic, false);
  }
  std::size_t count_subscribers(const std::string& topic) const override {
    return count("subscription", topic, false);
  }
  std::size_t count_clients(const std::string& service) const override {
    return count("client", service, true);
  }
  std::size_t count_services(const std::string& service) const override {
    return count("service", service, true);
  }
  void notify_graph_change() override { changes()->tell(); }
  Event::SharedPtr get_graph_event() override { return changes()->event(); }
  void wait_for_graph_change(Event::SharedPtr event, std::chrono::nanoseconds timeout) override {
    if (!event) throw exceptions::InvalidEventError();
    if (!changes()->knows(event)) throw exceptions::EventNotRegisteredError();
    changes()->wait(event, timeout, *base_->get_context());
  }
  std::size_t count_graph_users() const override {
    std::lock_guard<std::mutex> lock(mutex_);
    return changes_ ? changes_->users() : 0;
  }
  std::vector<TopicEndpointInfo> get_publishers_info_by_topic(const std::string& topic,
                                                              bool) const override {
    return ends("publisher", topic, EndpointType::Publisher);
  }
  std::vector<TopicEndpointInfo> get_subscriptions_info_by_topic(const std::string& topic,
                                                                 bool) const override {
    return ends("subscription", topic, EndpointType::Subscription);
  }

 private:
  static NamesAndTypes rows(const Json& found) {
    NamesAndTypes names;
    for (const auto& one : found.items()) {
      auto& types = names[one[0].as_string()];
      const std::string type = one[1].as_string();
      if (std::find(types.begin(), types.end(), type) == types.end()) types.push_back(type);
    }
    return names;
  }

  NamesAndTypes of_node(const char* kind, const std::string& name, const std::string& space) const {
    const std::string full = (space == "/" ? "" : space) + "/" + name;
    const auto nodes = get_node_names();
    if (std::find(nodes.begin(), nodes.end(), full) == nodes.end()) {
      throw exceptions::RCLError(RCL_RET_NODE_NAME_NON_EXISTENT,
                                 "cannot get names and types: "
                                 "node '" +
                                     full + "' does not exist");
    }
    NamesAndTypes names;
    for (const auto& end :
         gazelle::call("graph/ends", Json::object({{"kind", kind}, {"node", full}})).items()) {
      names[end["name"].as_string()].push_back(end["type"].as_string());
    }
    return names;
  }

  std::size_t count(const char* kind, const std::string& name, bool is_service) const {
    const std::string full = base_->resolve_topic_or_service_name(name, is_service, true);
    return static_cast<std::size_t>(
        gazelle::call("graph/count", Json::object({{"kind", kind}, {"name", full}})).as_int());
  }

  std::vector<TopicEndpointInfo> ends(const char* kind, const std::string& topic,
                                      EndpointType type) const {
    const std::string full = base_->resolve_topic_or_service_name(topic, false, false);
    std::vector<TopicEndpointInfo> found;
    for (const auto& end :
         gazelle::call("graph/ends", Json::object({{"kind", kind}, {"name", full}})).items()) {
      const auto node = split(end["node"].as_string());
      std::array<uint8_t, RMW_GID_STORAGE_SIZE> gid{};
      const std::string hex = end["gid"].as_string();
      for (std::size_t i = 0; i < gid.size() && 2 * i + 1 < hex.size(); ++i) {
        gid[i] = static_cast<uint8_t>(std::stoul(hex.substr(2 * i, 2), nullptr, 16));
      }
      found.emplace_back(node.first, node.second, end["type"].as_string(), type, gid,
                         detail::qos_of_end(end["qos"]));
    }
    return found;
  }

  std::shared_ptr<Changes> changes() {
    std::lock_guard<std::mutex> lock(mutex_);
    if (!changes_) {
      changes_ = std::make_shared<Changes>();
      changes_->start();
      std::weak_ptr<Changes> weak = changes_;
      ending_ = base_->get_context()->add_on_shutdown_callback([weak]() {
        if (const auto self = weak.lock()) self->tell();
      });
    }
    return changes_;
  }

  NodeBaseInterface::SharedPtr base_;
  mutable std::mutex mutex_;
  std::shared_ptr<Changes> changes_;
  OnShutdownCallbackHandle ending_;
};

}  // namespace

namespace detail {

NodeGraphInterface::SharedPtr make_graph(NodeBaseInterface::SharedPtr base) {
  return std::make_shared<Graph>(std::move(base));
}

}  // namespace detail
}  // namespace rclcpp
