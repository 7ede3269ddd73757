// Force feedback: the gamepad that drives vibrates, before a server and with a gamepad of the test's own.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";
import type { CarMessage, Channel, ChannelRole, ClientMessage, ServerMessage, Status } from "../src/contract";
import { openBrowser, patience } from "./browser";
import { temporaryFolder } from "./program";
import { FakeServer, shell } from "./shell";

type Kind = "two motors" | "one motor" | "no motor" | "refuses" | "throws";
interface Effect {
  readonly at: number; // [ms]
  readonly type: string;
  readonly strong: number;
  readonly weak: number;
  readonly duration: number; // [ms]
}
declare const window: {
  hamilcar: { time(): number };
  effects: Effect[];
  pad: { axes: number[] };
};

const folder = temporaryFolder();
let browser: Browser;
let html: string;

before(async () => {
  browser = await openBrowser();
  html = shell(folder.path);
});
after(async () => {
  await browser.close();
  folder.remove();
});

const channel = (name: string, role: ChannelRole, of = ""): Channel => ({ name, unit: "1", description: "", role, of });
const car: CarMessage = {
  type: "car", car: 1, vehicle: "a", road: "level", friction: 1, steering_lock_deg: 500, gravity_m_per_s2: 9.81,
  channels: [
    channel("speed", "longitudinal_velocity"),
    channel("drift", "lateral_velocity"),
    channel("torque", "steering_torque"),
    channel("abs", "controller_activity", "abs"),
    channel("load", "vertical_force", "left.tire"),
    channel("angle", "slip_angle", "left.tire"),
    channel("slip", "longitudinal_slip", "left.tire"),
  ],
  scene: {
    vehicle: "a car", units: 1, frames: [{ name: "chassis", unit: 0 }], links: [], wheels: [], tires: [{ name: "left.tire" }],
    bodies: [], road: { name: "level", grade: 0, bank: 0, friction: 1, uneven: false, patches: [], cones: [] },
  },
  aids: [],
};
const status: Status = {
  type: "status", driver: 1, pages: 1, paused: "", ended: "", pace: 1, time: 0, switched_off: [], steps: 0, step_ms: 1, period_ms: 1,
  compute_us: 10, worst_overrun_ms: 0, overruns: 0, recording: "", recorded_s: 0, lost_rows: 0, lost_frames: 0,
};
const hello: ServerMessage = { type: "hello", generator: "test", page: 1, vehicles: [], roads: [] };

// In the page: one gamepad, whose motors write down what they are told.
function plugIn(kind: Kind): void {
  window.effects = [];
  const tell = (type: string, strong: number, weak: number, duration: number): Promise<unknown> => {
    window.effects.push({ at: performance.now(), type, strong, weak, duration });
    if (kind === "throws") throw new Error("no");
    return kind === "refuses" ? Promise.reject(new Error("no")) : Promise.resolve("complete");
  };
  const playEffect = (type: string, { strongMagnitude = NaN, weakMagnitude = NaN, duration = NaN }: GamepadEffectParameters) =>
    tell(type, strongMagnitude, weakMagnitude, duration);
  const pulse = (strength: number, duration: number) => tell("pulse", strength, 0, duration);
  const button = { pressed: false, touched: false, value: 0 };
  const motors = {
    ...(kind === "one motor" ? { hapticActuators: [{ pulse }] } : {}),
    vibrationActuator: kind === "one motor" || kind === "no motor" ? null : { playEffect },
  };
  const pad = { id: "test", index: 0, connected: true, mapping: "standard", timestamp: 0, axes: [0, 0], buttons: Array(17).fill(button) };
  window.pad = Object.assign(pad, motors);
  navigator.getGamepads = () => [pad as unknown as Gamepad];
}

class Drive {
  readonly complaints: string[] = [];
  readonly server = new FakeServer([hello, car, status]);
  private time = 0; // [s]

  constructor(readonly page: Page) {}

  async open(kind: Kind): Promise<void> {
    this.page.setDefaultTimeout(patience);
    this.page.on("pageerror", (error) => this.complaints.push(error.message));
    await this.page.addInitScript(plugIn, kind);
    await this.server.serve(this.page, html);
    await this.page.goto(this.server.url);
    await this.page.getByText("You drive").waitFor();
  }

  async steerByPad(): Promise<void> {
    await this.page.evaluate(() => void (window.pad.axes[0] = -0.9));
    await this.server.hears("the pad", (message: ClientMessage) => message.type === "input" && message.device === "axes");
  }

