// Gears, driveline, aids and courses of the simulator, before a server that the test plays itself.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Browser, Locator, Page } from "playwright-core";
import type {
  CarMessage, Channel, ChannelRole, ClientMessage, CourseResult, Driveline, InputMessage, ServerMessage, Status,
} from "../src/contract";
import { openBrowser, patience } from "./browser";
import { temporaryFolder } from "./program";
import { FakeServer, shell } from "./shell";

declare const window: { hamilcar?: { textsTime(): number } };

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

// What a channel is stands in its role; names are only read.
const channel = (name: string, role: ChannelRole, of = "", unit = "1"): Channel => ({ name, unit, description: "", role, of });
const channels: readonly Channel[] = [
  ...(["x", "y", "z", "qw", "qx", "qy", "qz"] as const).map((end) => channel(`chassis.pose.${end}`, `pose_${end}`, "chassis")),
  channel("chassis.longitudinal_velocity", "longitudinal_velocity"),
  channel("chassis.lateral_velocity", "lateral_velocity"),
  channel("input.steering_torque", "steering_torque", "", "N m"),
  channel("engine.speed", "rotor_speed", "engine", "rpm"),
  channel("engine.torque", "rotor_torque", "engine", "N m"),
  channel("engine.throttle", "unit_throttle", "engine"),
  channel("engine.gear", "gear", "engine"),
  channel("engine.clutch_torque", "clutch_torque", "engine", "N m"),
  channel("abs.activity", "controller_activity", "abs"),
  channel("slope_help.activity", "controller_activity", "slope_help"),
  channel("front_left.brake.pressure", "brake_pressure", "front_left", "bar"),
  channel("front_left.tire.vertical_force", "vertical_force", "front_left.tire", "N"),
  channel("front_left.tire.slip_angle", "slip_angle", "front_left.tire", "deg"),
];
const driveline: Driveline = {
  units: [{ name: "engine", idle: 800, max: 6400 }], gears: 5, reverse: true, clutch: true, automatic: false,
};
const car: CarMessage = {
  type: "car", car: 1, vehicle: "a", road: "maneuver:double_lane_change", friction: 1, steering_lock_deg: 500,
  gravity_m_per_s2: 9.81, channels,
  scene: {
    vehicle: "a car", units: 1, frames: [{ name: "chassis", unit: 0 }], links: [],
    wheels: [{ name: "front_left", frame: 0, center: [1.3, 0.7, 0.3], axis: [0, 1, 0], radius: 0.3, width: 0.2, tires: [0] }],
    tires: [{ name: "front_left.tire" }],
    bodies: [{ unit: 0, low: [-2, -0.8, 0.2], high: [2, 0.8, 1.4] }],
    road: { name: "level", grade: 0, bank: 0, friction: 1, uneven: false, patches: [], cones: [[5, 2]] },
  },
  driveline,
  aids: [{ keyword: "abs", meaning: "keeps wheels from locking" }, { keyword: "slope_help", meaning: "holds it" }],
  course: {
    id: "double_lane_change", name: "ISO 3888-1", title: "Double lane change", summary: "Through the cones.",
    cones: [[5, 2], [5, -2]], boundaries: [[5, 2, 20, 2], [5, -2, 20, -2]], line: [[0, 0], [20, 0], [50, 3.5]],
  },
};
const status: Status = {
  type: "status", driver: 1, pages: 1, paused: "", ended: "", pace: 1, time: 0, switched_off: [], steps: 0, step_ms: 1, period_ms: 1,
  compute_us: 10, worst_overrun_ms: 0, overruns: 0, recording: "", recorded_s: 0, lost_rows: 0, lost_frames: 0,
};
const hello: ServerMessage = {
  type: "hello", generator: "test", page: 1, vehicles: [{ id: "a", name: "A", course: false }],
  roads: [
    { id: "level", name: "Level", course: false },
    { id: "maneuver:double_lane_change", name: "Double lane change", course: true },
  ],
};
const result: CourseResult = {
  type: "result", course: "double_lane_change", finished: true, passed: false, time: 12.345,
  values: [
    { name: "entry speed", unit: "km/h", value: 63.21, meaning: "at the first gate" },
    { name: "peak sideslip", unit: "deg", value: null, meaning: "" },
  ],
  verdicts: [
    { criterion: "no boundary is crossed", passed: true, found: "" },
    { criterion: "no cone is hit", passed: false, found: "2 cones" },
  ],
};
const still = { "chassis.pose.qw": 1, "engine.speed": 2345, "engine.torque": 100, "engine.gear": 2 };

