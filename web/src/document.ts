// What the program hands the page: a document of blocks and runs. The C++ side is hamilcar/io/page.cpp and
// hamilcar/run/scene.cpp; the two change together.
//
// Numbers of a column stand in one block of bytes, so that fifteen seconds at 1 ms need no parsing.
import { raisePowers } from "./report/numbers";

export interface ColumnReference {
  readonly type: "f64" | "f32";
  readonly offset: number; // into the block [byte], a multiple of 8
  readonly count: number;
}

// A channel of the program's one list; the first channel of a run is "time" [s].
export interface Channel {
  readonly name: string; // "front_left.tire.vertical_force"
  readonly unit: string; // "N"; "1" where dimensionless
  readonly description: string;
}

export interface RecordedChannel extends Channel {
  readonly column: ColumnReference;
}

export type Point = readonly [number, number, number]; // [m]

// Where a point sits: frames 0 to units - 1 are the chassis of the motor vehicle and of its trailers, whose pose is given in
// ground axes; every other frame's pose is given in the axes of its unit. A pose moves design coordinates: at design it
// is the identity. So every point below is in the vehicle frame at design (ISO 8855: x ahead, y left, z up).
// The pose of frame "NAME" is the channels NAME.pose.x, .y, .z [m] and .qw, .qx, .qy, .qz (unit quaternion).
export interface Frame {
  readonly name: string;
  readonly unit: number;
}

export interface FramePoint {
  readonly frame: number;
  readonly point: Point;
}

// What connects two points, by what it looks like:
//   rod     a link, an arm, a tie rod          spring  a coil       damper  a tube in a tube
//   strut   coil and damper on one line        hinge   a bush: a short thick piece along its axis
//   body    a bare line that outlines a part of a carrier or an axle
export type LinkKind = "rod" | "spring" | "damper" | "strut" | "hinge" | "body";

export interface Link {
  readonly kind: LinkKind;
  readonly name: string; // "front_left.tie rod"
  readonly a: FramePoint;
  readonly b: FramePoint;
}

// Channel NAME.wheel.spin is its speed about the axis against the carrier [rad/s].
export interface Wheel {
  readonly name: string; // "front_left"
  readonly frame: number; // of its carrier
  readonly center: Point;
  readonly axis: Point; // unit, to the left
  readonly radius: number; // of the tire, unloaded [m]
  readonly width: number; // of one tire [m]
  readonly tires: readonly number[]; // offsets of tires along the axis: [0], or two abreast [m]
}

// Channels NAME.contact.x, .y, .z: the contact's middle on the ground [m]; NAME.ground_force.x, .y, .z: the force of the road
// on the tire, both in ground axes [N].
export interface TireTrace {
  readonly name: string; // "front_left.tire"
}

export interface Scene {
  readonly vehicle: string;
  readonly units: number;
  readonly frames: readonly Frame[];
  readonly links: readonly Link[];
  readonly wheels: readonly Wheel[];
  readonly tires: readonly TireTrace[];
  readonly bodies: readonly { readonly unit: number; readonly low: Point; readonly high: Point }[]; // boxes around the bodywork
  readonly road: RoadScene;
}

// Rectangles on the ground, in ground axes [m].
export interface Rectangle {
  readonly x: readonly [number, number];
  readonly y: readonly [number, number];
}

export interface RoadScene {
  readonly name: string;
  readonly grade: number; // rise over run along x [1]
  readonly bank: number; // along y [1]
  readonly friction: number; // factor [1]
  readonly uneven: boolean; // then tiles tell its height
  readonly patches: readonly (Rectangle & { readonly friction: number })[];
  readonly cones: readonly (readonly [number, number])[]; // x, y [m]
}

// Square patches of an uneven road: tile (ix, iy) reaches from x = 16 ix to 16 (ix + 1), likewise in y, with 65 by 65 heights
// every 0.25 m, row after row along x (index = 65 * row + column; row counts y).
export const tileSize = 16;
export const tileNodes = 65;
export interface RoadTile {
  readonly ix: number;
  readonly iy: number;
  readonly heights: ArrayLike<number>; // above z = 0 [m]
}

export interface Run {
  readonly name: string; // "step steer"
  readonly file: string; // it was read from, or ""
  readonly channels: readonly RecordedChannel[];
  readonly scene: Scene | null; // null: the file holds no motion
  readonly tiles: readonly { readonly ix: number; readonly iy: number; readonly column: ColumnReference }[];
}

export interface Curve {
  readonly label: string; // "" if the only one
  readonly x: ColumnReference;
  readonly y: ColumnReference; // NaN: a gap
  readonly points: boolean; // marks as well as a line
}

export interface Axis {
  readonly label: string; // with its unit: "bump travel [mm]"
  readonly logarithmic: boolean;
}

// Cones on the ground, in the units of the axes.
export interface Cones {
  readonly label: string; // "" if the legend is not to name them
  readonly x: ColumnReference;
  readonly y: ColumnReference;
}

// What stands there optionally is left out where there is none of it.
export interface ChartBlock {
  readonly kind: "chart";
  readonly title: string;
  readonly x: Axis;
  readonly y: Axis;
  readonly curves: readonly Curve[];
  readonly marks: readonly { readonly x: number; readonly label: string }[]; // vertical lines
  readonly horizontal_marks?: readonly { readonly y: number; readonly label: string }[]; // limits
  readonly equal_axes?: boolean; // both axes to one scale, as on a map; neither is logarithmic
  readonly cones?: readonly Cones[];
  readonly lines?: readonly (readonly [number, number, number, number])[]; // barriers: x0, y0, x1, y1
}

export type Cell = string | number | null; // null: does not exist

export interface TableBlock {
  readonly kind: "table";
  readonly title: string;
  readonly columns: readonly { readonly name: string; readonly unit: string }[]; // unit "": none
  readonly rows: readonly (readonly Cell[])[];
}

export interface Verdict {
  readonly criterion: string; // "no cone is hit"
  readonly passed: boolean;
  readonly found: string; // "2 cones"; "" where there is nothing to tell
}

// All of them are to be passed.
export interface VerdictsBlock {
  readonly kind: "verdicts";
  readonly list: readonly Verdict[];
}

export type Block =
  | { readonly kind: "heading"; readonly text: string }
  | { readonly kind: "text"; readonly text: string }
  | ChartBlock
  | TableBlock
  | VerdictsBlock
  | { readonly kind: "replay" }; // all runs of the document: the 3D view with its plots

export interface PageDocument {
  readonly title: string;
  readonly subtitle: string;
  readonly generator: string; // "Hamilcar 0.1.0"
  readonly blocks: readonly Block[];
  readonly runs: readonly Run[];
}

// The document of this page with its block of bytes, its units as people write them; null where the page stands alone (hamilcar drive serves it so).
export interface LoadedDocument {
  readonly document: PageDocument;
  column(reference: ColumnReference): Float64Array | Float32Array;
}

function bytesOf(base64: string): ArrayBuffer {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

export function loadDocument(page: Document): LoadedDocument | null {
  const source = page.getElementById("hamilcar-document")?.textContent?.trim() ?? "";
  if (source === "") return null;
  const block = bytesOf(page.getElementById("hamilcar-columns")?.textContent?.trim() ?? "");
  return {
    document: JSON.parse(raisePowers(source)) as PageDocument,
    column: ({ type, offset, count }) =>
      type === "f64" ? new Float64Array(block, offset, count) : new Float32Array(block, offset, count),
  };
}