  // The effects of frames that show these values for so long that several are due.
  async feel(values: Readonly<Record<string, number>>): Promise<Effect[]> {
    const start = await this.page.evaluate(() => ((window.effects = []), performance.now()));
    for (let now = start, frames = 0; now < start + 200 || frames < 5; ++frames) {
      this.time += 0.02;
      this.server.show(car, this.time, { speed: 20, ...values });
      await this.page.waitForFunction((time) => window.hamilcar.time() === time, this.time);
      now = await this.page.evaluate(() => performance.now());
    }
    return this.page.evaluate(() => window.effects);
  }

  // Three frames at once, of which a picture shows the last one.
  kick(): void {
    for (const torque of [0, 20, 0]) this.server.show(car, (this.time += 0.01), { speed: 20, torque });
  }
}

async function drive(kind: Kind): Promise<Drive> {
  const made = new Drive(await browser.newPage());
  await made.open(kind);
  return made;
}

test("the pad that drives feels the torque, a tire that slides and the anti-lock system, at most 20 times a second", async () => {
  const it = await drive("two motors");
  assert.deepEqual(await it.feel({ torque: 20 }), [], "keys drive: it lies on the table");
  await it.steerByPad();
  const torque = await it.feel({ torque: 20 });
  assert.ok(torque.length >= 2, `${torque.length} effects`);
  for (const { type, strong, weak, duration } of torque) {
    assert.ok(strong > 0.1 && strong <= 1 && weak === 0, `${strong}, ${weak}`);
    assert.ok(type === "dual-rumble" && duration > 50 && duration <= 200, `${type}, ${duration} ms`);
  }
  torque.slice(1).forEach(({ at }, i) => assert.ok(at - (torque[i]?.at ?? 0) > 45, "too many effects"));
  const last = async (values: Readonly<Record<string, number>>) => (await it.feel(values)).at(-1);
  assert.equal((await last({ abs: 0.5 }))?.weak, 0.5);
  assert.ok(((await last({ load: 3000, angle: -15 }))?.weak ?? 0) >= 0.5);
  assert.equal((await last({ load: 3000, slip: -1 }))?.weak, 1);
  while ((await it.feel({})).length > 0); // all of it dies away
  for (const calm of [{}, { load: 3000, angle: 5 }, { load: 0, slip: -1 }, { load: 3000, slip: -1, speed: 0 }]) {
    assert.deepEqual(await it.feel(calm), [], JSON.stringify(calm));
  }
  it.kick();
  await it.page.waitForFunction(() => window.effects.some(({ strong }) => strong > 0.5));
  await it.page.close();
  assert.deepEqual(it.complaints, []);
});

test("the switch, another driver and a hidden page keep the pad still", async () => {
  const it = await drive("two motors");
  const feels = async (): Promise<boolean> => (await it.feel({ torque: 20 })).length > 0;
  await it.steerByPad();
  assert.equal(await feels(), true);
  await it.page.keyboard.press("v");
  await it.page.getByText("Force feedback is off.").waitFor();
  assert.equal(await feels(), false);
  await it.page.reload(); // it is remembered
  await it.page.getByText("You drive").waitFor();
  await it.steerByPad();
  assert.equal(await feels(), false);
  await it.page.keyboard.press("m");
  await it.page.getByRole("group", { name: "Force feedback" }).getByRole("button", { name: "On", pressed: false }).click();
  assert.equal(await feels(), true);
  it.server.say({ ...status, driver: 2 });
  await it.page.getByText("Page 2 drives").waitFor();
  assert.equal(await feels(), false);
  it.server.say(status);
  await it.page.getByText("You drive").waitFor();
  assert.equal(await feels(), true);
  await it.page.evaluate(() => Object.defineProperty(document, "hidden", { get: () => true }));
  assert.equal(await feels(), false);
  await it.page.close();
  assert.deepEqual(it.complaints, []);
});

test("one motor pulses, none is none, and one that refuses disturbs no picture", async () => {
  const effects = async (kind: Kind): Promise<Effect[]> => {
    const it = await drive(kind);
    await it.steerByPad();
    const felt = await it.feel({ torque: 20 });
    await it.page.close();
    assert.deepEqual(it.complaints, [], kind);
    return felt;
  };
  const pulses = await effects("one motor");
  assert.ok(pulses.length > 0 && pulses.every(({ type, strong }) => type === "pulse" && strong > 0.1 && strong <= 1));
  assert.deepEqual(await effects("no motor"), []);
  for (const kind of ["refuses", "throws"] as const) assert.ok((await effects(kind)).length > 1, kind);
});
