#pragma once

#include <actionlib/action_definition.h>
#include <actionlib/goal_id_generator.h>
#include <actionlib/server/server_goal_handle.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/node_handle.h>
#include <ros/timer.h>

#include <algorithm>
#include <initializer_list>
#include <list>
#include <mutex>
#include <string>

namespace actionlib {

namespace detail {

/// What a server and its goals share.
template <class ActionSpec>
struct ServerCore : public boost::enable_shared_from_this<ServerCore<ActionSpec> > {
  ACTION_DEFINITION(ActionSpec)
  typedef ServerGoalHandle<ActionSpec> GoalHandle;
  typedef boost::shared_ptr<ServerGoal<ActionSpec> > GoalPtr;

  std::recursive_mutex mutex;
  std::list<GoalPtr> goals;
  ros::Time last_cancel;
  bool is_started = false;
  GoalIDGenerator ids;
  ros::Duration list_timeout = ros::Duration(5.0);
  boost::function<void(GoalHandle)> goal_callback, cancel_callback;
  ros::Publisher result_pub, feedback_pub, status_pub;

  static bool isAtEnd(uint8_t status) {
    typedef actionlib_msgs::GoalStatus S;
    return status == S::PREEMPTED || status == S::SUCCEEDED || status == S::ABORTED ||
           status == S::REJECTED || status == S::RECALLED || status == S::LOST;
  }

  GoalHandle handleOf(const GoalPtr& goal) {
    boost::shared_ptr<void> hold = goal->hold.lock();
    if (!hold) {
      const boost::weak_ptr<ServerCore> core = this->shared_from_this();
      const boost::weak_ptr<ServerGoal<ActionSpec> > weak = goal;
      hold = boost::shared_ptr<void>(static_cast<void*>(0), [core, weak](void*) {
        const boost::shared_ptr<ServerCore> self = core.lock();
        const GoalPtr kept = weak.lock();
        if (!self || !kept) return;
        const std::lock_guard<std::recursive_mutex> lock(self->mutex);
        kept->released = ros::Time::now();
      });
      goal->hold = hold;
      goal->released = ros::Time();
    }
    return GoalHandle(this->shared_from_this(), goal, hold);
  }

  void publishStatus() {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    actionlib_msgs::GoalStatusArray message;
    message.header.stamp = ros::Time::now();
    for (auto goal = goals.begin(); goal != goals.end();) {
      message.status_list.push_back((*goal)->status);
      // Ended goals that nobody holds are told for some time more.
      if (!(*goal)->released.isZero() && (*goal)->released + list_timeout < message.header.stamp)
        goal = goals.erase(goal);
      else
        ++goal;
    }
    status_pub.publish(message);
  }
  void publishResult(const actionlib_msgs::GoalStatus& status, const Result& result) {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    const ActionResultPtr message = boost::make_shared<ActionResult>();
    message->header.stamp = ros::Time::now();
    message->status = status;
    message->result = result;
    result_pub.publish(message);
    publishStatus();
  }

  void onGoal(const ActionGoalConstPtr& message) {
    typedef actionlib_msgs::GoalStatus S;
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    if (!is_started) return;
    for (const GoalPtr& known : goals) {
      if (known->status.goal_id.id != message->goal_id.id) continue;
      // Its cancellation came before it did, or it was sent twice.
      if (known->status.status == S::RECALLING) {
        known->status.status = S::RECALLED;
        publishResult(known->status, Result());
      }
      if (!known->hold.lock()) known->released = message->goal_id.stamp;
      return;
    }
    const GoalPtr goal = boost::make_shared<ServerGoal<ActionSpec> >();
    goal->goal = message;
    goal->status.goal_id = message->goal_id;
    goal->status.status = S::PENDING;
    if (goal->status.goal_id.id.empty()) goal->status.goal_id = ids.generateID();
    if (goal->status.goal_id.stamp.isZero()) goal->status.goal_id.stamp = ros::Time::now();
    goals.push_back(goal);
    GoalHandle handle = handleOf(goal);
    if (!message->goal_id.stamp.isZero() && message->goal_id.stamp <= last_cancel)
      handle.setCanceled(Result(),
                         "This goal handle was canceled by the action server because its "
                         "timestamp is before the timestamp of the last cancel request");
    else if (goal_callback)
      goal_callback(handle);
  }

