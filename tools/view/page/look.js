// Look: frames of novel views.
import { address, askJson } from "./ask.js";
import { cameraQuery, middleCamera, placeQuery, readCamera, renderCommand } from "./camera.js";
import { any, canvas, context, grouped, input, numberIn, say, select } from "./dom.js";
import { FrameLoop } from "./frame_loop.js";
import { listen } from "./gestures.js";
import { GridMap } from "./grid_map.js";
import { PathRecorder } from "./path_recorder.js";
import { PixelPanel } from "./pixel_panel.js";

const WIDEST = 2048; // pixels of a frame

/** @param {number} x @param {number} lo @param {number} hi */
const within = (x, lo, hi) => Math.max(lo, Math.min(hi, x));

export class Look {
  /** @param {any} stream @param {(query: import("./ask.js").Query) => void} moved told of every camera that is still */
  constructor(stream, moved) {
    this.stream = stream;
    this.moved = moved;
    this.camera = middleCamera(stream);
    this.canvas = canvas("frame");
    const reduced = Math.min(1, WIDEST / Math.max(stream.width, stream.height));
    this.width = Math.max(1, Math.round(stream.width * reduced)); // of a frame
    this.height = Math.max(1, Math.round(stream.height * reduced));
    this.canvas.width = this.width;
    this.canvas.height = this.height;
    this.half = document.createElement("canvas");
    this.views = [0, -1, 0, -1];
    this.map = new GridMap(canvas("look-map"), stream, (row, col) => this.change({ u: col, v: row }));
    this.loop = new FrameLoop((half) => this.query(half), (frame) => this.draw(frame), (error) => this.fail(error));
    this.recorder = new PathRecorder(stream.file, `${this.width}x${this.height}`);
    this.panel = new PixelPanel(stream, [this.width, this.height], () => this.query(false), () => this.moved(this.link()));
    this.prepareControls();
    this.listen();
    new ResizeObserver(() => this.fit()).observe(/** @type {HTMLElement} */ (this.canvas.parentElement));
    this.fit();
  }

  /** Fills the stage, in the frame's proportions. */
  fit() {
    const stage = /** @type {HTMLElement} */ (this.canvas.parentElement);
    const scale = Math.min(stage.clientWidth / this.width, stage.clientHeight / this.height);
    this.canvas.style.width = `${this.width * scale}px`;
    this.canvas.style.height = `${this.height * scale}px`;
    this.panel.mark();
  }

  prepareControls() {
    const [nearest, farthest] = this.stream.disparity ?? [-4, 4];
    const reach = Math.max(1, (farthest - nearest) / 2);
    input("focus").min = String(Math.max(-256, Math.floor(nearest - reach)));
    input("focus").max = String(Math.min(256, Math.ceil(farthest + reach)));
    input("levels").max = String(this.stream.tree_height + 1);
    any("levels-label").hidden = this.stream.tree_height === 0;
    const numbers = /** @type {const} */ ([["camera-u", "u"], ["camera-v", "v"], ["camera-z", "z"]]);
    for (const [id, name] of numbers) {
      input(id).addEventListener("change", () => this.change({ [name]: numberIn(id) ?? this.camera[name] }));
    }
    input("fov").addEventListener("change", () => this.change({ fov: numberIn("fov") }));
    for (const name of /** @type {const} */ (["focus", "aperture"])) {
      input(name).addEventListener("input", () => this.change({ [name]: Number(input(name).value) }, true));
    }
    input("levels").addEventListener("input", () => {
      const levels = Number(input("levels").value);
      this.change({ levels: levels > this.stream.tree_height ? 0 : levels });
    });
    for (const name of /** @type {const} */ (["geometry", "filter"])) {
      select(name).addEventListener("change", () => this.change({ [name]: select(name).value }));
    }
    any("reset").addEventListener("click", () => this.change(middleCamera(this.stream)));
    any("full").addEventListener("click", () => void any("look").requestFullscreen());
  }

