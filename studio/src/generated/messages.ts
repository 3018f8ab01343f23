/** What the server sends, as its Python types declare it. Generated: `python -m gazelle.studio.typescript`. */
import type { Json } from '../json';

/** The graph that is looked at. */
export interface GraphPlace {
  port: number;
  domain: number;
}

/** The server's first words. */
export interface Hello {
  op: "hello";
  version: string;
  session: string;
  /** the server's own on the graph. */
  node: string;
  graph: GraphPlace;
  /** those that commands asked for. */
  panels: string[];
  /** where the pages of this release are; empty where that is not known. */
  docs: string;
  /** whether nothing runs on the graph. */
  is_idle: boolean;
}

/** A command asks for a panel. */
export interface Show {
  op: "show";
  panel: string;
  params: Record<string, Json>;
}

/** What went wrong. */
export interface ErrorValue {
  message: string;
  /** what to do about it. */
  hint?: string;
  /** what exists instead. */
  known?: string[];
}

/** A node with the names of its topics and services. */
export interface NodeRow {
  name: string;
  namespace: string;
  publishes: string[];
  subscribes: string[];
  serves: string[];
}

/** A topic with the names of its nodes. */
export interface TopicRow {
  name: string;
  type: string;
  publishers: string[];
  subscribers: string[];
  hidden: boolean;
}

/** A service with the names of its nodes. */
export interface ServiceRow {
  name: string;
  type: string;
  nodes: string[];
}

/** An action with the names of its nodes. */
export interface ActionRow {
  name: string;
  type: string;
  servers: string[];
  clients: string[];
}

/** Who speaks with whom. */
export interface GraphValue {
  nodes: NodeRow[];
  topics: TopicRow[];
  services: ServiceRow[];
  actions: ActionRow[];
}

/** A topic, service or action of a node. */
export interface EndpointRow {
  name: string;
  type: string;
}

/** What a node is. */
export interface NodeInfo {
  name: string;
  publications: EndpointRow[];
  subscriptions: EndpointRow[];
  services: EndpointRow[];
  clients: EndpointRow[];
  action_servers: EndpointRow[];
  action_clients: EndpointRow[];
  /** null where nobody knows. */
  pid: number | null;
  host: string;
}

/** Whether a node that was asked to shut down has answered. */
export interface NodeKill {
  answered: boolean;
}

/** A node that lets the levels of its loggers be set. */
export interface LoggerNode {
  node: string;
}

/** A logger of a node; its level in a small word, `debug` to `fatal`. */
export interface LoggerRow {
  name: string;
  level: string;
}

/** How many messages a publisher has sent. */
export interface PublisherCount {
  count: number;
}

/** A publisher that goes on by itself. */
export interface PublisherRow {
  count: number;
  topic: string;
  type: string;
  rate_hz: number;
  message: Record<string, Json>;
  /** by the path of a number in the message. */
  expressions: Record<string, Json>;
  enabled: boolean;
  /** why it went off by itself, empty while nothing is wrong. */
  error: string;
  /** chosen by the page. */
  id: string;
}

/** What is told when the stream `action` is open: the goal is on its way. */
export interface ActionOpened {
  type: string;
  goal_id: string;
}

/** How a goal stands, of the stream `action`. */
export interface GoalState {
  /** in capitals, as in `SUCCEEDED`. */
  state: string;
  text: string;
  /** the last one, null before it. */
  feedback: Json;
  /** null before it. */
  result: Json;
}

/** What came on a topic in the last seconds. */
export interface TopicStats {
  topic: string;
  hz: number;
  bytes_per_s: number;
  /** null where messages have no header. */
  delay_s: number | null;
  /** since somebody looks. */
  count: number;
}

/** A message of the stream `topic.echo`; its long arrays are cut. */
export interface EchoedMessage {
  type: string;
  stamp_s: number;
  count: number;
  message: Json;
}

/** What is told when the stream `topic.plot` is open: the names of its curves. */
export interface PlotCurves {
  curves: string[];
}

