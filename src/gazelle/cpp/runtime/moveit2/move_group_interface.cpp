// MoveGroupInterface and PlanningSceneInterface of ROS 2.
#include "moveit/move_group_interface/move_group_interface.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "gazelle/core.hpp"
#include "moveit/planning_scene_interface/planning_scene_interface.hpp"
#include "moveit_msgs/action/execute_trajectory.hpp"
#include "moveit_msgs/action/move_group.hpp"
#include "moveit_msgs/msg/planning_scene_components.hpp"
#include "moveit_msgs/srv/apply_planning_scene.hpp"
#include "moveit_msgs/srv/get_cartesian_path.hpp"
#include "moveit_msgs/srv/get_planning_scene.hpp"
#include "rcl_interfaces/srv/get_parameters.hpp"
#include "rclcpp_action/rclcpp_action.hpp"
#include "std_msgs/msg/string.hpp"

namespace moveit {
namespace planning_interface {

constexpr double kServiceWaitS = 60.0;

static std::string joined(const std::string& ns, const std::string& name) {
  return ns.empty() ? name : ns + (ns.back() == '/' ? "" : "/") + name;
}

// A pose that is aimed at, or one part of it.
struct Aim {
  msgs::geo::PoseStamped pose;
  bool has_position, has_orientation;
};

// The way to move_group: callbacks run in a thread of their own, so the user's node need not spin.
class Link {
 public:
  using Move = moveit_msgs::action::MoveGroup;
  using Execute = moveit_msgs::action::ExecuteTrajectory;
  using MoveGoal = Move::Goal;
  using MoveResult = Move::Result;
  using CartesianRequest = moveit_msgs::srv::GetCartesianPath::Request;
  using CartesianResponse = moveit_msgs::srv::GetCartesianPath::Response;
  using SceneRequest = moveit_msgs::srv::GetPlanningScene::Request;
  using SceneResponse = moveit_msgs::srv::GetPlanningScene::Response;

  Link(rclcpp::Node::SharedPtr node, const std::string& ns) : node_(std::move(node)), ns_(ns) {
    group_ = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
    executor_.add_callback_group(group_, node_->get_node_base_interface());
    rclcpp::SubscriptionOptions options;
    options.callback_group = group_;
    states_ = node_->create_subscription<msgs::sen::JointState>(
        "joint_states", rclcpp::SensorDataQoS(),
        [this](msgs::sen::JointState::ConstSharedPtr message) { take(*message); }, options);
    events_ = node_->create_publisher<std_msgs::msg::String>(
        joined(ns_, "trajectory_execution_event"), 1);
    mover_ = rclcpp_action::create_client<Move>(node_, joined(ns_, "move_action"), group_);
    executor_client_ =
        rclcpp_action::create_client<Execute>(node_, joined(ns_, "execute_trajectory"), group_);
    thread_ = std::thread([this]() { executor_.spin(); });
  }
  ~Link() {
    executor_.cancel();
    if (thread_.joinable()) thread_.join();
  }

  void wait_for_servers(double seconds) {
    const auto limit = std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
    const bool there = seconds < 0.0 ? mover_->wait_for_action_server() &&
                                           executor_client_->wait_for_action_server()
                                     : mover_->wait_for_action_server(limit) &&
                                           executor_client_->wait_for_action_server(limit);
    if (!there) throw std::runtime_error("Unable to connect to move_group action server");
  }

  bool move(const MoveGoal& goal, MoveResult* result) { return send<Move>(mover_, goal, result); }

  bool execute(const msgs::mv::RobotTrajectory& trajectory, msgs::mv::MoveItErrorCodes* code) {
    Execute::Goal goal;
    goal.trajectory = trajectory;
    Execute::Result result;
    if (!send<Execute>(executor_client_, goal, code == nullptr ? nullptr : &result)) return false;
    if (code != nullptr) *code = result.error_code;
    return true;
  }

  void stop() {
    std_msgs::msg::String event;
    event.data = "stop";
    events_->publish(event);
    mover_->async_cancel_all_goals();
    executor_client_->async_cancel_all_goals();
  }

  bool cartesian(const CartesianRequest& request, CartesianResponse& response) {
    return call<moveit_msgs::srv::GetCartesianPath>("compute_cartesian_path", request, response);
  }
  bool scene(const SceneRequest& request, SceneResponse& response) {
    return call<moveit_msgs::srv::GetPlanningScene>("get_planning_scene", request, response);
  }
  bool apply(const msgs::mv::PlanningScene& scene) {
    moveit_msgs::srv::ApplyPlanningScene::Request request;
    request.scene = scene;
    moveit_msgs::srv::ApplyPlanningScene::Response response;
    return call<moveit_msgs::srv::ApplyPlanningScene>("apply_planning_scene", request, response) &&
           response.success;
  }

  // Positions by joint, once all that are needed are known.
  bool positions(const std::vector<std::string>& needed, double wait_s,
                 std::map<std::string, double>& found) {
    std::unique_lock<std::mutex> lock(mutex_);
    const bool complete = changed_.wait_for(lock, std::chrono::duration<double>(wait_s), [&]() {
      return std::all_of(needed.begin(), needed.end(),
                         [this](const std::string& name) { return positions_.count(name) != 0; });
    });
    found = positions_;
    return complete;
  }
  builtin_interfaces::msg::Time now() const { return node_->now(); }

