// What passes between the page and `hamilcar drive` over ws://127.0.0.1:PORT/live?token=TOKEN. The C++ side is
// hamilcar/live/messages.hpp with its two sources; they change together.
//
// Text is one JSON object a message, with its type. Binary messages come from the server alone, little-endian:
//   frame  u32 1, u32 car, f64 time [s], u32 sequence of the last input it has felt, u32 of the page that sent that input,
//          then one f32 for each channel of the car
//   tile   u32 2, u32 car, i32 ix, i32 iy, then 65 * 65 f32 heights (document.ts). Tiles come as the car comes near;
//          what is farther than 96 m from it is forgotten and would come again
import type { Channel, Scene } from "../document";

export const frameKind = 1;
export const tileKind = 2;
export const headerBytes = { frame: 24, tile: 16 } as const;

export interface Choice {
  readonly id: string; // what `load` names
  readonly name: string; // for people
}

// First message to every page.
export interface Hello {
  readonly type: "hello";
  readonly generator: string;
  readonly page: number; // this page's number
  readonly vehicles: readonly Choice[];
  readonly roads: readonly Choice[];
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

export type ServerMessage = Hello | CarMessage | Status | Refusal;

// Pedals and wheel as the person holds them; the program turns keys into the motion of hands. Only the driver's are heard.
export interface InputMessage {
  readonly type: "input";
  readonly sequence: number; // counts up
  readonly device: "keys" | "axes";
  readonly steer: number; // -1 full right to 1 full left
  readonly throttle: number; // 0 to 1
  readonly brake: number; // 0 to 1
  readonly reverse: boolean;
}

export type ClientMessage =
  | InputMessage
  | { readonly type: "reset" } // the car back to its start
  | { readonly type: "pause"; readonly on: boolean }
  | { readonly type: "pace"; readonly factor: number } // 0.05 to 1
  | { readonly type: "load"; readonly vehicle: string; readonly road: string; readonly friction: number } // 0.05 to 1.5
  | { readonly type: "record"; readonly on: boolean }
  | { readonly type: "take" }; // the wheel, where no page has it
