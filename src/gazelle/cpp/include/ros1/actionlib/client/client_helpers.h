#pragma once

#include <actionlib/action_definition.h>
#include <actionlib/client/comm_state.h>
#include <actionlib/client/terminal_state.h>
#include <actionlib/enclosure_deleter.h>
#include <actionlib/goal_id_generator.h>
#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/console.h>
#include <ros/publisher.h>

#include <boost/enable_shared_from_this.hpp>
#include <boost/function.hpp>
#include <memory>
#include <mutex>
#include <vector>

namespace actionlib {

template <class ActionSpec>
class ClientGoalHandle;

/// The goals of one client.
template <class ActionSpec>
class GoalManager : public boost::enable_shared_from_this<GoalManager<ActionSpec> > {
 public:
  ACTION_DEFINITION(ActionSpec)
  typedef ClientGoalHandle<ActionSpec> GoalHandleT;
  typedef boost::function<void(GoalHandleT)> TransitionCallback;
  typedef boost::function<void(GoalHandleT, const FeedbackConstPtr&)> FeedbackCallback;

  /// One goal.
  struct Tracked {
    Tracked() : state(CommState::WAITING_FOR_GOAL_ACK) {}
    ActionGoalConstPtr goal;
    CommState state;
    actionlib_msgs::GoalStatus latest;
    ActionResultConstPtr result;
    TransitionCallback transition_cb;
    FeedbackCallback feedback_cb;
    boost::weak_ptr<void> hold;  // what all handles of it share
  };
  typedef boost::shared_ptr<Tracked> TrackedPtr;

  GoalHandleT initGoal(const Goal& goal, TransitionCallback transition_cb,
                       FeedbackCallback feedback_cb) {
    const ActionGoalPtr message = boost::make_shared<ActionGoal>();
    message->header.stamp = ros::Time::now();
    message->goal_id = ids_.generateID();
    message->goal = goal;
    const TrackedPtr tracked = boost::make_shared<Tracked>();
    tracked->goal = message;
    tracked->latest.goal_id = message->goal_id;
    tracked->latest.status = actionlib_msgs::GoalStatus::PENDING;
    tracked->transition_cb = transition_cb;
    tracked->feedback_cb = feedback_cb;
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex);
      goals_.push_back(tracked);
    }
    // The goal is forgotten with the last handle.
    const boost::weak_ptr<GoalManager> manager = this->shared_from_this();
    const boost::weak_ptr<Tracked> weak = tracked;
    const boost::shared_ptr<void> hold(static_cast<void*>(0), [manager, weak](void*) {
      const boost::shared_ptr<GoalManager> self = manager.lock();
      const TrackedPtr kept = weak.lock();
      if (self && kept) self->forget(kept);
    });
    tracked->hold = hold;
    GoalHandleT handle(this->shared_from_this(), tracked);
    send_goal(message);
    return handle;
  }

  void updateStatuses(const actionlib_msgs::GoalStatusArrayConstPtr& statuses) {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    for (const TrackedPtr& tracked : alive()) {
      bool is_there = false;
      for (const actionlib_msgs::GoalStatus& status : statuses->status_list)
        if (status.goal_id.id == tracked->goal->goal_id.id) {
          is_there = true;
          follow(tracked, status);
        }
      const CommState state = tracked->state;
      if (!is_there && state != CommState::WAITING_FOR_GOAL_ACK &&
          state != CommState::WAITING_FOR_RESULT && state != CommState::DONE) {
        ROS_WARN_NAMED("actionlib", "The server does not know the goal any more: it is lost");
        tracked->latest.status = actionlib_msgs::GoalStatus::LOST;
        move(tracked, CommState::DONE);
      }
    }
  }
  void updateFeedbacks(const ActionFeedbackConstPtr& feedback) {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    for (const TrackedPtr& tracked : alive())
      if (tracked->goal->goal_id.id == feedback->status.goal_id.id && tracked->feedback_cb)
        tracked->feedback_cb(GoalHandleT(this->shared_from_this(), tracked),
                             share_member(feedback, feedback->feedback));
  }
  void updateResults(const ActionResultConstPtr& result) {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    for (const TrackedPtr& tracked : alive()) {
      if (tracked->goal->goal_id.id != result->status.goal_id.id ||
          tracked->state == CommState::DONE)
        continue;
      tracked->result = result;
      follow(tracked, result->status);
      tracked->latest = result->status;
      move(tracked, CommState::DONE);
    }
  }
  void forget(const TrackedPtr& tracked) {
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    for (auto kept = goals_.begin(); kept != goals_.end(); ++kept)
      if (*kept == tracked) {
        goals_.erase(kept);
        return;
      }
  }
  void move(const TrackedPtr& tracked, CommState::StateEnum state) {
    tracked->state = CommState(state);
    const TransitionCallback callback = tracked->transition_cb;
    if (callback) callback(GoalHandleT(this->shared_from_this(), tracked));
  }

  std::recursive_mutex mutex;
  boost::function<void(const ActionGoalConstPtr&)> send_goal;
  boost::function<void(const actionlib_msgs::GoalID&)> send_cancel;

 private:
  std::vector<TrackedPtr> alive() const { return goals_; }
  void follow(const TrackedPtr& tracked, const actionlib_msgs::GoalStatus& status) {
    if (tracked->state == CommState::DONE) return;
    tracked->latest = status;
    for (const CommState::StateEnum state : tracked->state.wayTo(status.status))
      move(tracked, state);
  }

  GoalIDGenerator ids_;
  std::vector<TrackedPtr> goals_;  // while somebody has a handle of it
};

