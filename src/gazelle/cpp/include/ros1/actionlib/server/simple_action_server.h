#pragma once

#include <actionlib/server/action_server.h>
#include <ros/ros.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace actionlib {

/// Works at one goal at a time; a newer one takes its place, and asks the one before to end.
template <class ActionSpec>
class SimpleActionServer {
 public:
  ACTION_DEFINITION(ActionSpec)
  typedef typename ActionServer<ActionSpec>::GoalHandle GoalHandle;
  typedef boost::function<void(const GoalConstPtr&)> ExecuteCallback;

  SimpleActionServer(std::string name, ExecuteCallback execute_cb, bool auto_start)
      : execute_callback_(execute_cb) {
    init(name, auto_start);
  }
  SimpleActionServer(std::string name, bool auto_start) { init(name, auto_start); }
  ROS_DEPRECATED SimpleActionServer(std::string name,
                                    ExecuteCallback execute_cb = ExecuteCallback())
      : execute_callback_(execute_cb) {
    init(name, true);
  }
  SimpleActionServer(ros::NodeHandle n, std::string name, ExecuteCallback execute_cb,
                     bool auto_start)
      : n_(n), execute_callback_(execute_cb) {
    init(name, auto_start);
  }
  SimpleActionServer(ros::NodeHandle n, std::string name, bool auto_start) : n_(n) {
    init(name, auto_start);
  }
  ROS_DEPRECATED SimpleActionServer(ros::NodeHandle n, std::string name,
                                    ExecuteCallback execute_cb = ExecuteCallback())
      : n_(n), execute_callback_(execute_cb) {
    init(name, true);
  }
  ~SimpleActionServer() {
    shutdown();
    as_.reset();
  }

  GoalConstPtr acceptNewGoal() {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (!new_goal_ || !next_goal_.getGoal()) {
      ROS_ERROR_NAMED("actionlib",
                      "Attempting to accept the next goal when a new goal is not available");
      return GoalConstPtr();
    }
    if (isActive() && current_goal_.getGoal() && current_goal_ != next_goal_)
      current_goal_.setCanceled(
          Result(),
          "This goal was canceled because another goal was received by the simple action server");
    current_goal_ = next_goal_;
    new_goal_ = false;
    preempt_request_ = new_goal_preempt_request_.load();
    new_goal_preempt_request_ = false;
    current_goal_.setAccepted("This goal has been accepted by the simple action server");
    return current_goal_.getGoal();
  }
  bool isNewGoalAvailable() { return new_goal_; }
  bool isPreemptRequested() { return preempt_request_; }
  bool isActive() {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (!current_goal_.getGoal()) return false;
    const uint8_t status = current_goal_.getGoalStatus().status;
    return status == actionlib_msgs::GoalStatus::ACTIVE ||
           status == actionlib_msgs::GoalStatus::PREEMPTING;
  }
  void setSucceeded(const Result& result = Result(), const std::string& text = std::string("")) {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    current_goal_.setSucceeded(result, text);
  }
  void setAborted(const Result& result = Result(), const std::string& text = std::string("")) {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    current_goal_.setAborted(result, text);
  }
  void setPreempted(const Result& result = Result(), const std::string& text = std::string("")) {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    current_goal_.setCanceled(result, text);
  }
  void publishFeedback(const FeedbackConstPtr& feedback) {
    current_goal_.publishFeedback(*feedback);
  }
  void publishFeedback(const Feedback& feedback) { current_goal_.publishFeedback(feedback); }
  void registerGoalCallback(boost::function<void()> cb) {
    if (execute_callback_)
      ROS_WARN_NAMED("actionlib",
                     "Cannot call SimpleActionServer::registerGoalCallback() because an "
                     "executeCallback exists. Not going to register it.");
    else
      goal_callback_ = cb;
  }
  void registerPreemptCallback(boost::function<void()> cb) { preempt_callback_ = cb; }
  void start() { as_->start(); }

  /// Ends the thread that executes; waits for the callback of the goal of now.
  void shutdown() {
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      need_to_terminate_ = true;
    }
    changed_.notify_all();
    if (execute_thread_.joinable()) {
      if (execute_thread_.get_id() == std::this_thread::get_id())
        execute_thread_.detach();
      else
        execute_thread_.join();
    }
  }

 private:
  void init(const std::string& name, bool auto_start) {
    as_.reset(new ActionServer<ActionSpec>(
        n_, name, [this](GoalHandle goal) { onGoal(goal); },
        [this](GoalHandle goal) { onPreempt(goal); }, false));
    if (execute_callback_) execute_thread_ = std::thread([this] { executeLoop(); });
    if (auto_start) as_->start();
  }

  void onGoal(GoalHandle goal) {
    boost::function<void()> preempted, received;
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      const bool is_newer =
          (!current_goal_.getGoal() || goal.getGoalID().stamp >= current_goal_.getGoalID().stamp) &&
          (!next_goal_.getGoal() || goal.getGoalID().stamp >= next_goal_.getGoalID().stamp);
      if (!is_newer) {
        goal.setCanceled(Result(),
                         "This goal was canceled because another goal was received by the simple "
                         "action server");
        return;
      }
      if (next_goal_.getGoal() && (!current_goal_.getGoal() || next_goal_ != current_goal_))
        next_goal_.setCanceled(Result(),
                               "This goal was canceled because another goal was received by the "
                               "simple action server");
      next_goal_ = goal;
      new_goal_ = true;
      new_goal_preempt_request_ = false;
      if (isActive()) {
        preempt_request_ = true;
        preempted = preempt_callback_;
      }
      received = goal_callback_;
    }
    if (preempted) preempted();
    if (received) received();
    changed_.notify_all();
  }

  void onPreempt(GoalHandle goal) {
    boost::function<void()> preempted;
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      if (goal == current_goal_) {
        preempt_request_ = true;
        preempted = preempt_callback_;
      } else if (goal == next_goal_) {
        new_goal_preempt_request_ = true;
      }
    }
    if (preempted) preempted();
  }

  void executeLoop() {
    while (n_.ok()) {
      GoalConstPtr goal;
      {
        std::unique_lock<std::recursive_mutex> lock(mutex_);
        if (need_to_terminate_) return;
        if (isActive())
          ROS_ERROR_NAMED("actionlib", "Should never reach this code with an active goal");
        else if (isNewGoalAvailable())
          goal = acceptNewGoal();
        else
          changed_.wait_for(lock, std::chrono::milliseconds(100));
      }
      if (!goal) continue;
      execute_callback_(goal);
      if (isActive()) {
        ROS_WARN_NAMED("actionlib",
                       "Your executeCallback did not set the goal to a terminal status.\n"
                       "This is a bug in your ActionServer implementation. Fix your code!\n"
                       "For now, the ActionServer will set this goal to aborted");
        setAborted(Result(),
                   "This goal was aborted by the simple action server. The user should have set a "
                   "terminal status on this goal and did not");
      }
    }
  }

  ros::NodeHandle n_;
  ExecuteCallback execute_callback_;
  boost::function<void()> goal_callback_, preempt_callback_;
  boost::shared_ptr<ActionServer<ActionSpec> > as_;
  std::recursive_mutex mutex_;
  std::condition_variable_any changed_;
  GoalHandle current_goal_, next_goal_;
  std::atomic<bool> new_goal_{false}, preempt_request_{false}, new_goal_preempt_request_{false};
  bool need_to_terminate_ = false;
  std::thread execute_thread_;
};

}  // namespace actionlib