/** New points of a curve. */
export interface PlotPoints {
  /** its place among the names. */
  curve: number;
  /** seconds. */
  t: number[];
  /** values; null for what is no number. */
  v: (number | null)[];
}

/** What a node said, of the stream `rosout`. */
export interface LogLine {
  stamp_s: number;
  level: string;
  /** of the node. */
  name: string;
  message: string;
  file: string;
  function: string;
  line: number;
}

/** A constant of a definition. */
export interface TypeConstant {
  name: string;
  type: string;
  value: Json;
}

/** A field of a definition. */
export interface TypeField {
  name: string;
  type: string;
  /** how many of them; `[]` for any number, null for one. */
  array: number | string | null;
  /** null where the definition has none. */
  default: Json;
  /** those of a message inside. */
  fields?: TypeField[];
  constants?: TypeConstant[];
}

/** A definition; the fields of a service and of an action are its parts. */
export interface TypeValue {
  type: string;
  /** `msg`, `srv` or `action`. */
  kind: string;
  text: string;
  fields: TypeField[];
  constants?: TypeConstant[];
}

/** A frame of the stream `tf`, in the order of the poses. */
export interface TfFrame {
  name: string;
  parent: string;
  static: boolean;
}

/** What the stream `tf` tells ahead of poses whenever it changes. */
export interface FrameNames {
  frames: TfFrame[];
}

/** A frame of the stream `tf.tree`. */
export interface FrameRow {
  frame: string;
  parent: string;
  /** null where it is static. */
  rate_hz: number | null;
  /** of the newest transform; null where it is static. */
  age_s: number | null;
  /** the node that says so. */
  broadcaster: string;
  static: boolean;
}

/** A parameter of ROS 1. */
export interface ParameterRow {
  name: string;
  value: Json;
}

/** What a node of ROS 2 says of a parameter. */
export interface ParameterDescriptor {
  description: string;
  read_only: boolean;
  constraints: string;
  /** with `from_value`, `to_value` and `step`, or null. */
  range: Json;
}

/** A parameter of a node of ROS 2. */
export interface NodeParameter {
  name: string;
  value: Json;
  type: string;
  descriptor: ParameterDescriptor;
}

/** A parameter of dynamic_reconfigure. */
export interface DynamicParameterRow {
  name: string;
  type: string;
  min: Json;
  max: Json;
  default: Json;
  value: Json;
  /** an object with `enum`, or null. */
  edit_method: Json;
  description: string;
}

/** A group of parameters. */
export interface DynamicGroupRow {
  name: string;
  id: number;
  parent: number;
  type: string;
  parameters: DynamicParameterRow[];
}

/** What a node lets be changed. */
export interface Reconfigurable {
  groups: DynamicGroupRow[];
}

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

export interface RvizDisplay {
  class: string;
  name: string;
  enabled: boolean;
  topic?: string;
  properties: Record<string, Json>;
}

export interface RvizTool {
  class: string;
  topic: string;
  properties: Record<string, Json>;
}

/** Where a file looks from, metres and rad; what it does not say is not there. */
export interface RvizView {
  kind?: string;
  distance?: number;
  yaw?: number;
  pitch?: number;
  /** pixels per metre. */
  scale?: number;
  angle?: number;
  focal?: [number, number, number];
}

/** What a `.rviz` file says. */
export interface RvizFile {
  fixed_frame: string;
  background: string;
  displays: RvizDisplay[];
  view: RvizView;
  tools: RvizTool[];
  panels: string[];
  /** its parts that mean nothing here. */
  unknown: string[];
}

/** What is added to a marker with a mesh: its parts, none where it cannot be read. */
export interface MarkerMesh {
  mesh?: MeshPartValue[];
}

/** Markers that came, of `visualization_msgs/Marker` and `MarkerArray` alike. */
export interface MarkerList {
  markers: Marker[];
}

/** A frame of the displays Marker and MarkerArray. */
export interface MarkerFrame {
  pose: null;
  stamp_s: number;
  frame: string;
  message: MarkerList;
  /** of each marker's frame in the fixed one. */
  poses: [number, number, number, number, number, number, number][];
}

