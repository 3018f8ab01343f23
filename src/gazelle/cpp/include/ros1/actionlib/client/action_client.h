#pragma once

#include <actionlib/client/client_helpers.h>
#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <string>

namespace actionlib {

/// Sends goals, any number at a time.
template <class ActionSpec>
class ActionClient {
 public:
  typedef ClientGoalHandle<ActionSpec> GoalHandle;

 private:
  ACTION_DEFINITION(ActionSpec)
  typedef ActionClient<ActionSpec> ActionClientT;
  typedef boost::function<void(GoalHandle)> TransitionCallback;
  typedef boost::function<void(GoalHandle, const FeedbackConstPtr&)> FeedbackCallback;

 public:
  ActionClient(const std::string& name, ros::CallbackQueueInterface* queue = NULL) : n_(name) {
    initClient(queue);
  }
  ActionClient(const ros::NodeHandle& n, const std::string& name,
               ros::CallbackQueueInterface* queue = NULL)
      : n_(n, name) {
    initClient(queue);
  }
  ~ActionClient() {
    for (ros::Subscriber* end : {&status_sub_, &feedback_sub_, &result_sub_}) end->shutdown();
  }

  GoalHandle sendGoal(const Goal& goal, TransitionCallback transition_cb = TransitionCallback(),
                      FeedbackCallback feedback_cb = FeedbackCallback()) {
    return manager_->initGoal(goal, transition_cb, feedback_cb);
  }
  void cancelAllGoals() { cancel_pub_.publish(actionlib_msgs::GoalID()); }
  void cancelGoalsAtAndBeforeTime(const ros::Time& time) {
    actionlib_msgs::GoalID id;
    id.stamp = time;
    cancel_pub_.publish(id);
  }

  bool waitForActionServerToStart(const ros::Duration& timeout = ros::Duration(0, 0)) const {
    const ros::Time end = ros::Time::now() + timeout;
    while (n_.ok()) {
      if (isServerConnected()) return true;
      if (!timeout.isZero() && ros::Time::now() >= end) return false;
      ros::WallDuration(0.01).sleep();
    }
    return false;
  }
  /// All five topics have somebody at their other end, and the server has told its status.
  bool isServerConnected() const {
    return *has_status_ && goal_pub_.getNumSubscribers() > 0 &&
           cancel_pub_.getNumSubscribers() > 0 && status_sub_.getNumPublishers() > 0 &&
           feedback_sub_.getNumPublishers() > 0 && result_sub_.getNumPublishers() > 0;
  }

 private:
  void initClient(ros::CallbackQueueInterface* queue) {
    int pub_queue_size = 10, sub_queue_size = -1;
    n_.param("actionlib_client_pub_queue_size", pub_queue_size, 10);
    n_.param("actionlib_client_sub_queue_size", sub_queue_size, -1);
    const uint32_t out = static_cast<uint32_t>(std::max(pub_queue_size, 1));
    const uint32_t in = static_cast<uint32_t>(std::max(sub_queue_size, 0));
    if (queue) n_.setCallbackQueue(queue);

    manager_ = boost::make_shared<GoalManager<ActionSpec> >();
    goal_pub_ = n_.advertise<ActionGoal>("goal", out);
    cancel_pub_ = n_.advertise<actionlib_msgs::GoalID>("cancel", out);
    const ros::Publisher goal_pub = goal_pub_, cancel_pub = cancel_pub_;
    manager_->send_goal = [goal_pub](const ActionGoalConstPtr& goal) { goal_pub.publish(goal); };
    manager_->send_cancel = [cancel_pub](const actionlib_msgs::GoalID& id) {
      cancel_pub.publish(id);
    };
    const boost::shared_ptr<GoalManager<ActionSpec> > manager = manager_;
    const boost::shared_ptr<std::atomic<bool> > has_status = has_status_;
    typedef actionlib_msgs::GoalStatusArray Statuses;
    status_sub_ = n_.subscribe<Statuses>(
        "status", in,
        boost::function<void(const boost::shared_ptr<Statuses const>&)>(
            [manager, has_status](const boost::shared_ptr<Statuses const>& statuses) {
              *has_status = true;
              manager->updateStatuses(statuses);
            }));
    feedback_sub_ =
        n_.subscribe<ActionFeedback>("feedback", in,
                                     boost::function<void(const ActionFeedbackConstPtr&)>(
                                         [manager](const ActionFeedbackConstPtr& feedback) {
                                           manager->updateFeedbacks(feedback);
                                         }));
    result_sub_ = n_.subscribe<ActionResult>(
        "result", in,
        boost::function<void(const ActionResultConstPtr&)>(
            [manager](const ActionResultConstPtr& result) { manager->updateResults(result); }));
  }

  ros::NodeHandle n_;
  boost::shared_ptr<GoalManager<ActionSpec> > manager_;
  boost::shared_ptr<std::atomic<bool> > has_status_ = boost::make_shared<std::atomic<bool> >(false);
  ros::Publisher goal_pub_, cancel_pub_;
  ros::Subscriber status_sub_, feedback_sub_, result_sub_;
};

}  // namespace actionlib
