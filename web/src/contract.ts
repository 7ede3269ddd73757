// Made by tools/contract.mjs from schemas/page.schema.json: change that and run `npm run contract`.

// what is this much less than its like, or than one of its unit, is nothing but the round-off of a calculation
// and shown as 0
export const roundOff = 1e-12;

// side of a road tile [m]
export const tileSize = 16;

// heights along a side
export const tileNodes = 65;

// binary message, little-endian: u32 1, u32 car, f64 time [s], u32 sequence of the last input it has felt, u32 of
// the page that sent that input, then one f32 for each channel of the car
export const frameKind = 1;

// [byte]
export const frameHeader = 24;

// binary message, little-endian: u32 2, u32 car, i32 ix, i32 iy, then one f32 for each height. Tiles come as the
// car comes near; what is far from it is forgotten and comes again
export const tileKind = 2;

// [byte]
export const tileHeader = 16;

// x, y, z [m]
export type Point = readonly [number, number, number];

// x, y [m]
export type GroundPoint = readonly [number, number];

// x0, y0, x1, y1 [m]
export type GroundLine = readonly [number, number, number, number];

// Numbers of a document stand in one block of bytes, so that they need no parsing.
export interface ColumnReference {
  readonly type: "f64" | "f32";
  // into the block [byte], a multiple of 8
  readonly offset: number;
  readonly count: number;
}

// What a channel is; a page finds it by that and by what it belongs to, never by its name.
export type ChannelRole =
  | "longitudinal_velocity"
  | "lateral_velocity"
  | "longitudinal_acceleration"
  | "lateral_acceleration"
  | "yaw_rate"
  | "roll_angle"
  | "steering_wheel_angle"
  | "steering_torque"
  | "drive_torque"
  | "brake"
  | "controller_activity"
  | "rotor_speed"
  | "rotor_torque"
  | "unit_throttle"
  | "gear"
  | "clutch_torque"
  | "wheel_travel"
  | "wheel_spin"
  | "brake_pressure"
  | "vertical_force"
  | "slip_angle"
  | "longitudinal_slip"
  | "contact_x"
  | "contact_y"
  | "contact_z"
  | "ground_force_x"
  | "ground_force_y"
  | "ground_force_z"
  | "pose_x"
  | "pose_y"
  | "pose_z"
  | "pose_qw"
  | "pose_qx"
  | "pose_qy"
  | "pose_qz";

// The unit that people read; factor: how many of it one of the channel's own is.
export interface DisplayUnit {
  readonly unit: string;
  readonly factor: number;
}

// A channel of the program's one list.
export interface Channel {
  // "front_left.tire.vertical_force"; the first channel of a run is "time" [s]
  readonly name: string;
  // "N"; "1" where dimensionless
  readonly unit: string;
  readonly description: string;
  readonly role?: ChannelRole;
  // whose role: "front_left.tire"; "" of the motor vehicle and its driver
  readonly of?: string;
  readonly display?: DisplayUnit;
}

// A channel with its rows.
export interface RecordedChannel {
  // "front_left.tire.vertical_force"; the first channel of a run is "time" [s]
  readonly name: string;
  // "N"; "1" where dimensionless
  readonly unit: string;
  readonly description: string;
  readonly role?: ChannelRole;
  // whose role: "front_left.tire"; "" of the motor vehicle and its driver
  readonly of?: string;
  readonly display?: DisplayUnit;
  readonly column: ColumnReference;
}

// Where a point sits: frames 0 to units - 1 are the chassis of the motor vehicle and of its trailers, whose pose
// is given in ground axes; every other frame's pose is given in the axes of its unit. A pose moves design
// coordinates: at design it is the identity. So every point is in the vehicle frame at design (ISO 8855: x ahead,
// y left, z up). The pose is the channels of the roles pose_x to pose_qz of this name.
export interface Frame {
  readonly name: string;
  readonly unit: number;
}

export interface FramePoint {
  readonly frame: number;
  readonly point: Point;
}

