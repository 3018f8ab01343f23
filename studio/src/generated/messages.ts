/** What the server sends, as its Python types declare it. Generated: `python -m gazelle.studio.typescript`. */

/** What the page knows of a display before it draws one. */
export interface DisplayRow {
  name: string;
  about: string;
  /** messages it shows, as `sensor_msgs/LaserScan`; none for those without a topic. */
  types: string[];
  /** what other versions of RViz call it. */
  aliases: string[];
  /** it reads the stream `display`. */
  streams: boolean;
  /** the display whose drawing it takes, usually its own. */
  drawn_as: string;
}

/** Displays that pip packages add, and one sentence for each that cannot be shown. */
export interface AddedDisplays {
  displays: DisplayRow[];
  problems: string[];
}
