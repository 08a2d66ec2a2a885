// A published light field: it is decoded and drawn here, by WebGPU, and moves until somebody touches it.
import { any, canvas, input, say } from "./dom.js";
import { listen } from "./gestures.js";

const WIDEST = 2048; // pixels of a frame
const AHEAD = 16; // columns from the camera to the point that it looks at
const ROUND = 14000; // milliseconds of a circle of the idle camera
const STEP = 1 / 64; // columns: places of the idle camera
const NO_WEBGPU = "This is a recording: this browser has no WebGPU. In one that has, the camera is yours.";

/** @param {number} x @param {number} lo @param {number} hi */
const within = (x, lo, hi) => Math.max(lo, Math.min(hi, x));

/** A device that binds as large buffers as it can, or why there is none. */
async function openDevice() {
  const adapter = await /** @type {any} */ (navigator).gpu?.requestAdapter({ powerPreference: "high-performance" });
  if (!adapter) return null;
  const { maxStorageBufferBindingSize, maxBufferSize } = adapter.limits;
  return adapter.requestDevice({ requiredLimits: { maxStorageBufferBindingSize, maxBufferSize } });
}

class Player {
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
    this.camera = this.first();
    this.wanted = true;
    this.drawing = false;
    this.moving = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.movingSince = -1; // unknown until a frame has been drawn
    this.listen();
    this.showControls();
    requestAnimationFrame((now) => this.tick(now));
  }

  /** The camera at the beginning. */
  first() {
    const { camera, focus, aperture } = document.body.dataset;
    const [u, v, z = 0] = (camera ?? "").split(",").map(Number);
    return { u, v, z, turnX: 0, turnY: 0, focus: Number(focus), aperture: Number(aperture) };
  }

  /** As the renderer takes it. */
  frameCamera() {
    const { u, v, z, turnX, turnY, focus, aperture } = this.camera;
    return {
      width: this.canvas.width, height: this.canvas.height, u, v, z, atU: u + AHEAD * turnX, atV: v + AHEAD * turnY,
      atZ: z + AHEAD, focus, aperture, filter: 2, geometry: this.facts.geometry,
    };
  }

  /** @param {number} now */
  tick(now) {
    if (this.moving && this.movingSince >= 0) this.circle(now);
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
      this.centre = { u: this.camera.u, v: this.camera.v };
    }
    const { cols, rows } = this.facts;
    const angle = ((now - this.movingSince) / ROUND) * 2 * Math.PI;
    const [a, b] = [0.35 * (cols - 1), 0.25 * (rows - 1)];
    const centre = /** @type {{u: number, v: number}} */ (this.centre);
    const place = (/** @type {number} */ x, /** @type {number} */ last) => within(Math.round(x / STEP) * STEP, 0, last);
    const u = place(centre.u + a * Math.sin(angle), cols - 1);
    const v = place(centre.v + b * Math.sin(2 * angle) / 2, rows - 1);
    if (u !== this.camera.u || v !== this.camera.v) this.change({ u, v }, false);
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
      if (this.movingSince < 0) {
        performance.mark("first frame");
        this.movingSince = 0;
        void this.ahead();
      }
    } catch (error) {
      fail(/** @type {Error} */ (error));
      return; // nothing more is drawn
    }
    this.drawing = false;
  }

  /** Loads what the camera has not asked for yet, view by view from the middle on. */
  async ahead() {
    const { rows, cols, geometry } = this.facts;
    const { u, v } = this.camera;
    const views = Array.from({ length: rows * cols }, (_, i) => [Math.floor(i / cols), i % cols]);
    views.sort(([r0, c0], [r1, c1]) => Math.hypot(r0 - v, c0 - u) - Math.hypot(r1 - v, c1 - u));
    for (let i = 0; i < views.length; ++i) {
      const [row, col] = views[i];
      await this.field.load([row, row, col, col], 0, geometry === 1).catch(() => {});
      any("progress").setAttribute("value", String((i + 1) / views.length));
    }
    any("progress").hidden = true;
    document.body.dataset.loaded = "true";
  }

  /** @param {Partial<Player["camera"]>} changes @param {boolean} touched whether somebody asked for it */
  change(changes, touched = true) {
    Object.assign(this.camera, changes);
    if (touched) this.rest();
    this.wanted = true;
    this.showControls();
  }

  /** The camera circles no more. */
  rest() {
    this.moving = false;
    document.body.classList.add("touched");
    any("motion").setAttribute("aria-pressed", "false");
  }

  setOff() {
    this.moving = !this.moving;
    document.body.classList.add("touched");
    if (this.movingSince > 0) this.movingSince = 0;
    this.showControls();
  }

  showControls() {
    input("focus").value = String(this.camera.focus);
    input("blur").value = String(this.camera.aperture);
    any("motion").textContent = this.moving ? "Pause" : "Move";
    any("motion").setAttribute("aria-pressed", String(this.moving));
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

  /** @param {number} x @param {number} y in the canvas, in [0, 1) of the frame */
  async focusAt(x, y) {
    this.rest();
    const mark = any("mark");
    const box = this.frameBox();
    mark.hidden = true;
    mark.style.left = `${box.left + x * box.width}px`;
    mark.style.top = `${box.top + y * box.height}px`;
    void mark.offsetWidth; // the animation begins anew
    mark.hidden = false;
    const { width, height } = this.canvas;
    const focus = await this.field.client.focus(this.frameCamera(), Math.floor(x * width), Math.floor(y * height)).catch(() => null);
    // Where all was sharp, a little blur shows what the click has done.
    if (focus !== null) this.change({ focus, aperture: Math.max(1, this.camera.aperture) });
  }

  /** Where the frame is in the stage: object-fit leaves room aside or above. */
  frameBox() {
    const { clientWidth, clientHeight, width, height } = this.canvas;
    const scale = Math.min(clientWidth / width, clientHeight / height);
    const size = { width: width * scale, height: height * scale };
    return { ...size, left: (clientWidth - size.width) / 2, top: (clientHeight - size.height) / 2 };
  }

  listen() {
    const { cols, rows } = this.facts;
    listen(this.canvas, {
      move: (dx, dy) => this.move(-dx * Math.max(1, cols - 1), -dy * Math.max(1, rows - 1)),
      turn: (dx, dy) => this.turn(-dx, -dy),
      advance: (steps) => this.advance(steps / 4),
      click: (x, y) => {
        const box = this.frameBox();
        const [px, py] = [(x * this.canvas.clientWidth - box.left) / box.width, (y * this.canvas.clientHeight - box.top) / box.height];
        if (px >= 0 && px < 1 && py >= 0 && py < 1) void this.focusAt(px, py);
      },
    });
    const { near, far } = document.body.dataset;
    Object.assign(input("focus"), { min: near, max: far });
    input("focus").addEventListener("input", () => this.change({ focus: Number(input("focus").value) }));
    input("blur").addEventListener("input", () => this.change({ aperture: Number(input("blur").value) }));
    any("motion").addEventListener("click", () => this.setOff());
    any("middle").addEventListener("click", () => this.change(this.first()));
    any("full").addEventListener("click", () => void any("stage").requestFullscreen());
    any("keys").addEventListener("click", () => this.help());
    addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey || event.target instanceof HTMLInputElement) return;
      if (event.key === " " && event.target instanceof HTMLButtonElement) return;
      if (this.press(event.key, event.shiftKey)) event.preventDefault();
    });
  }

  help() {
    /** @type {HTMLDialogElement} */ (any("help")).showModal();
  }

  /**
   * Whether the key means something here.
   * @param {string} key @param {boolean} shift
   */
  press(key, shift) {
    /** @type {Record<string, [number, number]>} */
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const { focus, aperture } = this.camera;
    if (key in arrows) {
      const [x, y] = arrows[key];
      if (shift) this.turn(x / 40, y / 40);
      else this.move(x / 4, y / 4);
    } else if (key === "+" || key === "=") this.advance(0.25);
    else if (key === "-") this.advance(-0.25);
    else if (key === "[") this.change({ focus: within(focus - 0.05, -256, 256) });
    else if (key === "]") this.change({ focus: within(focus + 0.05, -256, 256) });
    else if (key === "a") this.change({ aperture: (aperture + 1) % 4 });
    else if (key === "f") void any("stage").requestFullscreen();
    else if (key === "0") this.change(this.first());
    else if (key === " ") this.setOff();
    else if (key === "?") this.help();
    else return false;
    return true;
  }
}

