// The light field from a camera that moves: shows a frame after the other, never more than one under way, whoever draws
// them.
import { canvas, say } from "./dom.js";

/**
 * @typedef {object} Camera
 * @property {number} u column of views
 * @property {number} v row of views
 * @property {number} z distance beyond the view plane, in columns
 * @property {number} turnX slope of the direction to the right
 * @property {number} turnY slope of the direction down
 * @property {number} focus disparity in focus
 * @property {number} aperture 0 to 3
 * @property {string} [geometry] of the server's frames: "stream" or "plane"
 * @property {string} [filter] likewise
 * @property {number} [levels] of the tree; 0: all
 * @property {number | null} [fov] degrees; null: a view fills the frame
 */
/**
 * What was drawn. half: with half the size, because the camera moves; slow: too slowly for a camera that circles; note:
 * what the visitor should know.
 * @typedef {{half?: boolean, slow?: boolean, note?: string}} Shown
 */
/**
 * Draws frames on the canvas: gpu_frames.js here, server_frames.js by asking.
 * @typedef {object} Frames
 * @property {{rows: number, cols: number, width: number, height: number}} facts of the views
 * @property {Camera} start
 * @property {[number, number]} depths the least and greatest focus on offer
 * @property {{draw(camera: Camera, moving: boolean): Promise<Shown>}["draw"]} draw
 * @property {{focusOf(camera: Camera, x: number, y: number): Promise<number | null>}["focusOf"]} focusOf of a pixel
 */

const WIDEST = 2048; // pixels of a frame
const ROUND = 14000; // milliseconds of a circle of the idle camera
const STEP = 1 / 64; // columns: places of the idle camera
const GLIDE = 500; // milliseconds in which focus and aperture change
const STILL = 120; // milliseconds without input
const AGAIN = 2000; // milliseconds until a silent host is asked again

/** @param {number} x @param {number} lo @param {number} hi */
export const within = (x, lo, hi) => Math.max(lo, Math.min(hi, x));

const isStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/**
 * Whether another try may help; if so, after a while.
 * @param {Error} error
 */
export async function mayHelp(error) {
  if (error.name !== "NetworkError") return false;
  say("notice", `Waiting: ${error.message}.`);
  await new Promise((next) => setTimeout(next, AGAIN));
  return true;
}

export class LiveView {
  /** @param {Frames} frames */
  constructor(frames) {
    this.frames = frames;
    this.facts = frames.facts;
    this.canvas = canvas("frame");
    const { width, height } = this.facts;
    const reduced = Math.min(1, WIDEST / Math.max(width, height));
    this.canvas.width = Math.max(1, Math.round(width * reduced));
    this.canvas.height = Math.max(1, Math.round(height * reduced));
    this.canvas.style.setProperty("--shape", String(this.canvas.width / this.canvas.height));
    this.camera = { ...frames.start };
    this.sway = { u: 0, v: 0 }; // columns and rows, by a phone that is tilted
    this.wanted = true;
    this.drawing = false;
    this.ended = false;
    this.moving = !isStill();
    this.movingSince = -1; // unknown until a frame has been drawn
    this.inputAt = 0;
    /** @type {number | undefined} when the oldest input came that no frame shows */
    this.pending = undefined;
    this.centre = this.camera;
    /** @type {{from: Partial<Camera>, to: Partial<Camera>, since: number} | null} */
    this.glide = null;
    this.changed = () => {};
    this.shown = (/** @type {Shown} */ _shown, /** @type {number | undefined} */ _input) => {};
    this.failed = (/** @type {Error} */ _) => {};
    /** @type {Promise<void>} the first frame */
    this.first = new Promise((resolve) => (this.begun = resolve));
    requestAnimationFrame((now) => this.tick(now));
  }

  /** Draws nothing more. */
  end() {
    this.ended = true;
    this.begun?.();
  }

  /** @returns {Camera} with the tilt of the phone */
  frameCamera() {
    const { u, v } = this.camera;
    const { cols, rows } = this.facts;
    return { ...this.camera, u: within(u + this.sway.u, 0, cols - 1), v: within(v + this.sway.v, 0, rows - 1) };
  }

  /** @param {number} now */
  tick(now) {
    if (this.canvas.clientWidth > 0) {
      if (this.moving && this.movingSince >= 0) this.circle(now);
      if (this.glide) this.slide(this.glide, now);
      if (this.wanted && !this.drawing) void this.draw();
    }
    requestAnimationFrame((next) => this.tick(next));
  }

  /**
   * The idle camera: a slow ellipse that begins where it is, and comes away from the border.
   * @param {number} now
   */
  circle(now) {
    if (this.movingSince === 0) {
      this.movingSince = now;
      this.centre = { ...this.camera };
    }
    const rounds = (now - this.movingSince) / ROUND;
    const place = (/** @type {number} */ from, /** @type {number} */ count, /** @type {number} */ part, /** @type {number} */ swing) => {
      const [last, reach] = [count - 1, part * (count - 1)];
      const centre = from + (within(from, reach, last - reach) - from) * Math.min(1, 2 * rounds);
      return within(Math.round((centre + reach * Math.sin(2 * Math.PI * swing * rounds)) / STEP) * STEP, 0, last);
    };
    const u = place(this.centre.u, this.facts.cols, 0.35, 1);
    const v = place(this.centre.v, this.facts.rows, 0.125, 2);
    if (u !== this.camera.u || v !== this.camera.v) this.put({ u, v });
  }

