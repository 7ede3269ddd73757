// From a key to the picture that shows its effect: the input's number goes to the program and comes back with the first
// frame that has felt it; the clock stops when that frame is drawn.

const kept = 50;
const forgotten = 2000; // an input that has no effect by then never had one: it fell into a pause [ms]

export class Latency {
  private readonly waiting: { sequence: number; at: number }[] = [];
  private readonly samples: number[] = [];
  felt = 0; // inputs so far, however late

  pressed(sequence: number, at: number): void {
    this.waiting.push({ sequence, at });
  }

  // The drawn picture has felt the inputs of this page up to `sequence`.
  drawn(sequence: number, now: number): void {
    while (this.waiting[0] && this.waiting[0].sequence <= sequence) {
      const age = now - this.waiting[0].at;
      this.waiting.shift();
      this.felt += 1;
      if (age < forgotten) this.samples.push(age);
    }
    if (this.samples.length > kept) this.samples.splice(0, this.samples.length - kept);
  }

  forget(): void {
    this.waiting.length = 0;
  }

  all(): number[] {
    return [...this.samples];
  }

  // [ms]; null before the first
  summary(): { readonly min: number; readonly median: number; readonly max: number } | null {
    const sorted = this.all().sort((a, b) => a - b);
    const at = (part: number): number => sorted[Math.floor(part * (sorted.length - 1))] ?? 0;
    return sorted.length === 0 ? null : { min: at(0), median: at(0.5), max: at(1) };
  }
}