  void onCancel(const actionlib_msgs::GoalID& id) {
    typedef actionlib_msgs::GoalStatus S;
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    if (!is_started) return;
    bool is_found = false;
    const std::list<GoalPtr> kept = goals;
    for (const GoalPtr& goal : kept) {
      const bool is_all = id.id.empty() && id.stamp.isZero();
      const bool is_it = id.id == goal->status.goal_id.id;
      const bool is_before = !id.stamp.isZero() && goal->status.goal_id.stamp <= id.stamp;
      if (is_it) is_found = true;
      if (!is_all && !is_it && !is_before) continue;
      uint8_t& status = goal->status.status;
      if (status != S::PENDING && status != S::ACTIVE) continue;
      status = status == S::PENDING ? S::RECALLING : S::PREEMPTING;
      publishStatus();
      if (cancel_callback) cancel_callback(handleOf(goal));
    }
    if (!id.id.empty() && !is_found) {
      // The goal may still come.
      const GoalPtr goal = boost::make_shared<ServerGoal<ActionSpec> >();
      const ActionGoalPtr empty = boost::make_shared<ActionGoal>();
      empty->goal_id = id;
      goal->goal = empty;
      goal->status.goal_id = id;
      goal->status.status = S::RECALLING;
      goal->released = id.stamp.isZero() ? ros::Time::now() : id.stamp;
      goals.push_back(goal);
    }
    if (id.stamp > last_cancel) last_cancel = id.stamp;
  }
};

}  // namespace detail

/// Takes goals, any number at a time, and tells their user's callbacks.
template <class ActionSpec>
class ActionServerBase {
 public:
  typedef ServerGoalHandle<ActionSpec> GoalHandle;
  ACTION_DEFINITION(ActionSpec)

  virtual ~ActionServerBase() { stopServer(); }

  void registerGoalCallback(boost::function<void(GoalHandle)> cb) { core_->goal_callback = cb; }
  void registerCancelCallback(boost::function<void(GoalHandle)> cb) { core_->cancel_callback = cb; }
  void start() {
    const std::lock_guard<std::recursive_mutex> lock(core_->mutex);
    core_->is_started = true;
    core_->publishStatus();
  }
  void goalCallback(const ActionGoalConstPtr& goal) { core_->onGoal(goal); }
  void cancelCallback(const boost::shared_ptr<const actionlib_msgs::GoalID>& goal_id) {
    core_->onCancel(*goal_id);
  }

 protected:
  ActionServerBase(const ros::NodeHandle& node, boost::function<void(GoalHandle)> goal_cb,
                   boost::function<void(GoalHandle)> cancel_cb, bool auto_start)
      : node_(node), core_(boost::make_shared<detail::ServerCore<ActionSpec> >()) {
    core_->goal_callback = goal_cb;
    core_->cancel_callback = cancel_cb;
    int pub_queue_size = 50, sub_queue_size = 50;
    node_.param("actionlib_server_pub_queue_size", pub_queue_size, 50);
    node_.param("actionlib_server_sub_queue_size", sub_queue_size, 50);
    const uint32_t out = static_cast<uint32_t>(std::max(pub_queue_size, 1));
    const uint32_t in = static_cast<uint32_t>(std::max(sub_queue_size, 0));
    core_->result_pub = node_.advertise<ActionResult>("result", out);
    core_->feedback_pub = node_.advertise<ActionFeedback>("feedback", out);
    core_->status_pub = node_.advertise<actionlib_msgs::GoalStatusArray>("status", out, true);

    double frequency = 5.0, list_timeout = 5.0;
    std::string name;
    if (!node_.getParam("status_frequency", frequency) &&
        node_.searchParam("actionlib_status_frequency", name))
      node_.getParam(name, frequency);
    node_.param("status_list_timeout", list_timeout, 5.0);
    core_->list_timeout = ros::Duration(list_timeout);

    const boost::weak_ptr<detail::ServerCore<ActionSpec> > weak = core_;
    if (frequency > 0)
      status_timer_ = node_.createTimer(
          ros::Duration(1.0 / frequency), ros::TimerCallback([weak](const ros::TimerEvent&) {
            const boost::shared_ptr<detail::ServerCore<ActionSpec> > core = weak.lock();
            if (!core) return;
            const std::lock_guard<std::recursive_mutex> lock(core->mutex);
            if (core->is_started) core->publishStatus();
          }));
    if (auto_start) core_->is_started = true;
    goal_sub_ = node_.subscribe<ActionGoal>(
        "goal", in,
        boost::function<void(const ActionGoalConstPtr&)>([weak](const ActionGoalConstPtr& goal) {
          if (const auto core = weak.lock()) core->onGoal(goal);
        }));
    typedef actionlib_msgs::GoalID ID;
    cancel_sub_ = node_.subscribe<ID>("cancel", in,
                                      boost::function<void(const boost::shared_ptr<ID const>&)>(
                                          [weak](const boost::shared_ptr<ID const>& id) {
                                            if (const auto core = weak.lock()) core->onCancel(*id);
                                          }));
    if (auto_start) core_->publishStatus();
  }
  void stopServer() {
    status_timer_.stop();
    goal_sub_.shutdown();
    cancel_sub_.shutdown();
    const std::lock_guard<std::recursive_mutex> lock(core_->mutex);
    core_->is_started = false;
    core_->goal_callback = 0;
    core_->cancel_callback = 0;
  }