async function open(of: CarMessage): Promise<{ page: Page; server: FakeServer; complaints: string[] }> {
  const page = await browser.newPage();
  page.setDefaultTimeout(patience);
  const complaints: string[] = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  const server = new FakeServer([hello, of, status]);
  await server.serve(page, html);
  await page.goto(server.url);
  await page.waitForFunction(() => document.body.innerText.includes("You drive"), undefined);
  server.show(of, 1, still);
  await page.waitForSelector("html[data-ready=true]", { state: "attached" });
  await showsTexts(page, 1);
  return { page, server, complaints };
}

// The instruments show the frame of that time.
const showsTexts = (page: Page, time: number) =>
  page.waitForFunction((shown) => window.hamilcar?.textsTime() === shown, time);

const isInput = (message: ClientMessage): message is InputMessage => message.type === "input";
const isSwitch = ({ type }: ClientMessage): boolean => type === "switch";
async function wants(page: Page, server: FakeServer, key: string, selector: string, gear: number): Promise<void> {
  await page.keyboard.press(key);
  const reverse = selector === "reverse";
  await server.hears(`${selector} ${gear} after ${key}`, (message) =>
    isInput(message) && message.selector === selector && message.gear === gear && message.reverse === reverse);
}

test("keys shift, choose and hold the clutch", async () => {
  const { page, server, complaints } = await open(car);
  await wants(page, server, "e", "manual", 3); // from the second gear, which is in
  await wants(page, server, "e", "manual", 4);
  await wants(page, server, "q", "manual", 3);
  await wants(page, server, "g", "neutral", 1);
  await wants(page, server, "g", "reverse", 1);
  await wants(page, server, "g", "drive", 1);
  await wants(page, server, "r", "reverse", 1);
  await wants(page, server, "e", "neutral", 1);
  await wants(page, server, "e", "manual", 1);
  await page.keyboard.down("c");
  await server.hears("a pressed clutch", (message) => isInput(message) && message.clutch === 1);
  await page.keyboard.up("c");
  await server.hears("a clutch let go", (message) => isInput(message) && message.clutch === 0);
  await wants(page, server, "g", "neutral", 1);
  server.show(car, 2, { ...still, "chassis.longitudinal_velocity": 8 });
  await showsTexts(page, 2);
  await page.keyboard.press("q"); // no reverse while it rolls ahead
  await page.getByText("Reverse goes in at a standstill.").waitFor();
  await server.hears("neutral still", (message) => isInput(message) && message.selector === "neutral");
  assert.ok(!server.heard.slice(-3).some((message) => isInput(message) && message.reverse));
  await page.getByRole("button", { name: /^Selector: neutral/ }).click();
  await server.hears("drive", (message) => isInput(message) && message.selector === "drive");
  await page.close();
  assert.deepEqual(complaints, []);
});

const isOn = (aid: Locator) => aid.getAttribute("aria-checked");

test("an aid lights while it intervenes, and a press or a key switches it", async () => {
  const { page, server, complaints } = await open(car);
  const abs = page.getByRole("switch", { name: "ABS" });
  const unknown = page.getByRole("switch", { name: "slope help" }); // not one that the page knows
  assert.deepEqual([await isOn(abs), await isOn(unknown)], ["true", "true"]);
  server.show(car, 2, { ...still, "abs.activity": 0.25, "front_left.brake.pressure": 61.234 });
  await showsTexts(page, 2);
  const isLit = (aid: Locator) => aid.evaluate((lamp) => lamp.classList.contains("lit"));
  assert.deepEqual([await isLit(abs), await isLit(unknown)], [true, false]);
  const wheel = page.getByRole("region", { name: "Wheels" }).getByRole("row", { name: "front left" });
  assert.equal(await wheel.getByRole("cell").last().innerText(), "61.2");
  server.show(car, 3, still);
  await showsTexts(page, 3);
  assert.equal(await isLit(abs), false);

  await abs.click();
  assert.deepEqual(await server.hears("a switch", isSwitch), { type: "switch", aid: "abs", on: false });
  assert.equal(await isOn(abs), "true"); // until the program says so
  server.say({ ...status, switched_off: ["abs"] });
  await page.locator("[role=switch][aria-checked=false]").waitFor();
  assert.deepEqual([await isOn(abs), await isOn(unknown)], ["false", "true"]);
  await page.keyboard.press("6");
  assert.deepEqual(await server.hears("a switch", isSwitch), { type: "switch", aid: "abs", on: true });
  await page.keyboard.press("7");
  assert.deepEqual(await server.hears("a switch", isSwitch), { type: "switch", aid: "slope_help", on: false });
  await page.close();
  assert.deepEqual(complaints, []);
});

