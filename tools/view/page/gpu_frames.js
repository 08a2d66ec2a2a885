// Frames of a light field that is decoded and drawn here, by WebGPU.
import { any, canvas } from "./dom.js";
import { within } from "./live_view.js";

/** @typedef {import("./live_view.js").Camera} Camera */

const AHEAD = 16; // columns from the camera to the point that it looks at
const LOADED_AHEAD = 1 << 26; // bytes
const SLOW = 2000; // milliseconds for a frame whose stream has come
const OFTEN = 3; // slow frames, one after the other
const AROUND = 64; // rows and columns of views that are loaded ahead

export class GpuFrames {
  /** @param {any} device @param {any} field LightField of light_field.js */
  constructor(device, field) {
    this.field = field;
    this.facts = field.facts;
    this.canvas = canvas("frame");
    this.target = /** @type {any} */ (this.canvas.getContext("webgpu"));
    this.target.configure({ device, format: /** @type {any} */ (navigator).gpu.getPreferredCanvasFormat(), alphaMode: "premultiplied" });
    const { camera, focus, aperture, near, far } = document.body.dataset;
    const [u, v, z = 0] = (camera ?? "").split(",").map(Number);
    /** @type {Camera} */
    this.start = { u, v, z, turnX: 0, turnY: 0, focus: Number(focus), aperture: Number(aperture), geometry: this.facts.geometry === 1 ? "stream" : "plane" };
    this.slow = 0; // frames, up to now
    this.depths = /** @type {[number, number]} */ ([Number(near), Number(far)]);
  }

  /**
   * As the renderer takes it.
   * @param {Camera} camera
   */
  record({ u, v, z, turnX, turnY, focus, aperture }) {
    const { width, height } = this.canvas;
    return {
      width, height, u, v, z, atU: u + AHEAD * turnX, atV: v + AHEAD * turnY, atZ: z + AHEAD, focus, aperture, filter: 2,
      geometry: this.facts.geometry,
    };
  }

  /** @param {Camera} camera @returns {Promise<import("./live_view.js").Shown>} */
  async draw(camera) {
    const record = this.record(camera);
    const { error, took } = await this.field.draw(record, 0, this.target);
    this.slow = took > SLOW ? this.slow + 1 : 0;
    const slow = this.slow >= OFTEN;
    Object.assign(this.canvas.dataset, { drawn: JSON.stringify(record), error: String(error) });
    const damaged = "A part of this light field is damaged: its file did not arrive as it was made.";
    return { slow, note: error !== 0 ? damaged : slow ? `This device takes ${Math.round(took / 1000)} s for a picture. Drag to move the camera.` : "" };
  }

  /** @param {Camera} camera @param {number} x @param {number} y */
  focusOf(camera, x, y) {
    return this.field.client.focus(this.record(camera), x, y);
  }

  /** Loads what the camera has not asked for yet, view by view from the middle on. */
  async ahead() {
    const { rows, cols, geometry } = this.facts;
    const { u, v } = this.start;
    const near = (/** @type {number} */ at, /** @type {number} */ count) =>
      Array.from({ length: Math.min(count, AROUND) }, (_, i) => i + within(Math.round(at) - AROUND / 2, 0, Math.max(0, count - AROUND)));
    const views = near(v, rows).flatMap((row) => near(u, cols).map((col) => [row, col]));
    views.sort(([r0, c0], [r1, c1]) => Math.hypot(r0 - v, c0 - u) - Math.hypot(r1 - v, c1 - u));
    for (let i = 0; i < views.length && this.field.client.file.received < LOADED_AHEAD; ++i) {
      const [row, col] = views[i];
      await this.field.load([row, row, col, col], 0, geometry === 1).catch(() => {});
      any("progress").setAttribute("value", String((i + 1) / views.length));
    }
    any("progress").hidden = true;
    document.body.dataset.loaded = "true";
  }
}
