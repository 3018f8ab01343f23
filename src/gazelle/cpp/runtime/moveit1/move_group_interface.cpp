// MoveGroupInterface and PlanningSceneInterface of ROS 1.
#include <moveit/move_group_interface/move_group_interface.h>

#include <actionlib/client/simple_action_client.h>
#include <moveit/planning_scene_interface/planning_scene_interface.h>
#include <moveit_msgs/ApplyPlanningScene.h>
#include <moveit_msgs/ExecuteTrajectoryAction.h>
#include <moveit_msgs/GetCartesianPath.h>
#include <moveit_msgs/GetPlanningScene.h>
#include <moveit_msgs/MoveGroupAction.h>
#include <moveit_msgs/PlanningSceneComponents.h>
#include <ros/callback_queue.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <stdexcept>

#include "gazelle/core.hpp"

namespace moveit {
namespace planning_interface {

constexpr double kServiceWaitS = 60.0;

// A pose that is aimed at, or one part of it.
struct Aim {
  msgs::geo::PoseStamped pose;
  bool has_position, has_orientation;
};

// The way to move_group: callbacks run in threads of their own, so the user need not spin.
class Link {
 public:
  using MoveClient = actionlib::SimpleActionClient<moveit_msgs::MoveGroupAction>;
  using ExecuteClient = actionlib::SimpleActionClient<moveit_msgs::ExecuteTrajectoryAction>;
  using MoveGoal = moveit_msgs::MoveGroupGoal;
  using MoveResult = moveit_msgs::MoveGroupResult;
  using CartesianRequest = moveit_msgs::GetCartesianPath::Request;
  using CartesianResponse = moveit_msgs::GetCartesianPath::Response;
  using SceneRequest = moveit_msgs::GetPlanningScene::Request;
  using SceneResponse = moveit_msgs::GetPlanningScene::Response;

  explicit Link(const ros::NodeHandle& node)
      : node_(node),
        spinner_(1, &queue_),
        mover_(node_, "move_group", true),
        executor_(node_, "execute_trajectory", true) {
    ros::NodeHandle listening(node_);
    listening.setCallbackQueue(&queue_);
    states_ = listening.subscribe("joint_states", 25, &Link::take, this);
    events_ = node_.advertise<std_msgs::String>("trajectory_execution_event", 1);
    spinner_.start();
  }
  ~Link() { spinner_.stop(); }

  void wait_for_servers(const ros::WallDuration& limit) {
    const ros::Duration wait(limit.toSec());
    if (!mover_.waitForServer(wait) || !executor_.waitForServer(wait)) {
      throw std::runtime_error("Unable to connect to move_group action server");
    }
  }

  // With a result the end is waited for.
  bool move(const MoveGoal& goal, MoveResult* result) {
    if (!mover_.isServerConnected()) return false;
    mover_.sendGoal(goal);
    if (result == nullptr) return true;
    if (!mover_.waitForResult() || !mover_.getResult()) return false;
    *result = *mover_.getResult();
    return true;
  }
  bool execute(const msgs::mv::RobotTrajectory& trajectory, msgs::mv::MoveItErrorCodes* code) {
    if (!executor_.isServerConnected()) return false;
    moveit_msgs::ExecuteTrajectoryGoal goal;
    goal.trajectory = trajectory;
    executor_.sendGoal(goal);
    if (code == nullptr) return true;
    if (!executor_.waitForResult() || !executor_.getResult()) return false;
    *code = executor_.getResult()->error_code;
    return true;
  }
  void stop() {
    std_msgs::String event;
    event.data = "stop";
    events_.publish(event);
  }

  bool cartesian(const CartesianRequest& request, CartesianResponse& response) {
    return call<moveit_msgs::GetCartesianPath>("compute_cartesian_path", request, response);
  }
  bool scene(const SceneRequest& request, SceneResponse& response) {
    return call<moveit_msgs::GetPlanningScene>("get_planning_scene", request, response);
  }
  bool apply(const msgs::mv::PlanningScene& scene) {
    moveit_msgs::ApplyPlanningScene::Request request;
    request.scene = scene;
    moveit_msgs::ApplyPlanningScene::Response response;
    return call<moveit_msgs::ApplyPlanningScene>("apply_planning_scene", request, response) &&
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
  ros::Time now() const { return ros::Time::now(); }

  // The text of a description, from a parameter that is searched for upwards.
  std::string description(const std::string& name) {
    std::string place, text;
    if (node_.searchParam(name, place)) node_.getParam(place, text);
    return text;
  }

 private:
  template <class Service>
  bool call(const std::string& name, const typename Service::Request& request,
            typename Service::Response& response) {
    ros::ServiceClient client = node_.serviceClient<Service>(name);
    if (!client.waitForExistence(ros::Duration(kServiceWaitS))) return false;
    typename Service::Request copy(request);
    return client.call(copy, response);
  }
  void take(const msgs::sen::JointState::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t i = 0; i < message->name.size() && i < message->position.size(); ++i) {
      positions_[message->name[i]] = message->position[i];
    }
    changed_.notify_all();
  }

  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  MoveClient mover_;
  ExecuteClient executor_;
  ros::Subscriber states_;
  ros::Publisher events_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, double> positions_;
};

#include "gazelle/moveit/move_group_core_body.inc"

namespace {

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

MoveGroupInterface::MoveGroupInterface(const Options& opt, const std::shared_ptr<tf2_ros::Buffer>&,
                                       const ros::WallDuration& wait_for_servers)
    : MoveGroupCore(nullptr), node_handle_(opt.node_handle_) {
  auto link = std::make_shared<Link>(opt.node_handle_);
  link->wait_for_servers(wait_for_servers);
  const auto model = model_of(*link, opt);
  impl_ = std::make_shared<Impl>(link, model, opt.group_name_);
  ROS_INFO_NAMED("move_group_interface", "Ready to take commands for planning group %s.",
                 opt.group_name_.c_str());
}

PlanningSceneInterface::PlanningSceneInterface(const std::string& ns, bool /*wait*/)
    : PlanningSceneCore(std::make_shared<Impl>()) {
  impl_->link = std::make_shared<Link>(ros::NodeHandle(ns));
}

}  // namespace planning_interface
}  // namespace moveit
