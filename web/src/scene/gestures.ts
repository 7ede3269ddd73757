// Hands on the view: one finger or the mouse turns, two fingers or the wheel bring nearer, two fingers or the right
// button move.
export interface GestureListener {
  turn(right: number, up: number): void; // [rad]
  zoom(factor: number): void; // above 1: farther
  move(right: number, up: number): void; // in heights of the view
}

const turnPerPixel = 0.006; // [rad]

interface Spot {
  x: number;
  y: number;
}

export function listenToGestures(view: HTMLElement, listener: GestureListener): () => void {
  const spots = new Map<number, Spot>();
  const stop = new AbortController();
  const { signal } = stop;

  const spread = (): number => {
    const [a, b] = [...spots.values()];
    return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };
  const drag = (event: PointerEvent, spot: Spot): void => {
    const before = spread();
    const right = event.clientX - spot.x;
    const up = spot.y - event.clientY;
    spot.x = event.clientX;
    spot.y = event.clientY;
    const height = Math.max(view.clientHeight, 1);
    if (spots.size === 2) {
      if (before > 0 && spread() > 0) listener.zoom(before / spread());
      listener.move(right / height / 2, up / height / 2);
    } else if ((event.buttons & 2) !== 0 || event.shiftKey) listener.move(right / height, up / height);
    else listener.turn(right * turnPerPixel, up * turnPerPixel);
  };

  view.addEventListener("pointerdown", (event) => {
    view.focus({ preventScroll: true });
    view.setPointerCapture(event.pointerId);
    spots.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }, { signal });
  view.addEventListener("pointermove", (event) => {
    const spot = spots.get(event.pointerId);
    if (spot) drag(event, spot);
  }, { signal });
  for (const end of ["pointerup", "pointercancel"] as const) {
    view.addEventListener(end, (event) => spots.delete(event.pointerId), { signal });
  }
  view.addEventListener("contextmenu", (event) => event.preventDefault(), { signal });
  // A page that scrolls past keeps scrolling: the wheel is the view's once it has been touched.
  view.addEventListener("wheel", (event) => {
    if (document.activeElement !== view && !event.ctrlKey) return;
    event.preventDefault();
    const pixels = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 * event.deltaY : event.deltaY;
    listener.zoom(Math.exp(Math.max(-200, Math.min(200, pixels)) * 0.0015));
  }, { signal, passive: false });
  return () => stop.abort();
}
