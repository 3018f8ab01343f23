// Controllers of the PR2 in the control loop of the simulator: the C functions that
// gazelle.cpp.controllers calls. States and commands are the loop's own arrays.
#include <pr2_controller_interface/controller.h>
#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "gazelle/class_registry.hpp"
#include "gazelle/core.hpp"
#include "gazelle/json.hpp"
#include "gazelle/urdf/model_from_text.hpp"
#include "gazelle_abi.h"

struct gazelle_controller;

namespace {

using gazelle::Json;
using pr2_controller_interface::Controller;
using pr2_mechanism_model::JointState;

using Notify = void (*)(void* context);

// The queue of a controller's callbacks: says when there is something in it, so that the loop
// calls it between two steps, also while the world stands still.
class LoopQueue : public ros::CallbackQueue {
 public:
  LoopQueue(Notify notify, void* context) : notify_(notify), context_(context) {}
  void addCallback(const ros::CallbackInterfacePtr& callback, uint64_t owner_id) override {
    ros::CallbackQueue::addCallback(callback, owner_id);
    if (notify_ != nullptr) notify_(context_);
  }

 private:
  Notify notify_;
  void* context_;
};

// Where a joint's numbers stand in the arrays of the loop; negative for what it has not.
struct Place {
  std::string name;
  int position, velocity, effort, command;
  bool asked = false;
};

ros::Time time_of(int64_t time_ns) {
  ros::Time time;
  time.fromNSec(static_cast<uint64_t>(time_ns));
  return time;
}

int give(gazelle_sink sink, void* context, const std::string& text, int status) {
  if (sink != nullptr) {
    sink(context, reinterpret_cast<const uint8_t*>(text.data()), text.size());
  }
  return status;
}

// Runs a function of the user's: what it throws becomes text.
template <class Function>
int guarded(gazelle_sink sink, void* context, Function function) {
  try {
    return function();
  } catch (const std::exception& error) {
    const std::string type = gazelle::demangled(typeid(error).name());
    return give(sink, context, type + ": " + error.what(), GAZELLE_FAILED);
  } catch (...) {
    return give(sink, context, "an exception that is no std::exception", GAZELLE_FAILED);
  }
}

std::mutex g_mutex;

// All that are there, so that requests find the queue that they wait in.
std::vector<gazelle_controller*>& controllers() {
  static auto& all = *new std::vector<gazelle_controller*>;
  return all;
}

}  // namespace

struct gazelle_controller {
  gazelle_controller(Notify notify, void* context)
      : queue(notify, context), robot(&hardware), state(&robot) {
    const std::lock_guard<std::mutex> lock(g_mutex);
    controllers().push_back(this);
  }
  ~gazelle_controller() {
    const std::lock_guard<std::mutex> lock(g_mutex);
    auto& all = controllers();
    all.erase(std::remove(all.begin(), all.end(), this), all.end());
  }

  void read(int64_t time_ns) {
    hardware.current_time_ = time_of(time_ns);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Place& place = places[i];
      JointState& joint = state.joint_states_[i];
      if (place.position >= 0) joint.position_ = states[place.position];
      if (place.velocity >= 0) joint.velocity_ = states[place.velocity];
      if (place.effort >= 0 && !std::isnan(states[place.effort])) {
        joint.measured_effort_ = states[place.effort];
      }
      joint.joint_statistics_.update(&joint);
    }
  }
  void write() {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].asked && places[i].command >= 0) {
        commands[places[i].command] = state.joint_states_[i].commanded_effort_;
      }
    }
  }

  LoopQueue queue;
  pr2_hardware_interface::HardwareInterface hardware;
  pr2_mechanism_model::Robot robot;
  pr2_mechanism_model::RobotState state;
  std::vector<std::unique_ptr<pr2_hardware_interface::Actuator>> actuators;
  std::vector<Place> places;
  const double* states = nullptr;
  double* commands = nullptr;
  std::unique_ptr<ros::NodeHandle> node;
  std::unique_ptr<Controller> user;  // goes first: it holds what it made of the others
};

