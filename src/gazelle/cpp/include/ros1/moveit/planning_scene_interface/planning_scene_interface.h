#pragma once

#include <moveit/move_group_interface/move_group_interface.h>

namespace moveit {
namespace planning_interface {

class PlanningSceneInterface : public PlanningSceneCore {
 public:
  explicit PlanningSceneInterface(const std::string& ns = "", bool wait = true);
};

using PlanningSceneInterfacePtr = std::shared_ptr<PlanningSceneInterface>;

}  // namespace planning_interface
}  // namespace moveit