// What connects two points, by what it looks like. rod: a link, an arm, a tie rod; spring: a coil; damper: a tube
// in a tube; strut: coil and damper on one line; hinge: a bush, a short thick piece along its axis; body: a bare
// line that outlines a part.
export type LinkKind = "rod" | "spring" | "damper" | "strut" | "hinge" | "body";

export interface Link {
  readonly kind: LinkKind;
  // "front_left.tie rod"
  readonly name: string;
  readonly a: FramePoint;
  readonly b: FramePoint;
}

// Its speed about the axis is the channel of the role wheel_spin of this name.
export interface Wheel {
  // "front_left"
  readonly name: string;
  // of its carrier
  readonly frame: number;
  readonly center: Point;
  // unit vector, to the left
  readonly axis: Point;
  // of the tire, unloaded [m]
  readonly radius: number;
  // of one tire [m]
  readonly width: number;
  // offsets of tires along the axis: [0], or two abreast [m]
  readonly tires: readonly number[];
}

// Contact and force are channels of roles contact_x to ground_force_z of this name.
export interface TireTrace {
  // "front_left.tire"
  readonly name: string;
}

export type BodyStyle = "sedan" | "hatchback" | "off_roader" | "pickup" | "van" | "truck" | "box" | "open_wheeler";

// The box around a unit's bodywork.
export interface BodyBox {
  readonly unit: number;
  readonly low: Point;
  readonly high: Point;
  // left out where the vehicle's file states none
  readonly style?: BodyStyle;
}

// A rectangle on the ground, in ground axes [m].
export interface FrictionPatch {
  readonly x: GroundPoint;
  readonly y: GroundPoint;
  readonly friction: number;
}

export interface RoadScene {
  readonly name: string;
  // rise over run along x [1]
  readonly grade: number;
  // along y [1]
  readonly bank: number;
  // factor [1]
  readonly friction: number;
  // then tiles tell its height
  readonly uneven: boolean;
  readonly patches: readonly FrictionPatch[];
  readonly cones: readonly GroundPoint[];
}

export interface Scene {
  readonly vehicle: string;
  readonly units: number;
  readonly frames: readonly Frame[];
  readonly links: readonly Link[];
  readonly wheels: readonly Wheel[];
  readonly tires: readonly TireTrace[];
  readonly bodies: readonly BodyBox[];
  readonly road: RoadScene;
}

// A square patch of an uneven road: tile (ix, iy) begins at x = tile_size ix, y = tile_size iy and has tile_nodes
// by tile_nodes heights, row after row along x.
export interface RunTile {
  readonly ix: number;
  readonly iy: number;
  readonly column: ColumnReference;
}

export interface Run {
  // "step steer"
  readonly name: string;
  // it was read from, or ""
  readonly file: string;
  readonly channels: readonly RecordedChannel[];
  // null: the file holds no motion
  readonly scene: Scene | null;
  readonly tiles: readonly RunTile[];
}

export interface Curve {
  // "" if the only one
  readonly label: string;
  readonly x: ColumnReference;
  // NaN: a gap
  readonly y: ColumnReference;
  // marks as well as a line
  readonly points: boolean;
}

export interface Axis {
  // with its unit: "bump travel [mm]"
  readonly label: string;
  readonly logarithmic: boolean;
}

// Cones on the ground, in the units of the axes.
export interface Cones {
  // "" if the legend is not to name them
  readonly label: string;
  readonly x: ColumnReference;
  readonly y: ColumnReference;
}

export interface VerticalMark {
  readonly x: number;
  readonly label: string;
}

export interface HorizontalMark {
  readonly y: number;
  readonly label: string;
}

export interface HeadingBlock {
  readonly kind: "heading";
  readonly text: string;
}

export interface TextBlock {
  readonly kind: "text";
  readonly text: string;
}

// What is optional is left out where there is none of it.
export interface ChartBlock {
  readonly kind: "chart";
  readonly title: string;
  readonly x: Axis;
  readonly y: Axis;
  readonly curves: readonly Curve[];
  // vertical lines
  readonly marks: readonly VerticalMark[];
  // limits
  readonly horizontal_marks?: readonly HorizontalMark[];
  // both axes to one scale, as on a map; neither is logarithmic
  readonly equal_axes?: boolean;
  readonly cones?: readonly Cones[];
  // barriers
  readonly lines?: readonly GroundLine[];
}

