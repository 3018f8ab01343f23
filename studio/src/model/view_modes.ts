/** View modes: Gazebo's View menu, for all and for one model. */

/** The modes in the order of the menu, with Gazebo's words. */
export const MODES = {
  wireframe: 'Wireframe',
  transparent: 'Transparent',
  collisions: 'Collisions',
  inertias: 'Inertias',
  com: 'Center of Mass',
  joints: 'Joints',
  frames: 'Link Frames',
  boxes: 'Bounding Boxes',
} as const;

export type Mode = keyof typeof MODES;

/** What old documents call a mode, or what it draws. */
export const ABOUT: Partial<Record<Mode, string>> = {
  collisions: 'The shapes that collide (once: Show Physics)',
  inertias: 'Boxes of the same mass and inertia',
  joints: 'Where joints are, and their axes',
  boxes: 'A box around each link',
};
export type ModeFlags = Partial<Record<Mode, boolean>>;

/** Which modes are on, and what single models say otherwise. */
export class ModeSet {
  private all: ModeFlags = {};
  private readonly own = new Map<string, ModeFlags>();

  /** Is a mode on, for one model or (no name) for all? */
  isOn(mode: Mode, model?: string): boolean {
    const own = model === undefined ? undefined : this.own.get(model)?.[mode];
    return own ?? this.all[mode] ?? false;
  }

  /** Set a mode of all models, which forgets what single models said of it; or of one model. */
  set(mode: Mode, on: boolean, model?: string): void {
    if (model === undefined) {
      this.all[mode] = on;
      this.own.forEach((flags) => delete flags[mode]);
      return;
    }
    const flags = this.own.get(model) ?? {};
    flags[mode] = on;
    this.own.set(model, flags);
  }

  /** What differs from the defaults, for layouts. */
  value(): ModeFlags {
    return { ...this.all };
  }
}
