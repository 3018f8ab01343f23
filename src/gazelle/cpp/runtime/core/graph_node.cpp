#include <utility>

#include "crash_handler.hpp"
#include "gazelle/core.hpp"
#include "host.hpp"
#include "listeners.hpp"
#include "registry.hpp"
#include "services.hpp"
#include "topics.hpp"

namespace gazelle {

namespace {

Json json_of(const Qos& qos) {
  return Json::object({{"depth", qos.keep_all ? std::size_t{0} : qos.depth},
                       {"reliable", qos.reliable},
                       {"latched", qos.transient_local},
                       {"deadline_ns", qos.deadline_ns},
                       {"lifespan_ns", qos.lifespan_ns},
                       {"manual", qos.manual_liveliness},
                       {"lease_ns", qos.lease_ns}});
}

class Node;

Registry<Node>& nodes() {
  static auto* all = new Registry<Node>;
  return *all;
}

class Node final : public GraphNode {
 public:
  ~Node() override { shutdown(); }

  void open(const NodeOptions& options) {
    number_ = nodes().add(std::static_pointer_cast<Node>(shared_from_this()));
    ros_version_ = options.ros_version;
    Json::Array remappings;
    for (const auto& one : options.remappings) {
      remappings.push_back(Json::array({one.first, one.second}));
    }
    details_ =
        call("node/create", Json::object({{"core", number_},
                                          {"name", options.name},
                                          {"namespace", options.namespace_},
                                          {"ros_version", options.ros_version},
                                          {"anonymous", options.anonymous},
                                          {"rosout", options.rosout},
                                          {"use_global_arguments", options.use_global_arguments},
                                          {"arguments", options.arguments},
                                          {"remappings", remappings}}));
    closed_ = details_.is_null();
    handle_ = static_cast<std::uint64_t>(details_["handle"].as_int());
    name_ = details_["name"].as_string(options.name);
    namespace_name_ = details_["namespace"].as_string("/");
    full_name_ = details_["full_name"].as_string("/" + options.name);
    leave_graph_at_exit();
  }

  std::uint64_t handle() const override { return handle_; }
  const std::string& name() const override { return name_; }
  const std::string& namespace_() const override { return namespace_name_; }
  const std::string& full_name() const override { return full_name_; }
  int ros_version() const override { return ros_version_; }
  const Json& details() const override { return details_; }

  std::string resolve(const std::string& name, bool remap) const override {
    return call("node/resolve", Json::object({{"node", handle_}, {"name", name}, {"remap", remap}}))
        .as_string(name);
  }

  std::shared_ptr<Publisher> advertise(const std::string& topic, const MessageType& type,
                                       const Qos& qos, const PublisherOptions& options) override {
    return advertised(topic, type.name, type.hash, type.definition, qos, options, &type);
  }

  std::shared_ptr<Publisher> advertise(const std::string& topic, const std::string& type_name,
                                       const std::string& definition, const Qos& qos,
                                       const PublisherOptions& options) override {
    Json request = Json::object(
        {{"topic", topic}, {"type", type_name}, {"definition", definition}, {"qos", json_of(qos)}});
    auto end = std::make_shared<PublisherEnd>(handle_, full_name_, qos, options, nullptr);
    end->open(std::move(request));
    return end;
  }

  std::shared_ptr<Subscription> subscribe(const std::string& topic, const MessageType* type,
                                          const Qos& qos, std::function<void(Delivered)> function,
                                          const SubscriptionOptions& options) override {
    return subscribed(topic, type != nullptr ? type->name : "", type, qos, std::move(function),
                      options);
  }

  std::shared_ptr<Subscription> subscribe(const std::string& topic, const std::string& type_name,
                                          const Qos& qos, std::function<void(Delivered)> function,
                                          const SubscriptionOptions& options) override {
    return subscribed(topic, type_name, nullptr, qos, std::move(function), options);
  }

  std::shared_ptr<ServiceServer> offer(const std::string& service, const ServiceType& type,
                                       std::function<void(RequestId, Bytes)> handler) override {
    auto end = std::make_shared<ServerEnd>(std::move(handler));
    end->open(request_of(service, type));
    return end;
  }

