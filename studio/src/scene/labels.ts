/** Text in the scene: textures by text, drawn once. */
import * as THREE from 'three';

const PIXELS = 48;
const textures = new Map<string, { map: THREE.CanvasTexture; aspect: number; lines: number }>();
const MOST_KEPT = 400;

/** How a text is drawn. */
export interface LabelLook {
  colour?: [number, number, number];
  alpha?: number;
  /** Height of a line in metres; with `pixels` it is in pixels instead. */
  height?: number;
  pixels?: boolean;
  /** Drawn over everything. */
  onTop?: boolean;
}

/** Make a sprite that shows a text, turned to the viewer; its middle is at its position. */
export function label(text: string, look: LabelLook = {}): THREE.Sprite {
  const drawn = textTexture(text);
  const material = new THREE.SpriteMaterial({
    map: drawn.map,
    transparent: true,
    depthTest: !look.onTop,
    depthWrite: false,
  });
  const [r, g, b] = look.colour ?? [1, 1, 1];
  material.color.setRGB(r, g, b);
  material.opacity = look.alpha ?? 1;
  material.sizeAttenuation = !look.pixels;
  const sprite = new THREE.Sprite(material);
  const height = (look.height ?? 0.1) * drawn.lines * (look.pixels ? 1 / 700 : 1);
  sprite.scale.set(height * drawn.aspect, height, 1);
  if (look.pixels)
    sprite.onBeforeRender = (renderer, _scene, camera) =>
      keepPixels(sprite, renderer, camera, height, drawn.aspect);
  sprite.name = text;
  sprite.userData.text = text;
  sprite.renderOrder = look.onTop ? 20 : 5;
  sprite.raycast = () => undefined;
  return sprite;
}

/** A camera without perspective knows no size by distance: the scale makes the pixels there. */
function keepPixels(
  sprite: THREE.Sprite,
  renderer: THREE.WebGLRenderer,
  camera: THREE.Camera,
  height: number,
  aspect: number,
): void {
  const isFlat = camera instanceof THREE.OrthographicCamera;
  const perPixel = isFlat
    ? (camera.top - camera.bottom) / (renderer.domElement.clientHeight || 1)
    : 1 / 700;
  const size = height * 700 * perPixel;
  if (sprite.scale.y === size) return;
  sprite.scale.set(size * aspect, size, 1);
  sprite.updateMatrixWorld();
}

/** Free what one label holds alone. */
export function freeLabel(sprite: THREE.Sprite): void {
  sprite.material.dispose();
}

function textTexture(text: string): { map: THREE.CanvasTexture; aspect: number; lines: number } {
  const found = textures.get(text);
  if (found) return found;
  if (textures.size > MOST_KEPT) {
    textures.forEach((old) => old.map.dispose());
    textures.clear();
  }
  const lines = text.split('\n');
  const canvas = document.createElement('canvas');
  const paint = canvas.getContext('2d') as CanvasRenderingContext2D;
  const font = `600 ${PIXELS * 0.78}px system-ui, "DejaVu Sans", sans-serif`;
  paint.font = font;
  canvas.width = Math.min(
    2048,
    Math.ceil(Math.max(...lines.map((line) => paint.measureText(line).width)) + PIXELS * 0.4),
  );
  canvas.height = PIXELS * lines.length;
  paint.font = font;
  paint.textAlign = 'center';
  paint.textBaseline = 'middle';
  paint.lineWidth = 5;
  paint.strokeStyle = 'rgba(0, 0, 0, 0.55)';
  paint.fillStyle = '#fff';
  lines.forEach((line, row) => {
    paint.strokeText(line, canvas.width / 2, PIXELS * (row + 0.5));
    paint.fillText(line, canvas.width / 2, PIXELS * (row + 0.5));
  });
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.NoColorSpace;
  const made = { map, aspect: canvas.width / canvas.height, lines: lines.length };
  textures.set(text, made);
  return made;
}
