// What a gamepad's motors make of a torque over time: against closed forms of a step and of a ramp, and what must hold for any torque.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Rumble, type Magnitudes } from "../src/live/rumble";

const frame = 1 / 60; // [s]
const calm = { torque: 0, angle: 0, slip: 0, antiLock: 0 };

const near = (found: number, expected: number, tolerance: number): void =>
  assert.ok(Math.abs(found - expected) <= tolerance, `${found} is not ${expected} within ${tolerance}`);

// The torque over time [s], at each frame [N m].
function shaken(torque: (time: number) => number, seconds: number, interval = frame): Magnitudes[] {
  const rumble = new Rumble();
  const frames = Array.from({ length: Math.round(seconds / interval) }, (_, i) => i * interval);
  return frames.map((time) => rumble.follow(time, { ...calm, torque: torque(time) }));
}
const last = (all: readonly Magnitudes[]): Magnitudes => all.at(-1) ?? { strong: NaN, weak: NaN };
const most = (all: readonly Magnitudes[]): number => Math.max(...all.map(({ strong }) => strong));

test("a torque that stays is felt in moderation, the same to both sides", () => {
  for (const side of [1, -1]) {
    const bend = last(shaken(() => 5 * side, 3));
    near(bend.strong, 0.25 / 2, 1e-9); // half of a quarter
    assert.equal(bend.weak, 0);
  }
  assert.ok(most(shaken(() => 300, 3)) < 0.25);
  assert.deepEqual(last(shaken(() => 0, 1)), { strong: 0, weak: 0 });
});

test("a step is felt at once and dies away with its time", () => {
  const step = 8; // [N m]
  const felt = shaken((time) => (time < 1 ? 0 : step), 3, 0.001);
  near(felt[1000]?.strong ?? NaN, step / (step + 4), 0.01); // all of it is fast
  const left = step * Math.exp(-0.2 / 0.1);
  const mean = step - left;
  near(felt[1200]?.strong ?? NaN, left / (left + 4) + (0.25 * mean) / (mean + 5), 0.01);
  near(last(felt).strong, (0.25 * step) / (step + 5), 1e-3);
});

test("steering slowly is no kick", () => {
  const rate = 3; // [N m/s]
  const ramp = last(shaken((time) => rate * time, 2, 0.001));
  const [lag, mean] = [rate * 0.1, rate * (2 - 0.1)]; // of the mean behind a ramp
  near(ramp.strong, lag / (lag + 4) + (0.25 * mean) / (mean + 5), 0.01);
});

test("the faster the driver turns the wheel, the less counts as a kick", () => {
  const turned = (rate: number): number => {
    const rumble = new Rumble();
    rumble.follow(0, calm);
    return rumble.follow(1e-4, { ...calm, torque: 8, angle: -1e-4 * rate }).strong; // so soon that the mean is 0 still
  };
  near(turned(0), 8 / (8 + 4), 0.01);
  near(turned(100), 4 / (4 + 4), 0.01); // half of it
  near(turned(900), 0.8 / (0.8 + 4), 0.01);
});

test("a kick is still there at the next effect, whatever the frame rate", () => {
  const kick = (time: number): number => (time >= 1 && time < 1.03 ? 6 : 0);
  for (const interval of [0.01, 1 / 60, 1 / 40]) {
    const felt = shaken(kick, 2, interval);
    const between = Math.ceil(0.05 / interval);
    const at = felt.findIndex(({ strong }) => strong === most(felt));
    assert.ok(most(felt) > 0.5, `${most(felt)} every ${interval} s`);
    assert.ok((felt[at + between]?.strong ?? 0) > 0.6 * most(felt), `every ${interval} s`);
    assert.ok(last(felt).strong < 0.02, `every ${interval} s`);
  }
});

test("more is felt as more, and nothing is beyond the motors", () => {
  const sizes = [0.5, 1, 2, 5, 10, 100, 1e6].map((size) => most(shaken((time) => size * Math.sin(60 * time), 2)));
  assert.deepEqual(sizes, [...sizes].sort((a, b) => a - b));
  assert.ok(sizes.every((size) => size > 0 && size <= 1));
});

test("time that runs backward, stands or jumps starts anew without a kick", () => {
  const rumble = new Rumble();
  const at = (time: number, torque: number): number => rumble.follow(time, { ...calm, torque }).strong;
  at(1000, 0);
  at(1000.1, 20);
  near(at(0, 5), 0.125, 1e-9); // back at the start
  near(at(0, 5), 0.125, 1e-9); // the same frame once more
  near(at(7, -5), 0.125, 1e-9);
  assert.ok(at(7.1, 5) > 0.3);
  const turned = rumble.follow(6.6, { ...calm, angle: 50 }); // by 100 deg/s backward
  assert.deepEqual(turned, { strong: 0, weak: 0 });
});

test("a car without the channel, or one whose run breaks, leaves the motors at rest", () => {
  const rumble = new Rumble();
  for (const [i, lost] of [NaN, Infinity, -Infinity].entries()) {
    assert.deepEqual(rumble.follow(i * frame, { torque: lost, angle: lost, slip: NaN, antiLock: lost }), { strong: 0, weak: 0 });
  }
});

test("the light motor tells of tires beyond their peak and of the anti-lock system", () => {
  const weak = (slip: number, antiLock: number): number => new Rumble().follow(0, { ...calm, slip, antiLock }).weak;
  assert.deepEqual([weak(0.9, 0), weak(1, 0), weak(1.5, 0), weak(9, 0)], [0, 0, 0.5, 1]);
  assert.deepEqual([weak(0, 0.25), weak(1.1, 0.75), weak(0, 5)], [0.25, 0.75, 1]);
  const rumble = new Rumble();
  rumble.follow(0, { ...calm, antiLock: 1 });
  near(rumble.follow(0.1, calm).weak, Math.exp(-1), 1e-9);
});
