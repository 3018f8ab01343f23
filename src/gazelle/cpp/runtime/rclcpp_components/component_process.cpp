// Components without a container of C++: programs of one, and those in a container of Python's.
#include <csignal>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "component_requests.hpp"
#include "gazelle/cdr.hpp"
#include "gazelle/class_registry.hpp"
#include "gazelle/component_main.hpp"
#include "gazelle/core.hpp"
#include "rclcpp/executors.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/utilities.hpp"

namespace {

using rclcpp_components::NodeFactory;
using rclcpp_components::NodeInstanceWrapper;

std::shared_ptr<rclcpp::Executor> executor_named(const std::string& name) {
  if (name.find("Multi") != std::string::npos) {
    return std::make_shared<rclcpp::executors::MultiThreadedExecutor>();
  }
  return std::make_shared<rclcpp::executors::SingleThreadedExecutor>();
}

/// The components of C++ in a process whose container is Python's.
class Process {
 public:
  explicit Process(std::string kind) : kind_(std::move(kind)) {
    const char* const argv[] = {"component_container", nullptr};
    rclcpp::InitOptions options;
    options.shutdown_on_signal = false;
    rclcpp::init(1, argv, options, rclcpp::SignalHandlerOptions::None);
    if (kind_ != "isolated") run(shared_);
  }

  struct Run {
    std::shared_ptr<rclcpp::Executor> executor;
    std::thread thread;
  };

  void run(Run& run) {
    run.executor = executor_named(kind_ == "mt" ? "MultiThreadedExecutor" : "");
    run.thread = std::thread([executor = run.executor]() { executor->spin(); });
  }

  void end(Run& run) {
    while (rclcpp::ok() && !run.executor->is_spinning()) {
      rclcpp::sleep_for(std::chrono::milliseconds(1));
    }
    run.executor->cancel();
    run.thread.join();
  }

  std::string load(std::uint64_t id, const std::string& library, const std::string& plugin,
                   const composition_interfaces::srv::LoadNode::Request& request) {
    const auto factory = rclcpp_components::factory_of({plugin, library});
    if (!factory) {
      throw gazelle::Error("Failed to find class with the requested plugin name '" + plugin +
                           "' in the loaded library");
    }
    NodeInstanceWrapper made;
    try {
      made = factory->create_node_instance(rclcpp_components::options_of(request));
    } catch (const std::exception& error) {
      throw gazelle::Error(std::string("Component constructor threw an exception: ") +
                           error.what());
    } catch (...) {
      throw gazelle::Error("Component constructor threw an exception");
    }
    const auto base = made.get_node_base_interface();
    std::lock_guard<std::mutex> lock(mutex_);
    nodes_[id] = std::move(made);
    if (kind_ == "isolated") run(own_[id]);
    (kind_ == "isolated" ? own_[id] : shared_).executor->add_node(base);
    return base->get_fully_qualified_name();
  }

  bool unload(std::uint64_t id) {
    std::lock_guard<std::mutex> lock(mutex_);
    const auto found = nodes_.find(id);
    if (found == nodes_.end()) return false;
    const auto own = own_.find(id);
    if (own != own_.end()) {
      end(own->second);
      own_.erase(own);
    } else {
      shared_.executor->remove_node(found->second.get_node_base_interface());
    }
    nodes_.erase(found);
    return true;
  }

  void stop() {
    std::lock_guard<std::mutex> lock(mutex_);
    rclcpp::shutdown(nullptr, "the container ends");
    for (auto& one : own_) end(one.second);
    if (shared_.executor) end(shared_);
    nodes_.clear();
  }

 private:
  const std::string kind_;
  std::mutex mutex_;
  Run shared_;
  std::map<std::uint64_t, Run> own_;
  std::map<std::uint64_t, NodeInstanceWrapper> nodes_;
};

Process* process = nullptr;

using Sink = void (*)(void* context, const std::uint8_t* data, std::size_t size);

void tell(Sink sink, void* context, const std::string& text) {
  sink(context, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

// For gazelle.cpp.component_host (Python): texts go through the sink, 0 is success.
extern "C" {

GAZELLE_EXPORT int gazelle_components_start(const char* kind, Sink sink, void* context) {
  try {
    if (!process) process = new Process(kind);
    return 0;
  } catch (const std::exception& error) {
    tell(sink, context, error.what());
    return 1;
  }
}

/// `request` is a LoadNode request as CDR. The sink gets the node's full name, or why not.
GAZELLE_EXPORT int gazelle_components_load(std::uint64_t id, const char* library,
                                           const char* plugin, const std::uint8_t* request,
                                           std::size_t size, Sink sink, void* context) {
  try {
    composition_interfaces::srv::LoadNode::Request read;
    gazelle::from_cdr(read, request, size);
    tell(sink, context, process->load(id, library, plugin, read));
    return 0;
  } catch (const std::exception& error) {
    tell(sink, context, error.what());
    return 1;
  }
}

GAZELLE_EXPORT int gazelle_components_unload(std::uint64_t id) {
  return process && process->unload(id) ? 0 : 1;
}

GAZELLE_EXPORT void gazelle_components_stop() {
  if (process) process->stop();
}

}  // extern "C"

namespace gazelle {

int component_main(int argc, char** argv, const char* plugin, const char* executor_name) {
  const auto words = rclcpp::init_and_remove_ros_arguments(argc, argv);
  const auto executor = executor_named(executor_name);
  rclcpp::NodeOptions options;
  options.arguments(words);
  const std::string base = typeid(NodeFactory).name();
  const std::string wanted = rclcpp_components::class_of({plugin, ""});
  auto& registry = ClassRegistry::instance();
  if (!registry.has(wanted, base)) {
    RCLCPP_FATAL(rclcpp::get_logger(executor_name), "no library of this program registers '%s'",
                 plugin);
    return 1;
  }
  std::unique_ptr<NodeFactory> factory(static_cast<NodeFactory*>(registry.create(wanted, base)));
  auto wrapper = factory->create_node_instance(options);
  const auto node = wrapper.get_node_base_interface();
  executor->add_node(node);
  executor->spin();
  executor->remove_node(node);
  rclcpp::shutdown();
  return 0;
}

}  // namespace gazelle