/** What changed of a server's interactive markers; `erases` are names of those that went. */
export interface InteractiveMarkers {
  server_id: string;
  markers: InteractiveMarker[];
  poses: InteractiveMarkerPose[];
  erases: string[];
}

/** A frame of the display InteractiveMarkers. */
export interface InteractiveFrame {
  pose: null;
  stamp_s: number;
  frame: string;
  message: InteractiveMarkers;
  /** of each marker's frame in the fixed one. */
  poses: [number, number, number, number, number, number, number][];
}

/** How a surface looks; colours are r, g, b, a from 0 to 1. */
export interface MaterialValue {
  name?: string;
  diffuse: number[];
  ambient: number[];
  specular: number[];
  emissive: number[];
  shininess: number;
  /** a file where it is made, a key on the page. */
  texture: string | null;
  /** how often the texture repeats. */
  texture_scale?: [number, number];
}

/** A box. */
export interface BoxGeometry {
  type: "box";
  size: [number, number, number];
}

/** A ball. */
export interface SphereGeometry {
  type: "sphere";
  radius: number;
}

/** What is round about z. */
export interface RoundGeometry {
  type: "cylinder" | "capsule" | "cone";
  radius: number;
  length: number;
}

/** An ellipsoid. */
export interface EllipsoidGeometry {
  type: "ellipsoid";
  radii: [number, number, number];
}

/** A plane, drawn so large. */
export interface PlaneGeometry {
  type: "plane";
  normal: [number, number, number];
  size: [number, number];
}

/** A part of a mesh, which the page loads by its key. */
export interface MeshPartValue {
  key: string;
  material: MaterialValue | null;
}

/** A mesh. */
export interface MeshGeometry {
  type: "mesh";
  parts: MeshPartValue[];
  scale: [number, number, number];
}

/** A mesh that cannot be read; it is drawn as a red box. */
export interface MissingGeometry {
  type: "missing";
  uri: string;
  reason: string;
}

/** A visual or a collision, at a pose in its body. */
export interface ShapeValue<GeometryT> {
  name: string;
  pose: [number, number, number, number, number, number, number];
  geometry: GeometryT;
  material: MaterialValue | null;
  cast_shadows: boolean;
  /** 0 to 1. */
  transparency: number;
}

/** Mass and inertia. */
export interface InertialValue {
  mass_kg: number;
  /** of the centre of mass. */
  pose: [number, number, number, number, number, number, number];
  /** ixx, iyy, izz. */
  diagonal: [number, number, number];
  /** size of the box of equal mass and inertia; zeros where no box has them. */
  box: [number, number, number];
  /** where that box is. */
  box_pose: [number, number, number, number, number, number, number];
  /** of a link whose file gives none. */
  estimated: boolean;
}

/** A sensor, at a pose in its body. */
export interface SensorValue {
  name: string;
  type: string;
  pose: [number, number, number, number, number, number, number];
  rate_hz: number;
  /** of a camera: its full horizontal angle of view. */
  fov_rad?: number;
  /** of a camera: where it is in the sensor's frame. */
  lens?: [number, number, number, number, number, number, number];
}

/** A light. */
export interface LightValue {
  name: string;
  type: string;
  pose: [number, number, number, number, number, number, number];
  direction: [number, number, number];
  diffuse: number[];
  specular: number[];
  intensity: number;
  range_m: number;
  cast_shadows: boolean;
  spot_outer_angle_rad: number;
}

/** A link. */
export interface BodyValue<GeometryT> {
  /** `model::link` in a world. */
  name: string;
  /** its place among the models. */
  model: number;
  link: string;
  /** in the world; of a robot in its root link. */
  pose: [number, number, number, number, number, number, number];
  inertial: InertialValue | null;
  visuals: ShapeValue<GeometryT>[];
  collisions: ShapeValue<GeometryT>[];
  sensors: SensorValue[];
  lights: LightValue[];
  /** of a robot: the link's frame. */
  frame?: string;
}

/** A joint that follows another one. */
export interface MimicValue {
  joint: string;
  multiplier: number;
  offset: number;
}

