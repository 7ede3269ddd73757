// What browser tests may ask the page.
import type { Latency } from "./latency";
import type { LinkState } from "./link";
import type { Picture } from "./picture";
import type { Role, Session } from "./session";

export interface Hooks {
  latencies(): number[]; // input to picture, the last 50 [ms]
  speed(): number; // ahead [m/s]
  time(): number; // simulated [s]
  role(): Role;
  state(): LinkState;
  row(name: string): number; // a channel of the frame drawn last; NaN if there is none
  framesDrawn(): number;
}

declare global {
  interface Window {
    hamilcar?: Hooks;
  }
}

export function offerHooks(session: Session, picture: Picture, latency: Latency): void {
  const row = (name: string): number => session.frame?.value(name) ?? NaN;
  window.hamilcar = {
    latencies: () => latency.all(),
    speed: () => row("chassis.longitudinal_velocity"),
    time: () => session.frame?.time ?? NaN,
    role: () => session.role,
    state: () => session.linkState,
    row,
    framesDrawn: () => picture.framesDrawn,
  };
}
