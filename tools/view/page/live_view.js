// The light field from a camera that moves: draws a frame after the other, never more than one under way.
import { any, canvas, say } from "./dom.js";

const WIDEST = 2048; // pixels of a frame
const AHEAD = 16; // columns from the camera to the point that it looks at
const ROUND = 14000; // milliseconds of a circle of the idle camera
const STEP = 1 / 64; // columns: places of the idle camera
const GLIDE = 500; // milliseconds in which focus and aperture change
const LOADED_AHEAD = 1 << 26; // bytes
const AGAIN = 2000; // milliseconds until a silent host is asked again

/** @param {number} x @param {number} lo @param {number} hi */
export const within = (x, lo, hi) => Math.max(lo, Math.min(hi, x));

const isStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** @typedef {{u: number, v: number, z: number, turnX: number, turnY: number, focus: number, aperture: number}} Place */

export class LiveView {
  /** @param {any} device @param {any} field LightField of light_field.js */
  constructor(device, field) {
    this.field = field;
    this.facts = field.facts;
    this.canvas = canvas("frame");
    const { width, height } = this.facts;
    const reduced = Math.min(1, WIDEST / Math.max(width, height));
    this.canvas.width = Math.max(1, Math.round(width * reduced));
    this.canvas.height = Math.max(1, Math.round(height * reduced));
    this.target = /** @type {any} */ (this.canvas.getContext("webgpu"));
    this.target.configure({ device, format: /** @type {any} */ (navigator).gpu.getPreferredCanvasFormat(), alphaMode: "premultiplied" });
    // The first frame is sharp: it needs the fewest bytes.
    this.camera = { ...this.beginning(), aperture: 0 };
    this.sway = { u: 0, v: 0 }; // columns and rows, by a phone that is tilted
    this.wanted = true;
    this.drawing = false;
    this.moving = !isStill();
    this.movingSince = -1; // unknown until a frame has been drawn
    this.centre = this.camera;
    /** @type {{from: Partial<Place>, to: Partial<Place>, since: number} | null} */
    this.glide = null;
    this.changed = () => {};
    this.failed = (/** @type {Error} */ _) => {};
    /** @type {Promise<void>} the first frame */
    this.first = new Promise((resolve) => (this.begun = resolve));
    requestAnimationFrame((now) => this.tick(now));
  }

  /** Draws nothing more. */
  end() {
    this.drawing = true;
    this.begun?.();
  }

  /**
   * The camera at the beginning.
   * @returns {Place}
   */
  beginning() {
    const { camera, focus, aperture } = document.body.dataset;
    const [u, v, z = 0] = (camera ?? "").split(",").map(Number);
    return { u, v, z, turnX: 0, turnY: 0, focus: Number(focus), aperture: Number(aperture) };
  }

  /** As the renderer takes it. */
  frameCamera() {
    const { z, turnX, turnY, focus, aperture } = this.camera;
    const { cols, rows, geometry } = this.facts;
    const u = within(this.camera.u + this.sway.u, 0, cols - 1);
    const v = within(this.camera.v + this.sway.v, 0, rows - 1);
    return {
      width: this.canvas.width, height: this.canvas.height, u, v, z, atU: u + AHEAD * turnX, atV: v + AHEAD * turnY,
      atZ: z + AHEAD, focus, aperture, filter: 2, geometry,
    };
  }

  /** @param {number} now */
  tick(now) {
    if (this.moving && this.movingSince >= 0) this.circle(now);
    if (this.glide) this.slide(this.glide, now);
    if (this.wanted && !this.drawing) void this.draw();
    requestAnimationFrame((next) => this.tick(next));
  }

  /**
   * The idle camera: a slow ellipse that begins where it is.
   * @param {number} now
   */
  circle(now) {
    if (this.movingSince === 0) {
      this.movingSince = now;
      this.centre = { ...this.camera };
    }
    const { cols, rows } = this.facts;
    const angle = ((now - this.movingSince) / ROUND) * 2 * Math.PI;
    const [a, b] = [0.35 * (cols - 1), 0.25 * (rows - 1)];
    const place = (/** @type {number} */ x, /** @type {number} */ last) => within(Math.round(x / STEP) * STEP, 0, last);
    const u = place(this.centre.u + a * Math.sin(angle), cols - 1);
    const v = place(this.centre.v + b * Math.sin(2 * angle) / 2, rows - 1);
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
    this.wanted = false;
    try {
      const camera = this.frameCamera();
      const { error } = await this.field.draw(camera, 0, this.target);
      say("notice", error === 0 ? "" : "A part of this light field is damaged: its file did not arrive as it was made.");
      this.canvas.classList.add("drawn");
      document.body.classList.add("live");
      Object.assign(this.canvas.dataset, { drawn: JSON.stringify(camera), error: String(error) });
      if (this.movingSince < 0) this.open();
    } catch (error) {
      const { name, message } = /** @type {Error} */ (error);
      if (name !== "NetworkError") return this.failed(/** @type {Error} */ (error));
      say("notice", `Waiting: ${message}.`);
      await new Promise((next) => setTimeout(next, AGAIN));
      this.wanted = true;
    }
    this.drawing = false;
  }

  /** After the first frame. */
  open() {
    performance.mark("first frame", { detail: this.field.client.file.received });
    this.movingSince = 0;
    this.begun?.();
    this.slideTo({ aperture: this.beginning().aperture });
    void this.ahead();
  }

  /** Loads what the camera has not asked for yet, view by view from the middle on. */
  async ahead() {
    const { rows, cols, geometry } = this.facts;
    const { u, v } = this.camera;
    const views = Array.from({ length: rows * cols }, (_, i) => [Math.floor(i / cols), i % cols]);
    views.sort(([r0, c0], [r1, c1]) => Math.hypot(r0 - v, c0 - u) - Math.hypot(r1 - v, c1 - u));
    for (let i = 0; i < views.length && this.field.client.file.received < LOADED_AHEAD; ++i) {
      const [row, col] = views[i];
      await this.field.load([row, row, col, col], 0, geometry === 1).catch(() => {});
      any("progress").setAttribute("value", String((i + 1) / views.length));
    }
    any("progress").hidden = true;
    document.body.dataset.loaded = "true";
  }

  /** @param {Partial<Place>} changes */
  put(changes) {
    Object.assign(this.camera, changes);
    this.wanted = true;
    this.changed();
  }

  /**
   * Somebody asked for it: the camera circles no more.
   * @param {Partial<Place>} changes
   */
  change(changes) {
    this.rest();
    if ("focus" in changes || "aperture" in changes) this.glide = null;
    this.put(changes);
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

  /** @param {number} columns */
  advance(columns) {
    const reach = this.facts.cols + this.facts.rows;
    this.change({ z: within(this.camera.z + columns, -reach, reach) });
  }

  /** @param {number} x @param {number} y in [0, 1) of the frame */
  async focusAt(x, y) {
    this.rest();
    const { width, height } = this.canvas;
    const pixel = [Math.floor(x * width), Math.floor(y * height)];
    const focus = await this.field.client.focus(this.frameCamera(), ...pixel).catch(() => null);
    // Where all was sharp, a little blur shows what the click has done.
    if (focus !== null) this.slideTo({ focus, aperture: Math.max(1, this.camera.aperture) });
  }
}