/** A joint. */
export interface JointValue {
  name: string;
  type: string;
  /** place of the body; -1 for the world. */
  parent: number;
  /** place of the body. */
  child: number;
  /** in the child. */
  pose: [number, number, number, number, number, number, number];
  axis: [number, number, number];
  /** null where there is no limit. */
  lower: number | null;
  upper: number | null;
  effort: number | null;
  velocity: number | null;
  mimic: MimicValue | null;
}

/** A model. */
export interface ModelValue {
  name: string;
  static: boolean;
  /** their places. */
  bodies: number[];
  /** their places. */
  joints: number[];
  pose: [number, number, number, number, number, number, number];
}

/** A world or a robot. */
export interface SceneValue<GeometryT> {
  name: string;
  /** counts changes. */
  version: number;
  kind: "world" | "robot";
  models: ModelValue[];
  bodies: BodyValue<GeometryT>[];
  joints: JointValue[];
  lights: LightValue[];
  sky: boolean;
  ambient: number[];
  background: number[];
  shadows: boolean;
  grid: boolean;
  /** where the world file has the window's camera: it looks along +x, z up. */
  view: [number, number, number, number, number, number, number] | null;
  /** of a world, m/s². */
  gravity?: number[];
  /** of a running world: the joints that the stream `world.joints` tells of. */
  moving?: string[];
  /** about a robot's text: `level`, `code` and `text` of each. */
  findings?: Record<string, Json>[];
}

/** How a world's time goes. */
export interface WorldStats {
  sim_s: number;
  real_s: number;
  /** simulated per real time; 0 while it is paused. */
  rtf: number;
  /** null for as fast as it goes. */
  wanted_rtf: number | null;
  paused: boolean;
  /** a step of the physics. */
  step_s: number;
  iterations: number;
  /** of the scene. */
  version: number;
}

/** A joint of the stream `world.joints`; rad or m. */
export interface WorldJoint {
  name: string;
  type: string;
  position: number;
  velocity: number;
  effort: number;
  /** null where there is no limit. */
  lower: number | null;
  upper: number | null;
}

/** A line of the inspector. */
export interface PropertyRow {
  /** heading that it stands below; ``collision/NAME`` for a collision's. */
  group: string;
  /** the SDF word. */
  name: string;
  /** number, bool or text; None for what is unlimited or not given. */
  value: Json;
  /** SI, empty for none. */
  unit: string;
  /** `set_property` takes it. */
  editable: boolean;
}

/** A model of the model paths. */
export interface ModelEntry {
  name: string;
  title: string;
  description: string;
  /** its folder. */
  path: string;
  /** where its picture is. */
  thumbnail: string;
}

/** A variable of a joint, rad or m; null where there is no limit. */
export interface MotionVariable {
  name: string;
  lower: number | null;
  upper: number | null;
}

/** A joint that can move. */
export interface MotionJoint {
  name: string;
  kind: string;
  child: string;
  variables: MotionVariable[];
}

/** A variable that follows another one. */
export interface MotionMimic {
  variable: string;
  leader: string;
  factor: number;
  offset: number;
}

/** An end effector: the link that carries it, and links of its own. */
export interface MotionEffector {
  name: string;
  link: string;
  links: string[];
}

/** A planning group. */
export interface MotionGroup {
  name: string;
  variables: string[];
  /** joints that are planned for. */
  active: string[];
  links: string[];
  tips: string[];
  effectors: MotionEffector[];
  /** positions of its named states. */
  states: Record<string, Record<string, number>>;
  is_chain: boolean;
}

/** A robot as its move_group knows it. */
export interface MotionRobot {
  name: string;
  /** the planning frame. */
  frame: string;
  root: string;
  velocity_scaling: number;
  acceleration_scaling: number;
  default_pipeline: string;
  defaults: Record<string, number>;
  mimics: MotionMimic[];
  joints: MotionJoint[];
  groups: MotionGroup[];
  node: string;
  /** what names of this move_group begin with: `/`. */
  prefix: string;
  scene: SceneValue<BoxGeometry | SphereGeometry | RoundGeometry | EllipsoidGeometry | PlaneGeometry | MeshGeometry | MissingGeometry>;
}