/**
 * The recording, and why.
 * @param {string} why
 */
function record(why) {
  const reduced = matchMedia("(prefers-reduced-motion: reduce)").matches;
  /** @type {HTMLImageElement} */ (any("still")).src = reduced ? "still.png" : "loop.png";
  canvas("frame").hidden = true;
  any("controls").hidden = true;
  any("progress").hidden = true;
  document.body.classList.remove("live");
  say("notice", why);
}

/** @param {Error} error */
function fail(error) {
  console.warn(error);
  const limit = error.message.startsWith("limit_exceeded");
  record(limit ? `This is a recording: this device is too small for the light field (${error.message}).` :
      `This is a recording: ${error.message}.`);
}

async function begin() {
  const device = await openDevice().catch(() => null);
  if (!device) return record(NO_WEBGPU);
  device.lost.then((/** @type {any} */ { message }) => record(
      `This is a recording: the graphics device was lost (${message || "no reason given"}); load the page again.`));
  device.addEventListener("uncapturederror", (/** @type {any} */ { error }) => fail(error));
  // It comes from another folder of the sources (gpu_ref/wgsl).
  const { LightField } = await import(new URL("light_field.js", import.meta.url).href);
  const field = await LightField.open(device, document.body.dataset.stream ?? "");
  any("controls").hidden = false;
  return new Player(device, field);
}

export const player = begin().catch(fail);
