// Weak machines get fewer pixels rather than fewer pictures, and all of them once nothing moves.

const enough = 1 / 40; // between pictures that follow each other [s]
export const paused = 0.25; // longer than that nobody was drawing [s]
const patience = 20; // slow pictures in a row, less the quick ones
const minRatio = 0.5; // pixels of ours to one of the page

// Whether pictures are drawn by the processor: then smooth edges would halve their number.
export function drawsInSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  if (context === null) return false;
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = info === null ? "" : String(context.getParameter(info.UNMASKED_RENDERER_WEBGL));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

export class Sharpness {
  private share = 1;
  private slow = 0;
  private resting = false;

  // Pixels to draw for one of the page.
  get ratio(): number {
    const share = this.resting ? 1 : this.share;
    return Math.max(Math.min(devicePixelRatio, 2) * share, Math.min(minRatio, devicePixelRatio));
  }

  // Nothing moves any more. True if there are more pixels now.
  rest(): boolean {
    this.resting = true;
    return this.share < 1;
  }

  // True if from now on there are fewer; seconds: since the last picture.
  observe(seconds: number): boolean {
    if (seconds > paused) return false;
    if (this.resting) {
      this.resting = false;
      return this.share < 1;
    }
    this.slow = Math.max(this.slow + (seconds > enough ? 1 : -1), 0);
    if (this.slow < patience || this.ratio <= minRatio) return false;
    this.slow = 0;
    this.share *= 0.75;
    return true;
  }
}
