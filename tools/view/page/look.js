// Look: the light field from any camera, drawn by the server, with what `hmlfc render` has to know in a panel aside.
import { address } from "./ask.js";
import { middleCamera, placeQuery, readCamera, renderCommand } from "./camera.js";
import { any, canvas, grouped, input, numberIn, say, select } from "./dom.js";
import { GridMap } from "./grid_map.js";
import { LiveView, within } from "./live_view.js";
import { control } from "./look_controls.js";
import { PathRecorder } from "./path_recorder.js";
import { PixelPanel } from "./pixel_panel.js";

const NUMBERS = /** @type {const} */ ([["camera-u", "u"], ["camera-v", "v"], ["camera-z", "z"]]);

export class Look {
  /**
   * @param {import("./server_frames.js").ServerFrames} frames
   * @param {(query: import("./ask.js").Query) => void} moved told of every camera that is still
   */
  constructor(frames, moved) {
    const stream = (this.stream = frames.facts);
    this.frames = frames;
    this.moved = moved;
    this.view = new LiveView(frames);
    this.views = [0, -1, 0, -1];
    /** @type {number[]} */
    this.drawnAt = []; // within the last second
    const { width, height } = this.view.canvas;
    this.map = new GridMap(canvas("look-map"), stream, (row, col) => this.view.change({ u: col, v: row }));
    this.recorder = new PathRecorder(stream.file, `${width}x${height}`);
    this.panel = new PixelPanel(stream, [width, height], () => frames.query(this.camera()), () => this.moved(this.link()));
    control(this.view, (x, y, alt) => this.trace(x, y, alt));
    const strip = this.view.changed;
    this.view.changed = () => {
      strip();
      this.showControls();
    };
    this.view.shown = (shown, input) => this.shown(/** @type {any} */ (shown), input);
    this.view.failed = (error) => this.fail(error);
    this.prepareControls();
    new ResizeObserver(() => this.panel.mark()).observe(this.view.canvas);
  }

  prepareControls() {
    const { view, stream } = this;
    input("levels").max = String(stream.tree_height + 1);
    any("levels-label").hidden = stream.tree_height === 0;
    for (const [id, name] of NUMBERS) {
      input(id).addEventListener("change", () => view.change({ [name]: numberIn(id) ?? view.camera[name] }));
    }
    input("fov").addEventListener("change", () => view.change({ fov: numberIn("fov") }));
    input("levels").addEventListener("input", () => {
      const levels = Number(input("levels").value);
      view.change({ levels: levels > stream.tree_height ? 0 : levels });
    });
    for (const name of /** @type {const} */ (["geometry", "filter"])) {
      select(name).addEventListener("change", () => view.change({ [name]: select(name).value }));
    }
    any("more").addEventListener("click", () => {
      this.showDetails(any("details").hidden);
      this.moved(this.link());
    });
    view.canvas.addEventListener("keydown", ({ key }) => {
      if (key === "p") this.panel.toggle();
      if (key === "g") view.change({ geometry: view.camera.geometry === "plane" ? "stream" : "plane" });
    });
  }

  /** @param {boolean} shown */
  showDetails(shown) {
    any("details").hidden = !shown;
    any("look").classList.toggle("detailed", shown);
    any("more").setAttribute("aria-expanded", String(shown));
  }

  /**
   * Whether the click asks how a pixel comes about.
   * @param {number} x @param {number} y in [0, 1) of the frame @param {boolean} alt
   */
  trace(x, y, alt) {
    const { width, height } = this.view.canvas;
    if (alt || this.panel.open) this.panel.choose(Math.floor(x * width), Math.floor(y * height));
    return alt || this.panel.open;
  }

  /**
   * The view that is nearest to the camera.
   * @returns {import("./ask.js").Query}
   */
  nearestView() {
    const { u, v } = this.view.camera;
    const row = within(Math.round(v), 0, this.stream.rows - 1);
    return { view: `${row},${within(Math.round(u), 0, this.stream.cols - 1)}` };
  }

  /**
   * The camera of a link; without one it moves.
   * @param {URLSearchParams} query
   */
  open(query) {
    const given = ["camera", "look-at", "focus", "aperture", "geometry", "filter", "levels", "fov", "trace"].some((name) => query.has(name));
    this.panel.read(query);
    this.showDetails(query.has("details"));
    if (!given) return this.view.put(this.frames.start);
    const camera = middleCamera(this.stream);
    readCamera(camera, query);
    this.view.change(camera);
  }

  /** @returns {import("./ask.js").Query} */
  link() {
    return { ...placeQuery(this.camera()), ...(any("details").hidden ? {} : { details: 1 }), ...this.panel.link() };
  }

  camera() {
    return /** @type {import("./camera.js").Camera} */ (this.view.frameCamera());
  }

  /** @param {import("./server_frames.js").ServerShown} shown @param {number | undefined} begin when its input came */
  shown({ half, cost, query }, begin) {
    const end = performance.now();
    if (begin !== undefined) {
      performance.measure("input to picture", { start: begin, end, detail: { half, keySamples: cost.key_samples } });
    }
    this.drawnAt = [...this.drawnAt.filter((at) => end - at < 1000), end];
    say("look-error", "");
    this.recorder.add(query);
    this.views = cost.views;
    any("look-outside").textContent = cost.outside > 0
      ? `${(100 * cost.outside).toFixed(1)} % of the frame sees nothing of the light field: move the camera nearer to the views, or narrow the field of view` : "";
    const [count, span] = [this.drawnAt.length, end - this.drawnAt[0]];
    any("fps").textContent = count < 3 || span < 200 ? "–" : (((count - 1) * 1000) / span).toFixed(0);
    any("seconds").textContent = `${(cost.seconds * 1000).toFixed(1)} ms`;
    for (const name of ["needed", "decoded", "reused", "touched", "key_samples"]) any(name).textContent = grouped(cost[name]);
    this.map.draw({ used: this.views, camera: this.camera() });
    if (half || this.view.wanted || this.view.moving) return;
    this.moved(this.link());
    if (this.panel.open) void this.panel.ask();
  }

  /** @param {Error} error */
  fail(error) {
    say("look-error", error.message);
    this.view.canvas.dataset.exact = "false";
  }

  showControls() {
    const camera = this.camera();
    for (const [id, name] of NUMBERS) input(id).value = String(Number(camera[name].toFixed(4)));
    input("fov").value = camera.fov === null ? "" : String(camera.fov);
    const levels = camera.levels === 0 ? this.stream.tree_height + 1 : camera.levels;
    input("levels").value = String(levels);
    any("levels-value").textContent = `${levels} of ${this.stream.tree_height + 1}`;
    select("geometry").value = camera.geometry;
    select("filter").value = camera.filter;
    const query = this.frames.query(camera);
    any("save").setAttribute("href", address("frame.png", query));
    any("look-command").textContent = renderCommand(this.stream.file, query);
    this.map.draw({ used: this.views, camera });
  }
}
