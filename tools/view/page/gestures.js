// What a pointer, fingers and the wheel do on the frame.

/**
 * @typedef {object} Gestures
 * @property {(dx: number, dy: number) => void} move in parts of the element's width and height
 * @property {(dx: number, dy: number) => void} turn likewise
 * @property {(steps: number) => void} advance > 0: in
 * @property {(x: number, y: number, alt: boolean) => void} click in [0, 1); alt: with the key Alt
 */

const STILL = 4; // pixels that a click may move
const EMBEDDED = window !== top;

/** @param {HTMLElement} target @param {Gestures} gestures */
export function listen(target, gestures) {
  /** @type {Map<number, {x: number, y: number}>} */
  const fingers = new Map();
  let travelled = 0;
  let turning = false;

  const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };

  if (EMBEDDED) target.style.touchAction = "pan-y"; // fingers scroll the page around it
  target.addEventListener("contextmenu", (event) => event.preventDefault());
  target.addEventListener("pointerdown", (event) => {
    target.setPointerCapture(event.pointerId);
    if (fingers.size === 0) travelled = 0;
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    turning = event.button === 2 || event.shiftKey || fingers.size > 1;
  });

  target.addEventListener("pointermove", (event) => {
    const finger = fingers.get(event.pointerId);
    if (finger === undefined || fingers.size > 2) return;
    const before = fingers.size === 2 ? spread() : 0;
    const [dx, dy] = [event.clientX - finger.x, event.clientY - finger.y];
    Object.assign(finger, { x: event.clientX, y: event.clientY });
    travelled += Math.hypot(dx, dy);
    if (travelled <= STILL) return;
    const box = target.getBoundingClientRect();
    gestures[turning ? "turn" : "move"](dx / box.width / fingers.size, dy / box.height / fingers.size);
    if (fingers.size === 2) gestures.advance(((spread() - before) / box.width) * 10);
  });

  const lift = (/** @type {PointerEvent} */ event) => {
    const was = fingers.delete(event.pointerId);
    if (!was || event.type !== "pointerup" || travelled > STILL || event.button !== 0 || turning) return;
    const box = target.getBoundingClientRect();
    const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    if (x >= 0 && x < 1 && y >= 0 && y < 1) gestures.click(x, y, event.altKey);
  };
  target.addEventListener("pointerup", lift);
  target.addEventListener("pointercancel", lift);

  target.addEventListener("wheel", (event) => {
    if (EMBEDDED && !document.hasFocus()) return; // the wheel, too, until somebody has clicked here
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY : event.deltaY / 40;
    gestures.advance(Math.max(-5, Math.min(5, -lines)));
  }, { passive: false });
}
