// What a gamepad's two motors make of the torque on the steering wheel and of tires that slide. A motor that shakes has no direction
// and holds nothing against a thumb: what it tells well is that something changes. So the heavy one takes the fast part of the torque,
// the kickback, in full and its mean in moderation, which leaves room for a kick in the middle of a bend; the light one takes the rest.
import { clamp } from "./held";

export interface Magnitudes {
  readonly strong: number; // of the heavy motor, 0 to 1
  readonly weak: number; // of the light motor, 0 to 1
}

export interface Felt {
  readonly torque: number; // on the steering wheel [N m]; NaN: none
  readonly angle: number; // of the steering wheel [deg]; NaN: none
  readonly slip: number; // of the tire that slides most, 1 at the peak of its force; NaN: none
  readonly antiLock: number; // activity of the anti-lock system, 0 to 1; NaN: none
}

const meanTime = 0.1; // slower is steering, faster is the road [s]
const fadeTime = 0.1; // of what was felt: a kick between two effects is in the second of them [s]
const longestGap = 0.5; // behind a longer one the torque is compared with nothing that was before [s]
const halfKick = 4; // shakes at half of the most: a cleat has some 2 with power assist and 5 without [N m]
const halfMean = 5; // likewise: a brisk bend has some 3 with power assist and 7 without [N m]
const mostOfMean = 0.25;
const halfRate = 100; // of the steering wheel, at which half of the kick counts: who flicks a stick feels no road [deg/s]

// Bounded whatever comes: without power assist a truck has ten times the torque of a car.
const saturated = (x: number, half: number): number => x / (x + half);

const orNothing = (x: number): number => (Number.isFinite(x) ? x : 0);
const part = (x: number): number => clamp(orNothing(x), 0, 1);

export class Rumble {
  private time = NaN; // of the car [s]
  private angle = NaN; // of the steering wheel [deg]
  private mean = 0; // of the torque [N m]
  private kick = 0; // [N m]
  private weak = 0;

  // In order of the car's time; one that runs backward starts anew, and so does one behind a gap.
  follow(time: number, felt: Felt): Magnitudes {
    const torque = orNothing(felt.torque);
    const seconds = time - this.time;
    const rate = Math.abs((felt.angle - this.angle) / seconds);
    this.time = time;
    this.angle = felt.angle;
    if (seconds >= 0 && seconds <= longestGap) this.wait(seconds, torque);
    else this.begin(torque);
    const byRoad = 1 - saturated(orNothing(rate), halfRate);
    this.kick = Math.max(this.kick, byRoad * Math.abs(torque - this.mean));
    this.weak = Math.max(this.weak, part(felt.slip - 1), part(felt.antiLock));
    const ofMean = mostOfMean * saturated(Math.abs(this.mean), halfMean);
    return { strong: Math.min(saturated(this.kick, halfKick) + ofMean, 1), weak: this.weak };
  }

  private begin(torque: number): void {
    this.mean = torque;
    this.kick = this.weak = 0;
  }

  private wait(seconds: number, torque: number): void {
    this.mean += (torque - this.mean) * (1 - Math.exp(-seconds / meanTime));
    const left = Math.exp(-seconds / fadeTime);
    this.kick *= left;
    this.weak *= left;
  }
}