extern "C" {

// Make the process a node of ROS 1, once.
GAZELLE_EXPORT int gazelle_control_start(const char* node_name, gazelle_sink sink, void* context) {
  return guarded(sink, context, [&] {
    if (!ros::isInitialized()) {
      ros::init(ros::M_string(), node_name, ros::init_options::NoSigintHandler);
    }
    if (!ros::isStarted()) ros::start();
    return static_cast<int>(GAZELLE_OK);
  });
}

// Load a library and make an object of one of its controller classes.
GAZELLE_EXPORT gazelle_controller* gazelle_control_create(const char* library,
                                                          const char* class_name, Notify notify,
                                                          void* notify_context, gazelle_sink sink,
                                                          void* context) {
  std::unique_ptr<gazelle_controller> made(new gazelle_controller(notify, notify_context));
  const int status = guarded(sink, context, [&] {
    gazelle::load_library(library);
    auto& registry = gazelle::ClassRegistry::instance();
    const char* base = typeid(Controller).name();
    const std::string identity = gazelle::library_identity(library);
    made->user.reset(static_cast<Controller*>(registry.create(class_name, base, identity)));
    if (made->user) return static_cast<int>(GAZELLE_OK);
    std::string known;
    for (const auto& name : registry.names(base, identity)) known += " " + name;
    return give(sink, context,
                "the library " + identity + " has registered no controller class " + class_name +
                    " (it has:" + (known.empty() ? " none" : known) +
                    "); see the macro PLUGINLIB_EXPORT_CLASS",
                GAZELLE_FAILED);
  });
  return status == GAZELLE_OK ? made.release() : nullptr;
}

// Call init(). `setup`: {"namespace", "description", "joints": [{"name", "actuator", "position",
// "velocity", "effort", "command"}]}. The sink gets the names of the joints it asked for, as JSON,
// or the reason why it failed; an empty reason means that init() returned false.
GAZELLE_EXPORT int gazelle_control_init(gazelle_controller* controller, const char* setup,
                                        const double* states, double* commands, int64_t time_ns,
                                        gazelle_sink sink, void* context) {
  return guarded(sink, context, [&] {
    const Json json = Json::parse(setup);
    controller->states = states;
    controller->commands = commands;
    const std::string description = json["description"].as_string();
    std::string problem;
    if (!description.empty() &&
        !gazelle::model_from_text(description, controller->robot.robot_model_, problem)) {
      gazelle::log(gazelle::Level::kError, problem);
    }
    const auto index = [](const Json& value) { return static_cast<int>(value.as_int(-1)); };
    for (const Json& item : json["joints"].items()) {
      controller->places.push_back({item["name"].as_string(), index(item["position"]),
                                    index(item["velocity"]), index(item["effort"]),
                                    index(item["command"])});
      const std::string actuator = item["actuator"].as_string();
      if (actuator.empty()) continue;
      controller->actuators.emplace_back(new pr2_hardware_interface::Actuator(actuator));
      controller->hardware.addActuator(controller->actuators.back().get());
    }
    auto& robot = controller->state;
    robot.joint_states_.resize(controller->places.size());
    for (std::size_t i = 0; i < controller->places.size(); ++i) {
      const std::string& name = controller->places[i].name;
      JointState& joint = robot.joint_states_[i];
      joint.joint_ = controller->robot.robot_model_.getJoint(name);
      // Simulated joints know where they are.
      joint.calibrated_ = true;
      robot.joint_states_map_[name] = &joint;
    }
    robot.asked_ = [controller](const std::string& name) {
      for (Place& place : controller->places) place.asked = place.asked || place.name == name;
    };
    controller->read(time_ns);
    controller->node.reset(new ros::NodeHandle(json["namespace"].as_string()));
    controller->node->setCallbackQueue(&controller->queue);
    if (!controller->user->initRequest(nullptr, &robot, *controller->node)) {
      return give(sink, context, "", GAZELLE_FAILED);
    }
    // A joint that is asked for later is not this controller's.
    robot.asked_ = nullptr;
    Json asked = Json::array();
    for (const Place& place : controller->places) {
      if (place.asked) asked.push(place.name);
    }
    return give(sink, context, asked.dump(), GAZELLE_OK);
  });
}

GAZELLE_EXPORT int gazelle_control_starting(gazelle_controller* controller, int64_t time_ns,
                                            gazelle_sink sink, void* context) {
  return guarded(sink, context, [&] {
    controller->read(time_ns);
    controller->state.zeroCommands();
    controller->user->startRequest(time_of(time_ns));
    controller->write();
    return static_cast<int>(GAZELLE_OK);
  });
}

// As the PR2's manager does it: joints are read, commands begin at zero, the controller adds.
GAZELLE_EXPORT int gazelle_control_update(gazelle_controller* controller, int64_t time_ns,
                                          int64_t period_ns, gazelle_sink sink, void* context) {
  return guarded(sink, context, [&] {
    controller->read(time_ns);
    controller->state.zeroCommands();
    ros::Duration period;
    period.fromNSec(period_ns);
    controller->user->updateRequest(time_of(time_ns), period);
    controller->write();
    return static_cast<int>(GAZELLE_OK);
  });
}

GAZELLE_EXPORT int gazelle_control_stopping(gazelle_controller* controller, int64_t time_ns,
                                            gazelle_sink sink, void* context) {
  return guarded(sink, context, [&] {
    controller->read(time_ns);
    controller->state.zeroCommands();
    controller->user->stopRequest(time_of(time_ns));
    controller->write();
    return static_cast<int>(GAZELLE_OK);
  });
}

// Call what waits in the controller's queue and in the process' own.
GAZELLE_EXPORT int gazelle_control_spin(gazelle_controller* controller, gazelle_sink sink,
                                        void* context) {
  return guarded(sink, context, [&] {
    controller->queue.callAvailable(ros::WallDuration());
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration());
    return static_cast<int>(GAZELLE_OK);
  });
}

// The same for every controller that is there.
GAZELLE_EXPORT int gazelle_control_spin_all(gazelle_sink sink, void* context) {
  std::vector<gazelle_controller*> all;
  {
    const std::lock_guard<std::mutex> lock(g_mutex);
    all = controllers();
  }
  for (gazelle_controller* controller : all) {
    const int status = gazelle_control_spin(controller, sink, context);
    if (status != GAZELLE_OK) return status;
  }
  return GAZELLE_OK;
}

GAZELLE_EXPORT int gazelle_control_destroy(gazelle_controller* controller, gazelle_sink sink,
                                           void* context) {
  return guarded(sink, context, [&] {
    controller->user.reset();
    controller->node.reset();
    delete controller;
    return static_cast<int>(GAZELLE_OK);
  });
}

}  // extern "C"
