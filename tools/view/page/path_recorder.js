// Records the cameras of frames as a path for `hmlfc render --path`.
import { any, make } from "./dom.js";

/** @typedef {import("./ask.js").Query} Query */

/**
 * A camera as a JSON path has it (docs/aiming.md).
 * @param {Query} query of a frame
 */
function pathFrame(query) {
  const numbers = (/** @type {string} */ name) => String(query[name]).split(",").map(Number);
  return {
    position: numbers("camera"),
    ...("look-at" in query ? { look_at: numbers("look-at") } : {}),
    ...("fov" in query ? { fov: Number(query.fov) } : {}),
    focus: Number(query.focus),
    aperture: Number(query.aperture),
  };
}

export class PathRecorder {
  /** @param {string} file the stream's @param {string} size of a frame */
  constructor(file, size) {
    this.file = file;
    this.size = size;
    /** @type {Query[] | null} */
    this.frames = null;
    any("record").addEventListener("click", () => this.toggle());
  }

  /**
   * The camera of a frame that was drawn.
   * @param {Query} query
   */
  add(query) {
    if (this.frames === null) return;
    const { size: _, ...camera } = query;
    if (JSON.stringify(camera) !== JSON.stringify(this.frames.at(-1))) this.frames.push(camera);
  }

  toggle() {
    const frames = this.frames;
    this.frames = frames === null ? [] : null;
    any("record").textContent = frames === null ? "Stop and save" : "Record path";
    any("record").setAttribute("aria-pressed", String(frames === null));
    if (frames !== null && frames.length > 0) this.save(frames);
  }

  /** @param {Query[]} frames */
  save(frames) {
    const text = JSON.stringify(frames.map(pathFrame), null, 1);
    const link = make("a", { download: "path.json", href: URL.createObjectURL(new Blob([text], { type: "application/json" })) });
    link.click();
    const { geometry, filter } = frames[frames.length - 1];
    any("look-status").textContent = `${frames.length} cameras in path.json: hmlfc render ${this.file} --path path.json ` +
      `--size ${this.size} --geometry ${geometry} --filter ${filter} -o frames`;
  }
}
