/** A grid of cells as textures of one byte a cell; a shader colours them, so new cells cost their transfer alone. */
import * as THREE from 'three';

/** What any graphics card takes; larger grids are cut. */
const SIDE = 4096;

const VERTEX = /* glsl */ `
  varying vec2 place;
  void main() {
    place = uv;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;
const FRAGMENT = /* glsl */ `
  uniform sampler2D cells;
  uniform sampler2D palette;
  uniform float alpha;
  varying vec2 place;
  void main() {
    float value = texture2D(cells, place).r * 255.0;
    vec4 colour = texture2D(palette, vec2((value + 0.5) / 256.0, 0.5));
    if (colour.a * alpha == 0.0) discard;
    gl_FragColor = vec4(colour.rgb, colour.a * alpha);
  }`;

/** A rectangle of cells. */
export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}

interface Swatch extends Rect {
  mesh: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  texture: THREE.DataTexture;
  values: Uint8Array<ArrayBuffer>;
}

/** How all swatches of a grid look. */
export interface Look {
  alpha: number;
  palette: THREE.Texture;
  /** Everything else is drawn over it. */
  behind: boolean;
}

/** Grids in one plane are drawn in the order in which their displays were made. */
let made = 0;

/** The swatches of one grid, in cells: the parent scales them. */
export class Swatches {
  readonly root = new THREE.Group();
  width = 0;
  height = 0;
  private swatches: Swatch[] = [];
  private readonly before = ++made;

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private look: Look,
  ) {}

  /** Make room for a grid of a size. */
  resize(width: number, height: number): void {
    if (width === this.width && height === this.height) return;
    this.dispose();
    [this.width, this.height] = [width, height];
    for (let y = 0; y < height; y += SIDE) {
      for (let x = 0; x < width; x += SIDE)
        this.add({ x, y, width: Math.min(SIDE, width - x), height: Math.min(SIDE, height - y) });
    }
    this.restyle(this.look);
  }

  /** Put cells in place; of a part only the part goes to the graphics card. */
  put(rect: Rect, cells: Uint8Array<ArrayBuffer>): void {
    for (const swatch of this.swatches) {
      const x = Math.max(rect.x, swatch.x);
      const y = Math.max(rect.y, swatch.y);
      const width = Math.min(rect.x + rect.width, swatch.x + swatch.width) - x;
      const height = Math.min(rect.y + rect.height, swatch.y + swatch.height) - y;
      if (width > 0 && height > 0) this.fill(swatch, { x, y, width, height }, rect, cells);
    }
  }

  /** How many cells have a value that a function says yes to. */
  count(wanted: (value: number) => boolean): number {
    return this.swatches.reduce(
      (sum, { values }) => values.reduce((found, value) => found + Number(wanted(value)), sum),
      0,
    );
  }

  restyle(look: Look): void {
    this.look = look;
    for (const { mesh } of this.swatches) {
      const { material } = mesh;
      material.uniforms.alpha.value = look.alpha;
      material.uniforms.palette.value = look.palette;
      // What is not transparent is drawn before all that is: only so everything comes over it.
      material.transparent = !look.behind;
      material.depthTest = !look.behind;
      mesh.renderOrder = (look.behind ? -100 : -20) + this.before * 1e-4;
    }
  }

  dispose(): void {
    for (const { mesh, texture } of this.swatches) {
      this.root.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.dispose();
      texture.dispose();
    }
    this.swatches = [];
    this.width = this.height = 0;
  }

  private add(rect: Rect): void {
    const values = new Uint8Array(rect.width * rect.height);
    const texture = new THREE.DataTexture(values, rect.width, rect.height, THREE.RedFormat);
    texture.needsUpdate = true;
    const material = new THREE.ShaderMaterial({
      uniforms: { cells: { value: texture }, palette: { value: null }, alpha: { value: 1 } },
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: THREE.DoubleSide,
      depthWrite: false,
      // Blended also where it counts as opaque; what lies in its plane is seen, the ground of a world below it.
      blending: THREE.CustomBlending,
      blendSrcAlpha: THREE.OneFactor,
      blendDstAlpha: THREE.OneMinusSrcAlphaFactor,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 4,
    });
    const mesh = new THREE.Mesh(
      new THREE.PlaneGeometry(rect.width, rect.height).translate(
        rect.x + rect.width / 2,
        rect.y + rect.height / 2,
        0,
      ),
      material,
    );
    mesh.raycast = () => undefined;
    this.root.add(mesh);
    this.swatches.push({ ...rect, mesh, texture, values });
  }

  private fill(swatch: Swatch, part: Rect, rect: Rect, cells: Uint8Array<ArrayBuffer>): void {
    const [left, bottom] = [part.x - swatch.x, part.y - swatch.y];
    for (let row = 0; row < part.height; row++) {
      const from = (part.y + row - rect.y) * rect.width + part.x - rect.x;
      swatch.values.set(
        cells.subarray(from, from + part.width),
        (bottom + row) * swatch.width + left,
      );
    }
    const isWhole = part.width === swatch.width && part.height === swatch.height;
    const isThere = this.renderer.properties.has(swatch.texture) && !isWhole;
    if (!isThere) {
      swatch.texture.needsUpdate = true;
      return;
    }
    const source = new THREE.DataTexture(
      swatch.values,
      swatch.width,
      swatch.height,
      THREE.RedFormat,
    );
    const box = new THREE.Box2(
      new THREE.Vector2(left, bottom),
      new THREE.Vector2(left + part.width, bottom + part.height),
    );
    this.renderer.copyTextureToTexture(
      source,
      swatch.texture,
      box,
      new THREE.Vector2(left, bottom),
    );
    source.dispose();
  }
}