  listen() {
    listen(this.canvas, {
      move: (dx, dy) => this.move(-dx * (this.stream.cols - 1), -dy * (this.stream.rows - 1)),
      turn: (dx, dy) => this.turn(-dx, -dy),
      advance: (steps) => this.advance(steps / 4),
      click: (x, y, alt) => {
        const pixel = /** @type {const} */ ([Math.floor(x * this.width), Math.floor(y * this.height)]);
        if (alt || this.panel.open) this.panel.choose(...pixel);
        else void this.focusAt(...pixel);
      },
    });
    this.canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (this.press(event.key, event.shiftKey)) event.preventDefault();
    });
  }

  /**
   * Whether the key means something here.
   * @param {string} key @param {boolean} shift
   */
  press(key, shift) {
    /** @type {Record<string, [number, number]>} */
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const { camera } = this;
    if (key in arrows) {
      const [x, y] = arrows[key];
      if (shift) this.turn(x / 40, y / 40);
      else this.move(x / 4, y / 4);
    } else if (key === "+" || key === "=") this.advance(0.25);
    else if (key === "-") this.advance(-0.25);
    else if (key === "[") this.change({ focus: within(camera.focus - 0.05, -256, 256) }, true);
    else if (key === "]") this.change({ focus: within(camera.focus + 0.05, -256, 256) }, true);
    else if (key === "a") this.change({ aperture: (camera.aperture + 1) % 4 });
    else if (key === "g") this.change({ geometry: camera.geometry === "plane" ? "stream" : "plane" });
    else if (key === "f") void any("look").requestFullscreen();
    else if (key === "p") this.panel.toggle();
    else if (key === "0") this.change(middleCamera(this.stream));
    else return false;
    return true;
  }

  /** @param {number} columns @param {number} rows */
  move(columns, rows) {
    const { u, v } = this.camera;
    this.change({
      u: within(u + columns, 0, this.stream.cols - 1),
      v: within(v + rows, 0, this.stream.rows - 1),
    }, true);
  }

  /**
   * By parts of a frame.
   * @param {number} x @param {number} y
   */
  turn(x, y) {
    const longer = Math.max(this.width, this.height);
    this.change({
      turnX: within(this.camera.turnX + (x * this.width) / longer, -1, 1),
      turnY: within(this.camera.turnY + (y * this.height) / longer, -1, 1),
    }, true);
  }

  /** @param {number} columns */
  advance(columns) {
    this.change({ z: within(this.camera.z + columns, -256, 256) }, true);
  }

  /** @param {Partial<import("./camera.js").Camera>} changes @param {boolean} moving */
  change(changes, moving = false) {
    Object.assign(this.camera, changes);
    any("look-status").textContent = "";
    this.showControls();
    this.loop.want(moving);
  }

  /**
   * The view that is nearest to the camera.
   * @returns {import("./ask.js").Query}
   */
  nearestView() {
    const row = within(Math.round(this.camera.v), 0, this.stream.rows - 1);
    return { view: `${row},${within(Math.round(this.camera.u), 0, this.stream.cols - 1)}` };
  }

  /**
   * The camera of a link.
   * @param {URLSearchParams} query
   */
  open(query) {
    this.camera = middleCamera(this.stream);
    readCamera(this.camera, query);
    this.panel.read(query);
    this.change({});
  }

  /** @returns {import("./ask.js").Query} */
  link() {
    return { ...placeQuery(this.camera), ...this.panel.link() };
  }

  /** @param {boolean} half */
  query(half) {
    const { width, height } = this;
    if (!half) return cameraQuery(this.camera, width, height);
    return cameraQuery(this.camera, Math.ceil(width / 2), Math.ceil(height / 2));
  }

  /** @param {number} x @param {number} y a pixel of the frame */
  async focusAt(x, y) {
    const { focus: _, ...camera } = this.query(false);
    try {
      const { focus } = await askJson("focus", { ...camera, "focus-at": `${x},${y}` });
      this.change({ focus });
      const blurs = this.camera.aperture > 0 || this.camera.geometry === "plane";
      any("look-status").textContent =
        `Focus ${focus} at ${x},${y}${blurs ? "" : "; all is sharp until the aperture is above 0"}`;
    } catch (error) {
      any("look-status").textContent = /** @type {Error} */ (error).message;
    }
  }

  /** @param {import("./frame_loop.js").Drawn} frame */
  draw({ pixels, cost, exact, query }) {
    say("look-error", "");
    const draw = context(this.canvas);
    if (exact) {
      draw.putImageData(pixels, 0, 0);
    } else {
      this.half.width = pixels.width;
      this.half.height = pixels.height;
      context(this.half).putImageData(pixels, 0, 0);
      draw.drawImage(this.half, 0, 0, this.canvas.width, this.canvas.height);
    }
    this.recorder.add(query);
    this.views = cost.views;
    any("look-outside").textContent = cost.outside > 0
      ? `${(100 * cost.outside).toFixed(1)} % of the frame sees nothing of the light field: move the camera nearer to the views, or narrow the field of view` : "";
    this.showNumbers(cost);
    this.map.draw({ used: this.views, camera: this.camera });
    this.canvas.dataset.exact = String(exact);
    this.canvas.dataset.query = address("", query);
    if (!exact || this.loop.dirty) return;
    this.moved(this.link());
    if (this.panel.open) void this.panel.ask();
  }

  /** @param {Error} error */
  fail(error) {
    say("look-error", error.message);
    this.canvas.dataset.exact = "false";
  }

  /** @param {any} cost */
  showNumbers(cost) {
    const rate = this.loop.rate();
    any("fps").textContent = rate === null ? "–" : rate.toFixed(0);
    any("seconds").textContent = `${(cost.seconds * 1000).toFixed(1)} ms`;
    for (const name of ["needed", "decoded", "reused", "touched", "key_samples"]) any(name).textContent = grouped(cost[name]);
  }

  showControls() {
    const { camera } = this;
    const place = /** @type {const} */ ([["camera-u", camera.u], ["camera-v", camera.v], ["camera-z", camera.z]]);
    for (const [id, value] of place) input(id).value = String(Number(value.toFixed(4)));
    input("fov").value = camera.fov === null ? "" : String(camera.fov);
    input("focus").value = String(camera.focus);
    any("focus-value").textContent = camera.focus.toFixed(2);
    input("aperture").value = String(camera.aperture);
    any("aperture-value").textContent = String(camera.aperture);
    const levels = camera.levels === 0 ? this.stream.tree_height + 1 : camera.levels;
    input("levels").value = String(levels);
    any("levels-value").textContent = `${levels} of ${this.stream.tree_height + 1}`;
    select("geometry").value = camera.geometry;
    select("filter").value = camera.filter;
    const query = this.query(false);
    input("focus").setAttribute("aria-valuetext", `${camera.focus.toFixed(2)} pixels a column`);
    any("save").setAttribute("href", address("frame.png", query));
    any("look-command").textContent = renderCommand(this.stream.file, query);
    this.map.draw({ used: this.views, camera });
  }
}