  /**
   * Focus and aperture on their way.
   * @param {NonNullable<LiveView["glide"]>} glide @param {number} now
   */
  slide(glide, now) {
    const { from, to, since } = glide;
    const part = isStill() ? 1 : within((now - since) / GLIDE, 0, 1);
    const eased = part * part * (3 - 2 * part);
    for (const name of /** @type {const} */ (["focus", "aperture"])) {
      const [a, b] = [from[name], to[name]];
      if (a !== undefined && b !== undefined) this.camera[name] = part === 1 ? b : a + (b - a) * eased;
    }
    if (part === 1) this.glide = null;
    this.put({});
  }

  async draw() {
    this.drawing = true;
    while (this.wanted && !this.ended) {
      const input = this.pending;
      this.pending = undefined;
      this.wanted = false;
      await this.drawOne(input).catch((error) => this.wait(error));
    }
    this.drawing = false;
  }

  /** @param {Error} error */
  async wait(error) {
    this.wanted = await mayHelp(error);
    if (this.wanted) return;
    this.rest();
    this.failed(error);
  }

  /** @param {number | undefined} input when its input came */
  async drawOne(input) {
    const moving = this.glide !== null || performance.now() - this.inputAt < STILL;
    const shown = await this.frames.draw(this.frameCamera(), moving);
    say("notice", shown.note ?? "");
    this.canvas.classList.add("drawn");
    document.body.classList.add("live");
    if (this.movingSince < 0) {
      this.movingSince = 0;
      this.begun?.();
    }
    if (shown.slow && !document.body.classList.contains("touched")) this.rest();
    if (shown.half && !this.wanted) setTimeout(() => this.put({}), STILL);
    this.shown(shown, input);
  }

  /** @param {Partial<Camera>} changes */
  put(changes) {
    Object.assign(this.camera, changes);
    this.wanted = true;
    this.changed();
  }

  /**
   * Somebody asked for it: the camera circles no more.
   * @param {Partial<Camera>} changes
   */
  change(changes) {
    this.rest();
    for (const name of /** @type {const} */ (["focus", "aperture"])) if (name in changes) delete this.glide?.to[name];
    this.inputAt = performance.now();
    this.pending ??= this.inputAt;
    this.put(changes);
    if (!this.drawing && this.movingSince >= 0) void this.draw(); // at once, not with the next picture of the screen
  }

  /** @param {{focus?: number, aperture?: number}} to */
  slideTo(to) {
    this.glide = { from: { ...this.camera }, to: { ...this.glide?.to, ...to }, since: performance.now() };
  }

  rest() {
    this.moving = false;
    document.body.classList.add("touched");
    this.changed();
  }

  setOff() {
    this.moving = !this.moving;
    document.body.classList.add("touched");
    if (this.movingSince > 0) this.movingSince = 0;
    this.changed();
  }

  restart() {
    this.change(this.frames.start);
  }

  /** @param {number} columns @param {number} rows */
  move(columns, rows) {
    const { u, v } = this.camera;
    this.change({ u: within(u + columns, 0, this.facts.cols - 1), v: within(v + rows, 0, this.facts.rows - 1) });
  }

  /**
   * By parts of a frame.
   * @param {number} x @param {number} y
   */
  turn(x, y) {
    const { width, height } = this.canvas;
    const longer = Math.max(width, height);
    this.change({
      turnX: within(this.camera.turnX + (x * width) / longer, -0.5, 0.5),
      turnY: within(this.camera.turnY + (y * height) / longer, -0.5, 0.5),
    });
  }

  /** Columns to the farthest place from the views: there, from their middle, what they see still fills the frame. */
  reach() {
    const { rows, cols, width, height } = this.facts;
    return Math.max(1, Math.max(width, height) * Math.min((cols - 1) / width, (rows - 1) / height));
  }

  /** @param {number} columns */
  advance(columns) {
    const reach = Math.max(this.reach(), Math.abs(this.camera.z));
    this.change({ z: within(this.camera.z + columns, -reach, reach) });
  }

  /** @param {number} x @param {number} y in [0, 1) of the frame */
  async focusAt(x, y) {
    this.rest();
    const { width, height } = this.canvas;
    let why = "There is nothing to focus on.";
    const focus = await this.frames.focusOf(this.frameCamera(), Math.floor(x * width), Math.floor(y * height)).catch((error) => {
      why = `${error.message}.`;
      return null;
    });
    // Where all was sharp, a little blur shows what the click has done.
    if (focus !== null) this.slideTo({ focus, aperture: Math.max(1, this.camera.aperture) });
    else say("notice", why);
  }
}
