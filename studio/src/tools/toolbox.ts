/** Which tools a view has, in the order of its toolbar. */
import { focusCamera, measure, moveCamera, publishPoint, selectTool } from './select_measure_focus';
import { gizmo } from './gizmo';
import { navGoal, poseEstimate } from './goal';
import { interact } from './interact';
import type { Bench, Tool } from './tool';

/** Gazebo's tools for the world, RViz's for displays. */
export function toolsFor(kind: 'gazebo' | 'rviz', bench: Bench): readonly Tool[] {
  if (kind === 'gazebo') {
    return [
      { ...selectTool(bench), key: 'escape' },
      gizmo(bench, 'translate'),
      gizmo(bench, 'rotate'),
      measure(bench),
    ];
  }
  return [
    moveCamera(bench),
    interact(bench),
    selectTool(bench),
    focusCamera(bench),
    measure(bench),
    poseEstimate(bench),
    navGoal(bench),
    publishPoint(bench),
  ];
}
