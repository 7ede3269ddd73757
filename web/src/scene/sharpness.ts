// Weak machines get fewer pixels rather than fewer pictures.

const enough = 1 / 40; // between pictures that follow each other [s]
const paused = 0.25; // longer than that nobody was drawing [s]
const patience = 20; // slow pictures in a row, less the quick ones
const least = 0.5; // pixels of ours to one of the page

export class Sharpness {
  private share = 1;
  private slow = 0;

  // Pixels to draw for one of the page.
  get ratio(): number {
    return Math.max(Math.min(devicePixelRatio, 2) * this.share, Math.min(least, devicePixelRatio));
  }

  // True if from now on there are fewer; seconds: since the last picture.
  observe(seconds: number): boolean {
    if (seconds > paused) return false;
    this.slow = Math.max(this.slow + (seconds > enough ? 1 : -1), 0);
    if (this.slow < patience || this.ratio <= least) return false;
    this.slow = 0;
    this.share *= 0.75;
    return true;
  }
}
