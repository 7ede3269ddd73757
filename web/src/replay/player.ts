// The time that is shown, and how it runs.
export const speeds = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10] as const;

const pictureTime = 1 / 60; // [s]

export class Player {
  time: number;
  playing = false;
  loop = false;
  reverse = false;
  speed = 1;
  onChange: () => void = () => {}; // of anything but the passing of time

  // shortest: between two rows of any run [s]
  constructor(readonly start: number, readonly end: number, private readonly shortest: number) {
    this.time = start;
  }

  // Real time passes; true if the shown time has changed.
  advance(seconds: number): boolean {
    if (!this.playing) return false;
    const before = this.time;
    const next = before + seconds * this.speed * (this.reverse ? -1 : 1);
    if (next >= this.start && next <= this.end) this.time = next;
    else this.turnOver(next);
    return this.time !== before;
  }

  seek(time: number): void {
    this.time = Math.min(Math.max(time, this.start), this.end);
    this.onChange();
  }

  toggle(): void {
    this.playing = !this.playing && this.end > this.start;
    if (this.playing && this.time === this.goal) this.time = this.origin;
    this.onChange();
  }

  // As far as one picture would take it while playing, but at least to the next row.
  step(direction: 1 | -1): void {
    this.playing = false;
    this.seek(this.time + direction * Math.max(this.speed * pictureTime, this.shortest));
  }

  faster(direction: 1 | -1): void {
    const nearest = speeds.findIndex((speed) => speed >= this.speed);
    this.setSpeed(speeds[Math.min(Math.max(nearest + direction, 0), speeds.length - 1)] ?? 1);
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.onChange();
  }

  toggleLoop(): void {
    this.loop = !this.loop;
    this.onChange();
  }

  toggleReverse(): void {
    this.reverse = !this.reverse;
    this.onChange();
  }

  private get origin(): number {
    return this.reverse ? this.end : this.start;
  }
  private get goal(): number {
    return this.reverse ? this.start : this.end;
  }

  private turnOver(next: number): void {
    if (this.loop && this.end > this.start) {
      const length = this.end - this.start;
      this.time = this.start + ((((next - this.start) % length) + length) % length);
      return;
    }
    this.time = this.goal;
    this.playing = false;
    this.onChange();
  }
}
