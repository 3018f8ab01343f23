#pragma once

#include <actionlib_msgs/GoalStatus.h>

#include <cstdint>
#include <string>
#include <vector>

namespace actionlib {

/// Where a goal is between client and server.
class CommState {
 public:
  enum StateEnum {
    WAITING_FOR_GOAL_ACK = 0,
    PENDING = 1,
    ACTIVE = 2,
    WAITING_FOR_RESULT = 3,
    WAITING_FOR_CANCEL_ACK = 4,
    RECALLING = 5,
    PREEMPTING = 6,
    DONE = 7
  };
  StateEnum state_;

  CommState(const StateEnum& state) : state_(state) {}
  inline bool operator==(const CommState& other) const { return state_ == other.state_; }
  inline bool operator==(const StateEnum& other) const { return state_ == other; }
  inline bool operator!=(const StateEnum& other) const { return state_ != other; }
  inline bool operator!=(const CommState& other) const { return state_ != other.state_; }
  std::string toString() const {
    static const char* const kNames[] = {
        "WAITING_FOR_GOAL_ACK",   "PENDING",   "ACTIVE",     "WAITING_FOR_RESULT",
        "WAITING_FOR_CANCEL_ACK", "RECALLING", "PREEMPTING", "DONE"};
    return kNames[state_];
  }

  /// Gazelle's: the states on the way to what a server says, none where that changes nothing or
  /// goes back (status messages may be older than what is known).
  std::vector<StateEnum> wayTo(uint8_t status) const {
    typedef actionlib_msgs::GoalStatus S;
    std::vector<StateEnum> way;
    const bool is_early = state_ == WAITING_FOR_GOAL_ACK;
    const bool is_ahead = is_early || state_ == PENDING;  // it may still become active
    switch (status) {
      case S::PENDING:
        if (is_early) way = {PENDING};
        break;
      case S::ACTIVE:
        if (is_ahead) way = {ACTIVE};
        break;
      case S::PREEMPTING:
        if (is_ahead) way = {ACTIVE};
        if (state_ != PREEMPTING && state_ < DONE && state_ != WAITING_FOR_RESULT)
          way.push_back(PREEMPTING);
        break;
      case S::RECALLING:
        if (is_early) way = {PENDING};
        if (is_ahead || state_ == WAITING_FOR_CANCEL_ACK) way.push_back(RECALLING);
        break;
      case S::REJECTED:
        if (is_early) way = {PENDING};
        if (is_ahead || state_ == WAITING_FOR_CANCEL_ACK || state_ == RECALLING)
          way.push_back(WAITING_FOR_RESULT);
        break;
      case S::RECALLED:
        if (is_early) way = {PENDING};
        if (is_ahead || state_ == WAITING_FOR_CANCEL_ACK) way.push_back(RECALLING);
        if (is_ahead || state_ == WAITING_FOR_CANCEL_ACK || state_ == RECALLING)
          way.push_back(WAITING_FOR_RESULT);
        break;
      case S::PREEMPTED:
      case S::SUCCEEDED:
      case S::ABORTED:
        if (state_ == WAITING_FOR_RESULT || state_ == DONE) break;
        if (is_ahead) way = {ACTIVE};
        if (state_ == WAITING_FOR_CANCEL_ACK || state_ == RECALLING ||
            (status == S::PREEMPTED && state_ != PREEMPTING))
          way.push_back(PREEMPTING);
        way.push_back(WAITING_FOR_RESULT);
        break;
      default:
        break;
    }
    return way;
  }
};

}  // namespace actionlib
