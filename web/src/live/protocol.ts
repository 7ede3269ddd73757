// What passes between the page and `hamilcar drive` over ws://127.0.0.1:PORT/live?token=TOKEN. The C++ side is
// hamilcar/live/messages.hpp with its two sources; they change together.
//
// Text is one JSON object a message, with its type. Binary messages come from the server alone, little-endian:
//   frame  u32 1, u32 car, f64 time [s], u32 sequence of the last input it has felt, u32 of the page that sent that input,
//          then one f32 for each channel of the car
//   tile   u32 2, u32 car, i32 ix, i32 iy, then 65 * 65 f32 heights (document.ts). Tiles come as the car comes near;
//          what is farther than 96 m from it is forgotten and would come again
//
// An instrument looks up its channel by name and shows nothing where the car has none. A power unit named UNIT tells
// UNIT.speed [rpm], UNIT.torque [N m], UNIT.throttle [1], UNIT.gear (-1 reverse, 0 neutral, 1 ...) and UNIT.clutch_torque [N m];
// input.steering_torque [N m] is what the driver's hands hold.
import type { Channel, Scene, Verdict } from "../document";

export const frameKind = 1;
export const tileKind = 2;
export const headerBytes = { frame: 24, tile: 16 } as const;

export interface Choice {
  readonly id: string; // what `load` names
  readonly name: string; // for people
}

// A road whose id begins so is the course of a maneuver: the menu lists it under "Courses".
export const courseRoad = "maneuver:"; // "maneuver:double_lane_change"

// First message to every page.
export interface Hello {
  readonly type: "hello";
  readonly generator: string;
  readonly page: number; // this page's number
  readonly vehicles: readonly Choice[];
  readonly roads: readonly Choice[];
}

// What moves a car whose wheels are not driven by a mere torque.
export interface Driveline {
  readonly units: readonly PowerUnit[]; // at least one; the first is the one whose gears the person shifts
  readonly gears: number; // forward
  readonly reverse: boolean; // there is a reverse gear
  readonly clutch: boolean; // one that a foot can open
  readonly automatic: boolean; // the gearbox shifts by itself; otherwise, in "drive", the program shifts as a driver would
}

export interface PowerUnit {
  readonly name: string; // prefix of its channels
  readonly idle: number; // [rpm]; 0: it may stand still
  readonly most: number; // [rpm]
}

// What is to be driven through: a maneuver on the ground. A cone that stands in scene.road.cones too is drawn once.
export interface TestCourse {
  readonly id: string; // "double_lane_change"; what its result names
  readonly name: string; // for people, short: "ISO 3888-1"
  readonly title: string; // "Double lane change"
  readonly summary: string; // one sentence: what to do, and what of it is judged
  readonly cones: readonly (readonly [number, number])[]; // x, y [m]
  readonly boundaries: readonly (readonly [number, number, number, number])[]; // x0, y0, x1, y1: not to be crossed [m]
  readonly line: readonly (readonly [number, number])[]; // to follow; []: none [m]
}

// Whenever a car is put on a road, and to every page that comes later.
export interface CarMessage {
  readonly type: "car";
  readonly car: number; // frames and tiles of another number are of another car
  readonly vehicle: string; // ids
  readonly road: string;
  readonly friction: number;
  readonly steering_lock_deg: number; // of the steering wheel, each way
  readonly channels: readonly Channel[]; // of a frame, in order; time is not among them
  readonly scene: Scene;
  readonly driveline?: Driveline | null; // null or left out: a mere torque drives the car, and `reverse` turns it
  readonly course?: TestCourse | null; // null or left out: nothing is to be driven through
}

// When the course has been driven through, or cannot be any more; again to a page that comes later, until the car is back at
// its start. A new car takes it away, and so does time that runs backward.
export interface CourseResult {
  readonly type: "result";
  readonly course: string; // its id
  readonly finished: boolean; // driven to its end
  readonly passed: boolean | null; // null: there is nothing to pass
  readonly values: readonly ResultValue[];
  readonly verdicts: readonly CourseVerdict[];
  readonly time: number; // from entering the course to its end, or as far as it went [s]
}

export interface CourseVerdict extends Omit<Verdict, "passed"> {
  readonly passed: boolean | null; // null: not judged, because it was not driven through
}

export interface ResultValue {
  readonly name: string;
  readonly unit: string; // "1" or "": none
  readonly value: number | null; // null: the run did not show it
  readonly meaning: string;
}

export type PauseReason = "" | "driver" | "nobody" | "ended"; // running, paused by the driver, no page drives, the car's run ended

// Five times a second.
export interface Status {
  readonly type: "status";
  readonly driver: number; // the page that drives; 0: none
  readonly pages: number; // connected
  readonly paused: PauseReason;
  readonly ended: string; // why, if it has
  readonly pace: number; // simulated over real time that is asked for [1]
  readonly time: number; // simulated [s]
  readonly steps: number; // of the physics thread
  readonly step_ms: number; // simulated
  readonly period_ms: number; // real time from step to step, mean over the last second
  readonly compute_us: number; // of a step, mean over the last second
  readonly worst_overrun_ms: number; // latest start of a step since the car was put on the road
  readonly overruns: number; // steps that began more than one period late
  readonly recording: string; // file, or ""
  readonly recorded_s: number;
  readonly lost_rows: number; // of the recording, where the disk was too slow
  readonly lost_frames: number; // of this page, where it was too slow
}

// A wish that was not granted, or a message that was not understood.
export interface Refusal {
  readonly type: "refusal";
  readonly message: string;
}

export type ServerMessage = Hello | CarMessage | CourseResult | Status | Refusal;

export type Selector = "drive" | "neutral" | "reverse" | "manual";

// Pedals and wheel as the person holds them; the program turns keys into the motion of hands. Only the driver's are heard.
export interface InputMessage {
  readonly type: "input";
  readonly sequence: number; // counts up
  readonly device: "keys" | "axes";
  readonly steer: number; // -1 full right to 1 full left
  readonly throttle: number; // 0 to 1
  readonly brake: number; // 0 to 1
  readonly reverse: boolean; // with a driveline the same as selector "reverse"
  // All three where the car has a driveline, none of them where it has not.
  readonly selector?: Selector;
  readonly gear?: number; // wanted where the selector is at "manual", 1 to its gears; 1 elsewhere
  readonly clutch?: number; // pedal, 0 to 1 all the way down; 0 leaves the clutch to the program
}

export type ClientMessage =
  | InputMessage
  | { readonly type: "reset" } // the car back to its start
  | { readonly type: "pause"; readonly on: boolean }
  | { readonly type: "pace"; readonly factor: number } // 0.05 to 1
  | { readonly type: "load"; readonly vehicle: string; readonly road: string; readonly friction: number } // 0.05 to 1.5
  | { readonly type: "record"; readonly on: boolean }
  | { readonly type: "take" }; // the wheel, where no page has it
