/** What topics are recorded into: the formats of `gazelle.bag.formats`. Generated: `python -m gazelle.studio.typescript`. */
export const BAG_FORMATS = [
  ["bag", "ROS 1 .bag"],
  ["mcap", "rosbag2 .mcap"],
  ["db3", "rosbag2 .db3"],
] as const;
