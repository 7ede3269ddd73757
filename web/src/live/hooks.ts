// What browser tests may ask the page.
import type { Latency } from "./latency";
import type { LinkState } from "./link";
import type { Picture } from "./picture";
import type { Status } from "../contract";
import type { Role, Session } from "./session";

export interface Hooks {
  latencies(): number[]; // input to picture, the last 50 [ms]
  speed(): number; // ahead [m/s]
  time(): number; // simulated [s]
  role(): Role;
  state(): LinkState;
  row(name: string): number; // a channel of the frame drawn last; NaN if there is none
  framesDrawn(): number;
  textsTime(): number; // of the frame that instruments show in words [s]
  felt(): number; // inputs whose effect has been drawn, however late
  statuses(): number; // received so far
  status(): Status | null; // the last one
}

declare global {
  interface Window {
    hamilcar?: Hooks;
  }
}

export function offerHooks(session: Session, picture: Picture, latency: Latency, textsTime: () => number): void {
  const row = (name: string): number => session.frame?.named(name) ?? NaN;
  window.hamilcar = {
    latencies: () => latency.all(),
    speed: () => session.frame?.reader("longitudinal_velocity")() ?? NaN,
    time: () => session.frame?.time ?? NaN,
    role: () => session.role,
    state: () => session.linkState,
    row,
    framesDrawn: () => picture.framesDrawn,
    textsTime,
    felt: () => latency.felt,
    statuses: () => session.statuses,
    status: () => session.status,
  };
}
