// How a phone is tilted, next to how it was held at first.

const WIDE = 25; // degrees, from the middle to the end

/** @param {number} x */
const unit = (x) => Math.max(-1, Math.min(1, x));

export class Tilt {
  static isThere() {
    return "DeviceOrientationEvent" in window && matchMedia("(pointer: coarse)").matches;
  }

  /** @param {(x: number, y: number) => void} tell each in [-1, 1]: to the right, down */
  constructor(tell) {
    this.tell = tell;
    this.on = false;
    /** @type {number[] | null} how it was held */
    this.held = null;
  }

  /** Whether it is on now; some phones ask their owner first. */
  async toggle() {
    const request = /** @type {any} */ (DeviceOrientationEvent).requestPermission;
    const allowed = this.on || !request || (await request.call(DeviceOrientationEvent).catch(() => "")) === "granted";
    this.on = allowed && !this.on;
    this.held = null;
    addEventListener("deviceorientation", this); // not before, since browsers warn of it
    if (!this.on) this.tell(0, 0);
    return this.on;
  }

  /** @param {DeviceOrientationEvent} event */
  handleEvent({ beta, gamma }) {
    if (!this.on || beta === null || gamma === null) return;
    const upright = screen.orientation.angle % 180 === 0;
    const now = upright ? [gamma, beta] : [beta, gamma];
    this.held ??= now;
    this.tell(unit((now[0] - this.held[0]) / WIDE), unit((now[1] - this.held[1]) / WIDE));
  }
}