  std::shared_ptr<ServiceClient> client(const std::string& service,
                                        const ServiceType& type) override {
    auto end = std::make_shared<ClientEnd>();
    end->open(request_of(service, type));
    return end;
  }

  void log(Level level, const std::string& text, const std::string& logger, const char* file,
           int line, const char* function) override {
    if (const gazelle_host* host = host::table()) {
      host->log(handle_, static_cast<int>(level), text.data(), text.size(), logger.c_str(), file,
                line, function);
    }
  }

  void on_shutdown(std::function<void(const std::string&)> listener) override {
    shutdown_.add(std::move(listener));
  }

  void shutdown() override {
    nodes().remove(number_);
    if (!closed_.exchange(true)) {
      host::call_at_end("node/shutdown", Json::object({{"node", handle_}}));
    }
  }

  bool closed() const override { return closed_; }

  void on_shut_down(const std::string& reason) { shutdown_.tell(reason); }

 private:
  std::shared_ptr<Publisher> advertised(const std::string& topic, const char* name,
                                        const char* hash, const char* (*definition)(),
                                        const Qos& qos, const PublisherOptions& options,
                                        const MessageType* type) {
    auto end = std::make_shared<PublisherEnd>(handle_, full_name_, qos, options, type);
    end->open(typed(topic, name, hash, definition, type->is_ros1, qos));
    return end;
  }

  std::shared_ptr<Subscription> subscribed(const std::string& topic, const std::string& name,
                                           const MessageType* type, const Qos& qos,
                                           std::function<void(Delivered)> function,
                                           const SubscriptionOptions& options) {
    auto end = std::make_shared<SubscriptionEnd>(handle_, full_name_, type, qos,
                                                 std::move(function), options);
    Json request = type != nullptr
                       ? typed(topic, type->name, type->hash, type->definition, type->is_ros1, qos)
                       : Json::object({{"topic", topic}, {"type", name}, {"qos", json_of(qos)}});
    request.set("announced", options.announced_type);
    end->open(std::move(request));
    // The topic keeps the end while it lasts; whoever holds this decides how long that is.
    Subscription* face = end.get();
    return {face, [end](Subscription*) { end->close(); }};
  }

  static Json typed(const std::string& topic, const char* name, const char* hash,
                    const char* (*definition)(), bool is_ros1, const Qos& qos) {
    Json request = Json::object({{"topic", topic},
                                 {"type", name},
                                 {"hash", hash != nullptr ? hash : ""},
                                 {"is_ros1", is_ros1},
                                 {"qos", json_of(qos)}});
    (void)definition;
    return request;
  }

  Json request_of(const std::string& service, const ServiceType& type) const {
    return Json::object({{"node", handle_},
                         {"name", service},
                         {"type", type.name},
                         {"hash", type.hash != nullptr ? type.hash : ""}});
  }

  std::uint64_t number_ = 0;
  std::uint64_t handle_ = 0;
  int ros_version_ = 1;
  std::string name_;
  std::string namespace_name_;
  std::string full_name_;
  Json details_;
  std::atomic<bool> closed_{true};
  Listeners<const std::string&> shutdown_;
};

}  // namespace

std::shared_ptr<GraphNode> GraphNode::create(const NodeOptions& options) {
  auto node = std::make_shared<Node>();
  node->open(options);
  return node;
}

std::vector<std::string> set_arguments(int ros_version, const std::vector<std::string>& arguments) {
  return call("node/arguments",
              Json::object({{"ros_version", ros_version}, {"arguments", arguments}}))
      .as_strings();
}

void log(Level level, const std::string& text, const std::string& logger, const char* file,
         int line, const char* function) {
  if (const gazelle_host* host = host::table()) {
    host->log(0, static_cast<int>(level), text.data(), text.size(), logger.c_str(), file, line,
              function);
  }
}

}  // namespace gazelle

extern "C" GAZELLE_EXPORT void gazelle_on_node_shutdown(std::uint64_t node, const char* reason) {
  if (const auto found = gazelle::nodes().find(node)) found->on_shut_down(reason);
}