/** A mesh as `shape_msgs/Mesh` has it, metres. */
export interface MotionMesh {
  vertices: number[][];
  triangles: number[][];
}

/** A planning scene; its objects are there at first and after every change of them. */
export interface PlanningScene {
  positions: Record<string, number>;
  /** `moveit_msgs/CollisionObject` each. */
  objects?: Json[];
  /** `moveit_msgs/AttachedCollisionObject` each. */
  attached?: Json[];
}

/** Two links; the reason is empty where they are checked for collision. */
export interface AssistantPair {
  link1: string;
  link2: string;
  reason: string;
}

/** What holds the root. */
export interface AssistantVirtualJoint {
  name: string;
  type: string;
  parent_frame: string;
  child_link: string;
}

/** All joints between two links. */
export interface AssistantChain {
  base_link: string;
  tip_link: string;
}

/** A planning group as it is written, and the solver of its inverse kinematics. */
export interface AssistantGroup {
  name: string;
  chains: AssistantChain[];
  links: string[];
  joints: string[];
  subgroups: string[];
  solver: string;
}

/** A named pose, rad or m by joint. */
export interface AssistantState {
  name: string;
  group: string;
  values: Record<string, number>;
}

/** A group that is mounted on another. */
export interface AssistantEffector {
  name: string;
  group: string;
  parent_link: string;
  parent_group: string;
}

/** A controller that trajectories are sent to. */
export interface AssistantController {
  name: string;
  type: string;
  plugin: string;
  action_ns: string;
  joints: string[];
}

/** What a joint is commanded by, and whether the package adds that to the robot. */
export interface AssistantInterface {
  joint: string;
  kinds: string[];
  is_added: boolean;
}

/** A link below another one. */
export interface AssistantLink {
  name: string;
  parent: string;
  joint: string;
  kind: string;
  is_solid: boolean;
}

/** A session: the config package and its robot. */
export interface AssistantValue {
  package_name: string;
  ros_version: number;
  file: string;
  author_name: string;
  author_email: string;
  trials: number;
  pairs: AssistantPair[];
  virtual_joints: AssistantVirtualJoint[];
  groups: AssistantGroup[];
  states: AssistantState[];
  end_effectors: AssistantEffector[];
  passive_joints: string[];
  controllers: AssistantController[];
  interfaces: AssistantInterface[];
  state_interfaces: string[];
  session: number;
  folder: string;
  links: AssistantLink[];
  robot: MotionRobot;
}

/** What the page may begin with: robots' files, and config packages that are there. */
export interface AssistantStart {
  robots: string[];
  packages: string[];
  folder: string;
}

/** A file that is to be written: new, same, changed or edited. */
export interface AssistantFile {
  path: string;
  state: string;
}

/** What was written, what was edited and kept, and what to type next. */
export interface AssistantWritten {
  written: string[];
  kept: string[];
  next: string[];
}

/** A line of a user's file. */
export interface SourceLine {
  /** its number. */
  line: number;
  text: string;
  /** where the caret stands in the text, from 1; 0 for none. */
  column: number;
  /** characters under the caret. */
  width: number;
}

/** A finding about a user's file. */
export interface LaunchFinding {
  /** empty where an error has none. */
  code: string;
  severity: string;
  /** of the code. */
  title: string;
  message: string;
  /** why that matters. */
  why: string;
  /** what to write instead. */
  fix: string;
  /** what ROS or Gazebo says in this case. */
  phrase: string;
  /** file, line and column. */
  place: string;
  /** the way there, innermost first. */
  via: string[];
  /** the line; null where it cannot be read. */
  source: SourceLine | null;
  /** to the code's entry in the documentation; empty for none. */
  link: string;
}

/** A command that launched. */
export interface LaunchValue {
  name: string;
  /** as it is typed. */
  command: string;
  /** in which. */
  folder: string;
  started_s: number;
  is_running: boolean;
  /** the exit code; null while it runs, and where it was killed. */
  code: number | null;
  findings: LaunchFinding[];
}

