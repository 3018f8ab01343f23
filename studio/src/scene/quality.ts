/** How much is drawn: full on a graphics card, less where the processor paints. */
import type * as THREE from 'three';

export type Quality = 'auto' | 'high' | 'low';

const SLOW_FRAME_MS = 45;
const FRAMES_TO_JUDGE = 8;

/** What a level of quality means. */
export interface Level {
  antialias: boolean;
  shadows: boolean;
  pixelRatio: number;
}

/** The level to begin with: `auto` looks whether a graphics card draws. */
export function firstLevel(quality: Quality): Level {
  if (quality === 'low' || (quality === 'auto' && paintsInSoftware())) {
    return { antialias: false, shadows: quality !== 'low', pixelRatio: 1 };
  }
  return { antialias: true, shadows: true, pixelRatio: Math.min(devicePixelRatio, 2) };
}

/** The choice of the address (`?quality=low`), else of the last visit. */
export function wantedQuality(): Quality {
  const wanted = new URLSearchParams(location.search).get('quality') ?? lastChoice();
  return wanted === 'low' || wanted === 'high' ? wanted : 'auto';
}

/** A page in a frame of its own may keep nothing, and is told so by an exception. */
function lastChoice(): string | null {
  try {
    return localStorage.getItem('gazelle.quality');
  } catch {
    return null;
  }
}

let software: boolean | null = null;

function paintsInSoftware(): boolean {
  if (software === null) {
    const gl = document.createElement('canvas').getContext('webgl2');
    const names = gl?.getExtension('WEBGL_debug_renderer_info');
    const name = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
    software = /swiftshader|llvmpipe|software/i.test(name);
    gl?.getExtension('WEBGL_lose_context')?.loseContext();
  }
  return software;
}

/** Watches how long frames take and gives up what costs most, one thing at a time. */
export class Governor {
  private slow = 0;
  private frames = 0;

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly level: Level,
    private readonly adaptive: boolean,
    private readonly apply: (level: Level) => void,
  ) {}

  /** Tell how long a frame took, from its begin to its end. */
  frame(took_ms: number): void {
    if (!this.adaptive || ++this.frames < 3) return;
    this.slow =
      took_ms > SLOW_FRAME_MS
        ? this.slow + Math.min(4, took_ms / SLOW_FRAME_MS)
        : Math.max(0, this.slow - 1);
    if (this.slow < FRAMES_TO_JUDGE) return;
    this.slow = 0;
    if (this.level.pixelRatio > 1) this.level.pixelRatio = 1;
    else if (this.level.shadows) this.level.shadows = false;
    else return;
    this.renderer.shadowMap.needsUpdate = true;
    this.apply(this.level);
  }
}