/// A client's hold of a goal; the goal is followed while a copy is there.
template <class ActionSpec>
class ClientGoalHandle {
 private:
  ACTION_DEFINITION(ActionSpec)
  typedef GoalManager<ActionSpec> Manager;
  typedef typename Manager::TrackedPtr TrackedPtr;

 public:
  ClientGoalHandle() {}
  ClientGoalHandle(const boost::shared_ptr<Manager>& manager, const TrackedPtr& tracked) {
    manager_ = manager;
    tracked_ = tracked;
    hold_ = tracked->hold.lock();
  }

  void reset() {
    hold_.reset();
    tracked_.reset();
    manager_.reset();
  }
  inline bool isExpired() const { return !tracked_; }
  CommState getCommState() const {
    const boost::shared_ptr<Manager> manager = locked("getCommState");
    if (!manager) return CommState(CommState::DONE);
    const std::lock_guard<std::recursive_mutex> lock(manager->mutex);
    return tracked_->state;
  }
  TerminalState getTerminalState() const {
    typedef actionlib_msgs::GoalStatus S;
    const boost::shared_ptr<Manager> manager = locked("getTerminalState");
    if (!manager) return TerminalState(TerminalState::LOST);
    const std::lock_guard<std::recursive_mutex> lock(manager->mutex);
    const std::string& text = tracked_->latest.text;
    switch (tracked_->latest.status) {
      case S::PREEMPTED:
        return TerminalState(TerminalState::PREEMPTED, text);
      case S::SUCCEEDED:
        return TerminalState(TerminalState::SUCCEEDED, text);
      case S::ABORTED:
        return TerminalState(TerminalState::ABORTED, text);
      case S::REJECTED:
        return TerminalState(TerminalState::REJECTED, text);
      case S::RECALLED:
        return TerminalState(TerminalState::RECALLED, text);
      default:
        return TerminalState(TerminalState::LOST, text);
    }
  }
  ResultConstPtr getResult() const {
    const boost::shared_ptr<Manager> manager = locked("getResult");
    if (!manager) return ResultConstPtr();
    const std::lock_guard<std::recursive_mutex> lock(manager->mutex);
    if (!tracked_->result) return ResultConstPtr();
    return share_member(tracked_->result, tracked_->result->result);
  }
  void resend() {
    if (const boost::shared_ptr<Manager> manager = locked("resend"))
      manager->send_goal(tracked_->goal);
  }
  void cancel() {
    const boost::shared_ptr<Manager> manager = locked("cancel");
    if (!manager) return;
    const std::lock_guard<std::recursive_mutex> lock(manager->mutex);
    const CommState state = tracked_->state;
    if (state == CommState::WAITING_FOR_RESULT || state == CommState::RECALLING ||
        state == CommState::PREEMPTING || state == CommState::DONE)
      return;
    actionlib_msgs::GoalID id;
    id.stamp = ros::Time(0, 0);
    id.id = tracked_->goal->goal_id.id;
    manager->send_cancel(id);
    manager->move(tracked_, CommState::WAITING_FOR_CANCEL_ACK);
  }
  bool operator==(const ClientGoalHandle<ActionSpec>& other) const {
    return tracked_ == other.tracked_;
  }
  bool operator!=(const ClientGoalHandle<ActionSpec>& other) const { return !(*this == other); }

 private:
  boost::shared_ptr<Manager> locked(const char* what) const {
    const boost::shared_ptr<Manager> manager = manager_.lock();
    if (!tracked_ || !manager)
      ROS_ERROR_NAMED("actionlib", "Trying to %s on an inactive ClientGoalHandle", what);
    return tracked_ ? manager : boost::shared_ptr<Manager>();
  }

  boost::weak_ptr<Manager> manager_;
  TrackedPtr tracked_;
  boost::shared_ptr<void> hold_;
};

}  // namespace actionlib