// a text that opens a file
export interface FileCell {
  readonly text: string;
  // by its path from the page's folder
  readonly file: string;
}

// null: does not exist
export type Cell = string | number | null | FileCell;

export interface TableColumn {
  readonly name: string;
  // "": none
  readonly unit: string;
}

export interface TableBlock {
  readonly kind: "table";
  readonly title: string;
  readonly columns: readonly TableColumn[];
  readonly rows: readonly (readonly Cell[])[];
}

export interface Verdict {
  // "no cone is hit"
  readonly criterion: string;
  readonly passed: boolean;
  // "2 cones"; "" where there is nothing to tell
  readonly found: string;
}

// All of them are to be passed.
export interface VerdictsBlock {
  readonly kind: "verdicts";
  readonly list: readonly Verdict[];
}

// All runs of the document: the 3D view with its plots.
export interface ReplayBlock {
  readonly kind: "replay";
}

export type Block = HeadingBlock | TextBlock | ChartBlock | TableBlock | VerdictsBlock | ReplayBlock;

// What the program hands a page.
export interface PageDocument {
  readonly title: string;
  readonly subtitle: string;
  // "Hamilcar 0.1.0"
  readonly generator: string;
  readonly blocks: readonly Block[];
  readonly runs: readonly Run[];
}

export interface Choice {
  // what `load` names
  readonly id: string;
  // for people
  readonly name: string;
  // a road that is a maneuver's course
  readonly course: boolean;
}

// First message to every page.
export interface Hello {
  readonly type: "hello";
  readonly generator: string;
  // this page's number
  readonly page: number;
  readonly vehicles: readonly Choice[];
  readonly roads: readonly Choice[];
}

export interface PowerUnit {
  // what the roles of its channels are of
  readonly name: string;
  // [rpm]; 0: it may stand still
  readonly idle: number;
  // [rpm]
  readonly max: number;
}

// What moves a car whose wheels are not driven by a mere torque.
export interface Driveline {
  // at least one; the first is the one whose gears the person shifts
  readonly units: readonly PowerUnit[];
  // forward
  readonly gears: number;
  // there is a reverse gear
  readonly reverse: boolean;
  // one that a foot can open
  readonly clutch: boolean;
  // the gearbox shifts by itself; otherwise, in "drive", the program shifts as a driver would
  readonly automatic: boolean;
}

// What is to be driven through: a maneuver on the ground. A cone that stands in the scene's road too is drawn
// once.
export interface TestCourse {
  // "double_lane_change"; what its result names
  readonly id: string;
  // for people, short: "ISO 3888-1"
  readonly name: string;
  // "Double lane change"
  readonly title: string;
  // one sentence: what to do, and what of it is judged
  readonly summary: string;
  readonly cones: readonly GroundPoint[];
  // not to be crossed
  readonly boundaries: readonly GroundLine[];
  // to follow; []: none
  readonly line: readonly GroundPoint[];
}

// A controller that the driver may switch off. How much it intervenes is the channel of the role
// controller_activity of this keyword.
export interface Aid {
  // "abs"
  readonly keyword: string;
  // for people: one phrase
  readonly meaning: string;
}

// Whenever a car is put on a road, and to every page that comes later.
export interface CarMessage {
  readonly type: "car";
  // frames and tiles of another number are of another car
  readonly car: number;
  // id
  readonly vehicle: string;
  // id
  readonly road: string;
  readonly friction: number;
  // of the steering wheel, each way
  readonly steering_lock_deg: number;
  readonly gravity_m_per_s2: number;
  // of a frame, in order; time is not among them
  readonly channels: readonly Channel[];
  readonly scene: Scene;
  // null: a mere torque drives the car, and `reverse` turns it
  readonly driveline?: Driveline | null;
  // in the order of the vehicle's file
  readonly aids: readonly Aid[];
  // null: nothing is to be driven through
  readonly course?: TestCourse | null;
}

