/** MoveIt's `.scene` files: names, poses and shapes as lines of words. */
import { list, part } from '../displays/message_fields';
import type { JsonObject } from '../json';

const NAMES: Record<number, string> = { 1: 'box', 2: 'sphere', 3: 'cylinder', 4: 'cone' };
const COUNTS: Record<string, number> = { box: 3, sphere: 1, cylinder: 2, cone: 2 };
const NONE = '0 0 0 0';

/** The text of a scene; poses of objects are in the planning frame. */
export function writeScene(name: string, objects: readonly JsonObject[]): string {
  const lines = [name];
  for (const item of objects) {
    lines.push(`* ${String(item.id)}`, ...poseLines(part(item, 'pose')));
    const solids = list<JsonObject>(item, 'primitives');
    const meshes = list<JsonObject>(item, 'meshes');
    lines.push(String(solids.length + meshes.length));
    solids.forEach((one, at) =>
      lines.push(
        ...solidLines(one),
        ...poseLines(list<JsonObject>(item, 'primitive_poses')[at] ?? {}),
        NONE,
      ),
    );
    meshes.forEach((one, at) =>
      lines.push(
        ...meshLines(one),
        ...poseLines(list<JsonObject>(item, 'mesh_poses')[at] ?? {}),
        NONE,
      ),
    );
    lines.push('0');
  }
  return `${[...lines, '.'].join('\n')}\n`;
}

function poseLines(pose: JsonObject): string[] {
  const { x = 0, y = 0, z = 0 } = part(pose, 'position') as Record<string, number>;
  const turn = part(pose, 'orientation') as Record<string, number>;
  return [`${x} ${y} ${z}`, `${turn.x ?? 0} ${turn.y ?? 0} ${turn.z ?? 0} ${turn.w ?? 1}`];
}

/** A cylinder's radius comes before its length, other than in the message. */
function solidLines(one: JsonObject): string[] {
  const name = NAMES[Number(one.type)] ?? 'box';
  const sizes = list<number>(one, 'dimensions');
  return [name, (name === 'cylinder' || name === 'cone' ? [sizes[1], sizes[0]] : sizes).join(' ')];
}

function meshLines(one: JsonObject): string[] {
  const corners = list<Record<string, number>>(one, 'vertices').map(
    ({ x, y, z }) => `${x} ${y} ${z}`,
  );
  const triangles = list<JsonObject>(one, 'triangles').map((each) =>
    list<number>(each, 'vertex_indices').join(' '),
  );
  return ['mesh', `${corners.length} ${triangles.length}`, ...corners, ...triangles];
}

/** Reads words one after the other and knows where it is. */
class Words {
  private at = 0;
  private readonly words: { text: string; line: number }[];

  constructor(
    text: string,
    private readonly file: string,
  ) {
    this.words = text.split('\n').flatMap((row, line) =>
      row
        .trim()
        .split(/\s+/)
        .filter(Boolean)
        .map((word) => ({ text: word, line: line + 1 })),
    );
  }

  next(what: string): string {
    const word = this.words[this.at++];
    if (!word) throw new Error(`${this.file} ends where ${what} should be`);
    return word.text;
  }

  number(what: string): number {
    const text = this.next(what);
    const value = Number(text);
    if (!Number.isFinite(value)) throw this.wrong(`'${text}' is no number; ${what} should be here`);
    return value;
  }

  numbers(count: number, what: string): number[] {
    return Array.from({ length: count }, () => this.number(what));
  }

  /** The rest of a line, for names with spaces. */
  line(what: string): string {
    const first = this.words[this.at];
    const found = [this.next(what)];
    while (this.words[this.at]?.line === first.line) found.push(this.next(what));
    return found.join(' ');
  }

  wrong(text: string): Error {
    return new Error(`${this.file}:${this.words[this.at - 1]?.line ?? 1}: ${text}`);
  }
}

/**
 * Objects of a `.scene` file of MoveIt 1 or 2. The newer form gives each object a pose and
 * subframes; in the older one the shapes follow its name at once.
 */
export function readScene(text: string, frame: string, file: string): JsonObject[] {
  const words = new Words(text, file);
  words.line('the name of the scene');
  const found: JsonObject[] = [];
  const isNew = hasObjectPoses(text);
  for (;;) {
    const mark = words.next("'*' or '.'");
    if (mark === '.') return found;
    if (mark !== '*')
      throw words.wrong(`'${mark}' where '*' before an object or '.' at the end should be`);
    found.push(object(words, frame, isNew));
  }
}

/** Behind a name there are the three numbers of a position, or the number of shapes alone. */
function hasObjectPoses(text: string): boolean {
  const lines = text.split('\n').map((line) => line.trim());
  const first = lines.findIndex((line) => line.startsWith('*'));
  return first >= 0 && (lines[first + 1] ?? '').split(/\s+/).length >= 3;
}

function object(words: Words, frame: string, isNew: boolean): JsonObject {
  const id = words.line('the name of an object');
  const none = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
  const made: JsonObject = {
    id,
    header: { frame_id: frame },
    pose: isNew ? pose(words) : none,
    operation: 0,
    primitives: [],
    primitive_poses: [],
    meshes: [],
    mesh_poses: [],
  };
  const count = words.number('the number of shapes');
  for (let at = 0; at < count; at++) shape(words, made);
  if (isNew) {
    const subframes = words.number('the number of subframes');
    for (let at = 0; at < subframes; at++) {
      words.line('the name of a subframe');
      pose(words);
    }
  }
  return made;
}

function shape(words: Words, made: JsonObject): void {
  const kind = words.next('the kind of a shape');
  if (kind === 'mesh') {
    const [corners, triangles] = words.numbers(2, 'the size of a mesh');
    const vertices = Array.from({ length: corners }, () => point(words));
    const faces = Array.from({ length: triangles }, () => ({
      vertex_indices: words.numbers(3, 'a triangle'),
    }));
    list<JsonObject>(made, 'meshes').push({ vertices, triangles: faces });
    list<JsonObject>(made, 'mesh_poses').push(pose(words));
  } else {
    const count = COUNTS[kind];
    if (!count)
      throw words.wrong(
        `there is no shape '${kind}'; there are ${[...Object.keys(COUNTS), 'mesh'].join(', ')}`,
      );
    const sizes = words.numbers(count, `a size of the ${kind}`);
    const dimensions = count === 2 ? [sizes[1], sizes[0]] : sizes;
    const type = Number(Object.keys(NAMES).find((key) => NAMES[Number(key)] === kind));
    list<JsonObject>(made, 'primitives').push({ type, dimensions });
    list<JsonObject>(made, 'primitive_poses').push(pose(words));
  }
  words.numbers(4, 'a colour');
}

function point(words: Words): { x: number; y: number; z: number } {
  const [x, y, z] = words.numbers(3, 'a position');
  return { x, y, z };
}

function pose(words: Words): JsonObject {
  const position = point(words);
  const [x, y, z, w] = words.numbers(4, 'an orientation');
  return { position, orientation: { x, y, z, w } };
}