  // The text of a description: the node's parameter, a latched topic, or move_group's parameter.
  std::string description(const std::string& name) {
    std::string text;
    if (node_->has_parameter(name) && node_->get_parameter(name, text) && !text.empty()) {
      return text;
    }
    rcl_interfaces::srv::GetParameters::Request request;
    request.names.push_back(name);
    rcl_interfaces::srv::GetParameters::Response response;
    if (call<rcl_interfaces::srv::GetParameters>("move_group/get_parameters", request, response) &&
        !response.values.empty() && !response.values.front().string_value.empty()) {
      return response.values.front().string_value;
    }
    return of_topic(name);
  }

 private:
  template <class Service>
  bool call(const std::string& name, const typename Service::Request& request,
            typename Service::Response& response) {
    auto client = node_->create_client<Service>(joined(ns_, name), rclcpp::ServicesQoS(), group_);
    if (!client->wait_for_service(std::chrono::duration<double>(kServiceWaitS))) return false;
    auto future = client->async_send_request(std::make_shared<typename Service::Request>(request));
    if (future.wait_for(std::chrono::duration<double>(kServiceWaitS)) !=
        std::future_status::ready) {
      return false;
    }
    response = *future.get();
    return true;
  }

  // With a result the end is waited for.
  template <class Action>
  bool send(const typename rclcpp_action::Client<Action>::SharedPtr& client,
            const typename Action::Goal& goal, typename Action::Result* result) {
    if (!client->action_server_is_ready()) {
      RCLCPP_INFO_STREAM(node_->get_logger(), "action client/server not ready");
      return false;
    }
    auto sent = client->async_send_goal(goal);
    const auto handle = wait(sent);
    if (!handle) {
      RCLCPP_INFO(node_->get_logger(), "Planning request rejected");
      return false;
    }
    if (result == nullptr) return true;
    auto ended = client->async_get_result(handle);
    while (ended.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) {
      if (!rclcpp::ok()) return false;
    }
    const auto wrapped = ended.get();
    *result = *wrapped.result;
    return true;
  }
  template <class Future>
  std::decay_t<decltype(std::declval<Future&>().get())> wait(Future& future) {
    while (future.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) {
      if (!rclcpp::ok()) return nullptr;
    }
    return future.get();
  }

  void take(const msgs::sen::JointState& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t i = 0; i < message.name.size() && i < message.position.size(); ++i) {
      positions_[message.name[i]] = message.position[i];
    }
    changed_.notify_all();
  }
  std::string of_topic(const std::string& name) {
    std::string text;
    std::mutex mutex;
    std::condition_variable came;
    rclcpp::SubscriptionOptions options;
    options.callback_group = group_;
    const auto subscription = node_->create_subscription<std_msgs::msg::String>(
        name, rclcpp::QoS(1).transient_local().reliable(),
        [&](std_msgs::msg::String::ConstSharedPtr message) {
          const std::lock_guard<std::mutex> lock(mutex);
          text = message->data;
          came.notify_all();
        },
        options);
    std::unique_lock<std::mutex> lock(mutex);
    came.wait_for(lock, std::chrono::seconds(10), [&]() { return !text.empty(); });
    return text;
  }

  rclcpp::Node::SharedPtr node_;
  std::string ns_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::executors::SingleThreadedExecutor executor_;
  rclcpp::Subscription<msgs::sen::JointState>::SharedPtr states_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr events_;
  rclcpp_action::Client<Move>::SharedPtr mover_;
  rclcpp_action::Client<Execute>::SharedPtr executor_client_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, double> positions_;
  std::thread thread_;
};

#include "gazelle/moveit/move_group_core_body.inc"

namespace {

std::shared_ptr<Link> linked(const rclcpp::Node::SharedPtr& node, const std::string& ns,
                             double wait_s) {
  auto link = std::make_shared<Link>(node, ns);
  link->wait_for_servers(wait_s);
  return link;
}

moveit::core::RobotModelConstPtr model_of(Link& link, const MoveGroupInterface::Options& options) {
  if (options.robot_model_) return options.robot_model_;
  const std::string urdf = link.description(options.robot_description_);
  const std::string srdf = link.description(options.robot_description_ + "_semantic");
  if (urdf.empty()) {
    throw std::runtime_error(
        "Unable to construct robot model. Please make sure all needed information is on the "
        "parameter server.");
  }
  return std::make_shared<moveit::core::RobotModel>(urdf, srdf);
}

}  // namespace

MoveGroupInterface::MoveGroupInterface(const rclcpp::Node::SharedPtr& node, const Options& opt,
                                       const std::shared_ptr<tf2_ros::Buffer>&,
                                       const rclcpp::Duration& wait_for_servers)
    : MoveGroupCore(nullptr), node_(node) {
  auto link = linked(node, opt.move_group_namespace_, wait_for_servers.seconds());
  const auto model = model_of(*link, opt);
  impl_ = std::make_shared<Impl>(link, model, opt.group_name_);
  RCLCPP_INFO(node->get_logger(), "Ready to take commands for planning group %s.",
              opt.group_name_.c_str());
}

PlanningSceneInterface::PlanningSceneInterface(const std::string& ns, bool /*wait*/)
    : PlanningSceneCore(std::make_shared<Impl>()) {
  rclcpp::NodeOptions options;
  options.arguments({"--ros-args", "-r",
                     "__node:=planning_scene_interface_" +
                         std::to_string(reinterpret_cast<std::uintptr_t>(this))});
  impl_->link =
      std::make_shared<Link>(rclcpp::Node::make_shared("planning_scene_interface", options), ns);
}

}  // namespace planning_interface
}  // namespace moveit
