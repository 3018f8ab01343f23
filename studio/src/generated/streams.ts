/** Streams of which only the newest item counts; these are acknowledged. Generated: `python -m gazelle.studio.typescript`. */
export const LATEST_STREAMS: ReadonlySet<string> = new Set([
  "bag",
  "display",
  "image",
  "launch.findings",
  "motion.path",
  "motion.scene",
  "tf",
  "tf.tree",
  "topic.echo",
  "topic.stats",
  "turtles",
  "world.contacts",
  "world.joints",
  "world.poses",
  "world.stats",
]);