test("instruments show what the car has", async () => {
  const { page, complaints } = await open(car);
  const dashboard = page.getByRole("region", { name: "Dashboard" });
  await dashboard.getByText("2350").waitFor();
  assert.match(await dashboard.innerText(), /25 kW/); // 100 N m at 2345 rpm
  assert.match(await dashboard.getByRole("button", { name: /^Selector: drive, gear 2/ }).innerText(), /D2/);
  assert.ok(await dashboard.getByText("steering torque").isVisible());
  await page.close();

  const { driveline: _driveline, course: _course, ...simple } = car;
  const plain = await open({ ...simple, aids: [], channels: car.channels.filter(({ name }) => /^chassis/.test(name)) });
  const others = plain.page.getByRole("region", { name: "Dashboard" });
  assert.equal(await plain.page.getByRole("group", { name: "Aids" }).isVisible(), false);
  assert.equal(await plain.page.getByRole("columnheader", { name: "brake" }).isVisible(), false);
  for (const text of ["rpm", "steering torque"]) assert.equal(await others.getByText(text).isVisible(), false, text);
  await plain.page.keyboard.press("r");
  const sent = await plain.server.hears("reverse", (message) => isInput(message) && message.reverse);
  assert.deepEqual(["selector" in sent, "clutch" in sent], [false, false]);
  await plain.page.close();
  assert.deepEqual([...complaints, ...plain.complaints], []);
});

test("a wheel that stands has no angle of slip", async () => {
  const { page, server, complaints } = await open(car);
  const cell = page.getByRole("region", { name: "Wheels" }).getByRole("row", { name: "front left" }).getByRole("cell").nth(2);
  const slipping = { ...still, "front_left.tire.vertical_force": 3000, "front_left.tire.slip_angle": 2.5 };
  server.show(car, 2, { ...slipping, "chassis.longitudinal_velocity": 0.3 });
  await showsTexts(page, 2);
  assert.equal(await cell.innerText(), "–");
  server.show(car, 3, { ...slipping, "chassis.longitudinal_velocity": 0.3, "chassis.lateral_velocity": 0.5 });
  await cell.getByText("2.5").waitFor();
  await page.close();
  assert.deepEqual(complaints, []);
});

test("the last number of the tachometer is whole", async () => {
  const units = [{ name: "engine", idle: 800, max: 4720 }]; // the scale ends right behind 5000
  const { page } = await open({ ...car, driveline: { ...driveline, units } });
  const cut = await page.$$eval(".scale .tick", (ticks) => {
    const last = ticks.at(-1) as HTMLElement;
    const scale = last.closest(".scale") as HTMLElement;
    const clips = getComputedStyle(scale).overflow !== "visible";
    return clips && last.getBoundingClientRect().right > scale.getBoundingClientRect().right;
  });
  assert.equal(cut, false);
  await page.close();
});

test("a course is chosen from the menu, told, and ends with its result", async () => {
  const { page, server, complaints } = await open(car);
  assert.match(await page.getByRole("region", { name: "Car and road" }).innerText(), /Double lane change: Through the cones/);
  const named = await open({ ...car, scene: { ...car.scene, road: { ...car.scene.road, name: "Double lane change" } } });
  const plate = await named.page.getByRole("region", { name: "Car and road" }).innerText();
  assert.equal(plate.split("Double lane change").length, 2, "the title stands there once");
  await named.page.close();
  await page.keyboard.press("m");
  const groups = await page.$$eval("select[name=road] optgroup", (all) => all.map((one) => (one as HTMLOptGroupElement).label));
  assert.deepEqual(groups, ["Roads", "Courses"]);
  await page.keyboard.press("Escape");

  const card = page.getByRole("region", { name: "Double lane change: not passed" });
  server.say({ ...result, course: "another" });
  server.say(result);
  await card.waitFor();
  const text = await card.innerText();
  assert.match(text, /12\.35 s|12\.34 s/);
  assert.match(text, /not passed\s+no cone is hit: 2 cones/);
  assert.match(text, /entry speed\s+at the first gate\s+63\.21 km\/h/);
  assert.match(text, /peak sideslip\s+–/);
  assert.match((await page.locator("[aria-live=polite]").textContent()) ?? "", /not passed.*no cone is hit: not passed/);
  await card.getByRole("button", { name: "Again" }).click();
  await server.hears("a reset", ({ type }) => type === "reset");
  assert.equal(await card.isVisible(), false);

  const untouched = { criterion: "no cone is hit", passed: null, found: "" };
  server.say({ ...result, finished: false, verdicts: [untouched] });
  const unfinished = page.getByRole("region", { name: "Double lane change: not finished" });
  assert.match(await unfinished.getByRole("listitem").innerText(), /^\s*not judged\s+no cone is hit\s*$/);
  assert.equal(await unfinished.locator(".passed").count(), 0);

  server.say({ ...result, passed: true });
  await page.getByRole("region", { name: "Double lane change: passed" }).waitFor();
  server.show(car, 0.01, still); // another page has put the car back
  await page.waitForFunction(() => document.querySelector<HTMLElement>("[aria-labelledby=result-title]")?.hidden);
  await page.close();
  assert.deepEqual(complaints, []);
});