/** The launches of a graph, the newest first: those that run, and the last one. */
export interface FoundIn {
  launches: LaunchValue[];
}

/** A command that launched. */
export interface RecentLaunch {
  name: string;
  command: string;
  /** the command with the change to its folder, for a terminal. */
  copied: string;
  folder: string;
  started_s: number;
  is_running: boolean;
  /** the exit code; null while it runs, and where it was killed. */
  code: number | null;
  /** how many it told of. */
  errors: number;
  /** the demo that it starts, empty for none. */
  demo: string;
}

/** A description that was dropped. */
export interface RobotFile {
  /** the one that is shown; its path below what was dropped. */
  file: string;
  /** all that can be shown. */
  files: string[];
  /** null where it cannot be read. */
  scene: SceneValue<BoxGeometry | SphereGeometry | RoundGeometry | EllipsoidGeometry | PlaneGeometry | MeshGeometry | MissingGeometry> | null;
  findings: LaunchFinding[];
  /** of links, joints and the like, in words. */
  counts: string;
}

/** Something to try while a demo runs: one line of what it does, and what is typed. */
export interface DemoStep {
  what: string;
  command: string;
}

/** A demo. */
export interface DemoCard {
  name: string;
  title: string;
  summary: string;
  /** whose commands it shows. */
  ros_version: number;
  /** starts it in a terminal. */
  command: string;
  /** path of its picture; empty for none. */
  picture: string;
  /** what there is to see. */
  seen: string;
  /** what to try when it runs. */
  steps: DemoStep[];
}

/** The gallery. */
export interface DemosValue {
  demos: DemoCard[];
  /** the demo that was started here and runs; empty for none. */
  running: string;
  /** whether the page may start one. */
  may_start: boolean;
}

/** A topic of a bag. */
export interface BagTopic {
  name: string;
  type: string;
  count: number;
}

/** A bag that is being recorded. */
export interface RecorderState {
  path: string;
  seconds: number;
  messages: number;
  /** messages that came faster than they were written. */
  dropped: number;
  bytes: number;
  topics: string[];
}

/** A bag that is open; seconds of its stamps. */
export interface PlayerState {
  path: string;
  playing: boolean;
  rate: number;
  begin_s: number;
  end_s: number;
  time_s: number;
  topics: BagTopic[];
  /** what could not be published. */
  problems: string[];
}

/** What is recorded and what is played. */
export interface BagState {
  recorder: RecorderState | null;
  player: PlayerState | null;
}

/** A panel that could be opened. */
export interface PanelEntry {
  name: string;
  kind: "panel" | "rqt";
  title: string;
  group: string;
  about: string;
  /** why it cannot, empty when it can. */
  problem: string;
}

/** A panel that is open. */
export interface PanelInfo {
  title: string;
  file: string;
  /** where its ES module is. */
  module: string | null;
}

/** What happened in a panel; `value` by `what`: docs/studio_protocol.md. */
export interface PanelEvent {
  what: string;
  name: string;
  value: Json;
}

/** Everything that a panel shows. */
export interface PanelState {
  /** its parts: widgets, and rows and columns with `children`. */
  layout: Record<string, Json>[];
  /** by the widgets' names. */
  values: Record<string, Json>;
  /** of its plots: `[t, value…]` each. */
  points: Record<string, Json[]>;
}

/** A widget of Qt, and the Python expression that makes ours. */
export interface PortedWidget {
  /** its `objectName`. */
  name: string;
  /** its class in Qt. */
  qt: string;
  /** in the `.ui` file. */
  line: number;
  /** empty when there is none. */
  ours: string;
  /** what to know about it. */
  note: string;
}

/** A form of Qt Designer, and what stands for its widgets. */
export interface PortedForm {
  file: string;
  widgets: PortedWidget[];
}

