/** Poses and vectors as lists of numbers. */

/** x, y, z, qx, qy, qz, qw; metres. */
export type Pose = [number, number, number, number, number, number, number];
export type Vector = [number, number, number];
