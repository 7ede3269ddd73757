// The car's horizontal acceleration as a dot in a circle, as the driver feels it seen from above: ahead is up.
import { element } from "../dom";
import { color, onThemeChange } from "../theme";

const size = 116; // [px]
const edge = 1.25; // [g]
const middle = size / 2;
const scale = (middle - 5) / edge; // [px/g]
const trailLength = 90; // pictures

export class GravityCircle {
  readonly root = element("canvas", {
    class: "gravity",
    role: "img",
    "aria-label": "Acceleration: up is ahead, rings at 0.5 and 1 g",
  });
  private readonly pen: CanvasRenderingContext2D | null;
  private readonly trail: (readonly [number, number])[] = [];
  private readonly still = matchMedia("(prefers-reduced-motion: reduce)");

  constructor() {
    this.root.width = this.root.height = size * devicePixelRatio;
    this.pen = this.root.getContext("2d");
    this.pen?.scale(devicePixelRatio, devicePixelRatio);
    onThemeChange(() => this.draw());
    this.draw();
  }

  clear(): void {
    this.trail.length = 0;
    this.draw();
  }

  // In g, ahead and to the left.
  show(ahead: number, left: number): void {
    if (!Number.isFinite(ahead) || !Number.isFinite(left)) return;
    const within = Math.min(1, edge / Math.hypot(ahead, left));
    this.trail.push([within * ahead, within * left]);
    if (this.trail.length > trailLength) this.trail.shift();
    this.draw();
  }

  private draw(): void {
    const pen = this.pen;
    if (!pen) return;
    pen.clearRect(0, 0, size, size);
    this.drawRings(pen);
    const last = this.trail.length - 1;
    this.trail.forEach((point, i) => {
      if (i === last) this.dot(pen, point, 4, 1, "accent");
      else if (!this.still.matches) this.dot(pen, point, 1.2, (0.5 * (i + 1)) / trailLength, "ink");
    });
  }

  private drawRings(pen: CanvasRenderingContext2D): void {
    pen.lineWidth = 1;
    pen.strokeStyle = color("ink-soft");
    pen.globalAlpha = 0.55;
    for (const ring of [0.5, 1]) {
      pen.beginPath();
      pen.arc(middle, middle, ring * scale, 0, 2 * Math.PI);
      pen.stroke();
    }
    pen.beginPath();
    pen.moveTo(0.5, middle);
    pen.lineTo(size - 0.5, middle);
    pen.moveTo(middle, 0.5);
    pen.lineTo(middle, size - 0.5);
    pen.stroke();
    pen.globalAlpha = 1;
    pen.fillStyle = color("ink-soft");
    pen.font = `10px ${color("font")}`;
    pen.fillText("1 g", middle + 0.74 * scale, middle + 0.74 * scale + 9);
  }

  private dot(
    pen: CanvasRenderingContext2D,
    [ahead, left]: readonly [number, number],
    radius: number,
    alpha: number,
    paint: string,
  ): void {
    pen.globalAlpha = alpha;
    pen.fillStyle = color(paint);
    pen.beginPath();
    pen.arc(middle - left * scale, middle - ahead * scale, radius, 0, 2 * Math.PI);
    pen.fill();
    pen.globalAlpha = 1;
  }
}