  ros::NodeHandle node_;
  boost::shared_ptr<detail::ServerCore<ActionSpec> > core_;
  ros::Subscriber goal_sub_, cancel_sub_;
  ros::Timer status_timer_;
};

template <class ActionSpec>
class ActionServer : public ActionServerBase<ActionSpec> {
 public:
  typedef ServerGoalHandle<ActionSpec> GoalHandle;
  typedef boost::function<void(GoalHandle)> Callback;

  ActionServer(ros::NodeHandle n, std::string name, bool auto_start)
      : ActionServerBase<ActionSpec>(ros::NodeHandle(n, name), Callback(), Callback(), auto_start) {
  }
  ActionServer(ros::NodeHandle n, std::string name)
      : ActionServerBase<ActionSpec>(ros::NodeHandle(n, name), Callback(), Callback(), true) {}
  ActionServer(ros::NodeHandle n, std::string name, Callback goal_cb, Callback cancel_cb,
               bool auto_start)
      : ActionServerBase<ActionSpec>(ros::NodeHandle(n, name), goal_cb, cancel_cb, auto_start) {}
  ActionServer(ros::NodeHandle n, std::string name, Callback goal_cb,
               Callback cancel_cb = Callback())
      : ActionServerBase<ActionSpec>(ros::NodeHandle(n, name), goal_cb, cancel_cb, true) {}
  ActionServer(ros::NodeHandle n, std::string name, Callback goal_cb, bool auto_start)
      : ActionServerBase<ActionSpec>(ros::NodeHandle(n, name), goal_cb, Callback(), auto_start) {}
};

// ---- Handles

template <class ActionSpec>
void ServerGoalHandle<ActionSpec>::change(const char* what, const std::string& text,
                                          const Result& result, std::initializer_list<Step> steps) {
  const boost::shared_ptr<Core> core = core_.lock();
  if (!core || !goal_) {
    ROS_ERROR_NAMED("actionlib",
                    "Cannot %s a goal that is not initialized, or whose server is gone", what);
    return;
  }
  const std::lock_guard<std::recursive_mutex> lock(core->mutex);
  for (const Step& step : steps) {
    if (goal_->status.status != step.from) continue;
    goal_->status.status = step.to;
    goal_->status.text = text;
    if (Core::isAtEnd(step.to))
      core->publishResult(goal_->status, result);
    else
      core->publishStatus();
    return;
  }
  ROS_ERROR_NAMED("actionlib", "Cannot %s a goal whose status is %d", what, goal_->status.status);
}

template <class ActionSpec>
void ServerGoalHandle<ActionSpec>::publishFeedback(const Feedback& feedback) {
  const boost::shared_ptr<Core> core = core_.lock();
  if (!core || !goal_) {
    ROS_ERROR_NAMED("actionlib", "Cannot publish feedback of a goal that is not there");
    return;
  }
  const std::lock_guard<std::recursive_mutex> lock(core->mutex);
  const ActionFeedbackPtr message = boost::make_shared<ActionFeedback>();
  message->header.stamp = ros::Time::now();
  message->status = goal_->status;
  message->feedback = feedback;
  core->feedback_pub.publish(message);
}

template <class ActionSpec>
actionlib_msgs::GoalStatus ServerGoalHandle<ActionSpec>::getGoalStatus() const {
  const boost::shared_ptr<Core> core = core_.lock();
  if (!core || !goal_) return actionlib_msgs::GoalStatus();
  const std::lock_guard<std::recursive_mutex> lock(core->mutex);
  return goal_->status;
}

}  // namespace actionlib
