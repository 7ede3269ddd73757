// How a person holds wheel and pedals, whatever with.

export interface Held {
  readonly steer: number; // -1 full right to 1 full left
  readonly throttle: number; // 0 to 1
  readonly brake: number; // 0 to 1
  readonly clutch: number; // 0 to 1
}
export const letGo: Held = { steer: 0, throttle: 0, brake: 0, clutch: 0 };

export const clamp = (x: number, low: number, high: number): number => Math.min(Math.max(x, low), high);

export const apart = (a: Held, b: Held): number =>
  Math.max(
    Math.abs(a.steer - b.steer),
    Math.abs(a.throttle - b.throttle),
    Math.abs(a.brake - b.brake),
    Math.abs(a.clutch - b.clutch),
  );
