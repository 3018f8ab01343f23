/** Who takes the goals of 2D Nav Goal in place of a topic: the panel Navigation. */
import type { JsonObject } from '../json';

/** Takes a `geometry_msgs/PoseStamped`; returns what becomes of it, '' where it is left to others. */
export type GoalTaker = (goal: JsonObject) => string;

const takers: GoalTaker[] = [];

/** Take goals from now on; returns what ends it. */
export function onGoal(taker: GoalTaker): () => void {
  takers.push(taker);
  return () => void takers.splice(takers.indexOf(taker), 1);
}

/** Hand a goal to the one that came last; '' where nobody takes it. */
export function takeGoal(goal: JsonObject): string {
  return takers.at(-1)?.(goal) ?? '';
}
