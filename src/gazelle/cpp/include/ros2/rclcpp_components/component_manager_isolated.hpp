#pragma once

#include <map>
#include <memory>
#include <thread>

#include "rclcpp/executors.hpp"
#include "rclcpp_components/component_manager.hpp"

namespace rclcpp_components {

/// A container in which each component has an executor and a thread of its own.
template <typename ExecutorT = rclcpp::executors::SingleThreadedExecutor>
class ComponentManagerIsolated : public ComponentManager {
 public:
  using ComponentManager::ComponentManager;
  ~ComponentManagerIsolated() override {
    while (!runs_.empty()) remove_node_from_executor(runs_.begin()->first);
  }

 protected:
  void add_node_to_executor(uint64_t node_id) override {
    auto& run = runs_[node_id];
    run.executor = std::make_shared<ExecutorT>();
    run.executor->add_node(node_wrappers_[node_id].get_node_base_interface());
    run.thread = std::thread([executor = run.executor]() { executor->spin(); });
  }
  void remove_node_from_executor(uint64_t node_id) override {
    const auto found = runs_.find(node_id);
    if (found == runs_.end()) return;
    // The thread may not spin yet.
    while (rclcpp::ok() && !found->second.executor->is_spinning()) {
      rclcpp::sleep_for(std::chrono::milliseconds(1));
    }
    found->second.executor->cancel();
    found->second.thread.join();
    runs_.erase(found);
  }

 private:
  struct Run {
    std::shared_ptr<ExecutorT> executor;
    std::thread thread;
  };
  std::map<uint64_t, Run> runs_;
};

}  // namespace rclcpp_components