export interface ResultValue {
  readonly name: string;
  // "1" or "": none
  readonly unit: string;
  // null: the run did not show it
  readonly value: number | null;
  readonly meaning: string;
}

export interface CourseVerdict {
  readonly criterion: string;
  // null: not judged, because it was not driven through
  readonly passed: boolean | null;
  readonly found: string;
}

// When the course has been driven through, or cannot be any more; again to a page that comes later, until the car
// is back at its start. A new car takes it away, and so does time that runs backward.
export interface CourseResult {
  readonly type: "result";
  // its id
  readonly course: string;
  // driven to its end
  readonly finished: boolean;
  // null: there is nothing to pass
  readonly passed: boolean | null;
  readonly values: readonly ResultValue[];
  readonly verdicts: readonly CourseVerdict[];
  // from entering the course to its end, or as far as it went [s]
  readonly time: number;
}

// "": running; paused by the driver; no page drives; the car's run ended
export type PauseReason = "" | "driver" | "nobody" | "ended";

// Five times a second.
export interface Status {
  readonly type: "status";
  // the page that drives; 0: none
  readonly driver: number;
  // connected
  readonly pages: number;
  readonly paused: PauseReason;
  // why, if it has
  readonly ended: string;
  // simulated over real time that is asked for [1]
  readonly pace: number;
  // simulated [s]
  readonly time: number;
  // keywords of the car's aids that are off; a new car has all of them on
  readonly switched_off: readonly string[];
  // of the physics thread
  readonly steps: number;
  // simulated
  readonly step_ms: number;
  // real time from step to step, mean over the last second
  readonly period_ms: number;
  // of a step, mean over the last second
  readonly compute_us: number;
  // latest start of a step since the car was put on the road
  readonly worst_overrun_ms: number;
  // steps that began more than one period late
  readonly overruns: number;
  // file, or ""
  readonly recording: string;
  readonly recorded_s: number;
  // of the recording, where the disk was too slow
  readonly lost_rows: number;
  // of this page, where it was too slow
  readonly lost_frames: number;
}

// A request that was not granted, or a message that was not understood.
export interface Refusal {
  readonly type: "refusal";
  readonly message: string;
}

export type ServerMessage = Hello | CarMessage | CourseResult | Status | Refusal;

export type Selector = "drive" | "neutral" | "reverse" | "manual";

// Pedals and wheel as the person holds them; the program turns keys into the motion of hands. Only the driver's
// count. Selector, gear and clutch: all three where the car has a driveline, none of them where it has not.
export interface InputMessage {
  readonly type: "input";
  // counts up
  readonly sequence: number;
  readonly device: "keys" | "axes";
  // -1 full right to 1 full left
  readonly steer: number;
  readonly throttle: number;
  readonly brake: number;
  // with a driveline the same as selector "reverse"
  readonly reverse: boolean;
  readonly selector?: Selector;
  // wanted where the selector is at "manual", 1 to its gears; 1 elsewhere
  readonly gear?: number;
  // pedal, 0 to 1 all the way down; 0 leaves the clutch to the program
  readonly clutch?: number;
}

// The car back to its start.
export interface ResetMessage {
  readonly type: "reset";
}

export interface PauseMessage {
  readonly type: "pause";
  readonly on: boolean;
}

export interface PaceMessage {
  readonly type: "pace";
  readonly factor: number;
}

export interface LoadMessage {
  readonly type: "load";
  readonly vehicle: string;
  readonly road: string;
  readonly friction: number;
}

export interface RecordMessage {
  readonly type: "record";
  readonly on: boolean;
}

// Take control, where no page has it.
export interface TakeMessage {
  readonly type: "take";
}

// One of the car's aids off or on again.
export interface SwitchMessage {
  readonly type: "switch";
  // its keyword
  readonly aid: string;
  readonly on: boolean;
}

export type ClientMessage =
  | InputMessage
  | ResetMessage
  | PauseMessage
  | PaceMessage
  | LoadMessage
  | RecordMessage
  | SwitchMessage
  | TakeMessage;