/** How a plug-in of rqt becomes a panel. */
export interface PortedPlugin {
  name: string;
  title: string;
  text: string;
  /** file and line that name it. */
  manifest: string;
  /** its file, empty where it is not known. */
  source: string;
  /** where the panel belongs. */
  target: string;
  forms: PortedForm[];
  /** of a panel to begin with. */
  code: string;
}

/** `builtin_interfaces/msg/Time`. */
export interface Time {
  sec: number;
  nanosec: number;
}

/** `std_msgs/msg/Header`. */
export interface Header {
  stamp: Time;
  frame_id: string;
}

/** `geometry_msgs/msg/Point`. */
export interface Point {
  x: number;
  y: number;
  z: number;
}

/** `geometry_msgs/msg/Quaternion`. */
export interface Quaternion {
  x: number;
  y: number;
  z: number;
  w: number;
}

/** `geometry_msgs/msg/Pose`. */
export interface Pose {
  position: Point;
  orientation: Quaternion;
}

/** `geometry_msgs/msg/PoseStamped`. */
export interface PoseStamped {
  header: Header;
  pose: Pose;
}

/** `geometry_msgs/msg/Vector3`. */
export interface Vector3 {
  x: number;
  y: number;
  z: number;
}

/** `std_msgs/msg/ColorRGBA`. */
export interface ColorRGBA {
  r: number;
  g: number;
  b: number;
  a: number;
}

/** `builtin_interfaces/msg/Duration`. */
export interface Duration {
  sec: number;
  nanosec: number;
}

/** `sensor_msgs/msg/CompressedImage`. */
export interface CompressedImage {
  header: Header;
  format: string;
  data: number[];
}

/** `visualization_msgs/msg/UVCoordinate`. */
export interface UVCoordinate {
  u: number;
  v: number;
}

/** `visualization_msgs/msg/MeshFile`. */
export interface MeshFile {
  filename: string;
  data: number[];
}

/** `visualization_msgs/msg/Marker`. */
export interface Marker extends MarkerMesh {
  header: Header;
  ns: string;
  id: number;
  type: number;
  action: number;
  pose: Pose;
  scale: Vector3;
  color: ColorRGBA;
  lifetime: Duration;
  frame_locked: boolean;
  points: Point[];
  colors: ColorRGBA[];
  texture_resource: string;
  texture: CompressedImage;
  uv_coordinates: UVCoordinate[];
  text: string;
  mesh_resource: string;
  mesh_file: MeshFile;
  mesh_use_embedded_materials: boolean;
}

/** `visualization_msgs/msg/MenuEntry`. */
export interface MenuEntry {
  id: number;
  parent_id: number;
  title: string;
  command: string;
  command_type: number;
}

/** `visualization_msgs/msg/InteractiveMarkerControl`. */
export interface InteractiveMarkerControl {
  name: string;
  orientation: Quaternion;
  orientation_mode: number;
  interaction_mode: number;
  always_visible: boolean;
  markers: Marker[];
  independent_marker_orientation: boolean;
  description: string;
}

/** `visualization_msgs/msg/InteractiveMarker`. */
export interface InteractiveMarker {
  header: Header;
  pose: Pose;
  name: string;
  description: string;
  scale: number;
  menu_entries: MenuEntry[];
  controls: InteractiveMarkerControl[];
}

/** `visualization_msgs/msg/InteractiveMarkerPose`. */
export interface InteractiveMarkerPose {
  header: Header;
  pose: Pose;
  name: string;
}

export type PageBody = BodyValue<BoxGeometry | SphereGeometry | RoundGeometry | EllipsoidGeometry | PlaneGeometry | MeshGeometry | MissingGeometry>;

export type PageGeometry = BoxGeometry | SphereGeometry | RoundGeometry | EllipsoidGeometry | PlaneGeometry | MeshGeometry | MissingGeometry;

export type PageScene = SceneValue<BoxGeometry | SphereGeometry | RoundGeometry | EllipsoidGeometry | PlaneGeometry | MeshGeometry | MissingGeometry>;

export type PageShape = ShapeValue<BoxGeometry | SphereGeometry | RoundGeometry | EllipsoidGeometry | PlaneGeometry | MeshGeometry | MissingGeometry>;
