// Frames that the server draws: bytes of `hmlfc render`. While the camera moves and whole frames take long, they have
// half the size.
import { address, askJson, askPicture } from "./ask.js";
import { cameraQuery, middleCamera } from "./camera.js";
import { canvas, context } from "./dom.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {{half: boolean, exact: boolean, cost: any, query: import("./ask.js").Query}} ServerShown exact: a frame of `query` */

const SLOW = 24; // milliseconds for a whole frame, above which moving ones are coarse
const COARSE = 40; // times as long as that frame took

/** @param {import("./ask.js").Query} query with focus-at in place of its focus */
const focusOf = ({ focus: _, ...query }) => askJson("focus", query);

export class ServerFrames {
  /** @param {any} stream what the server says of it */
  static async open(stream) {
    const frames = new ServerFrames(stream);
    const { width, height } = stream;
    const query = { ...cameraQuery(frames.start, width, height), "focus-at": `${width >> 1},${height >> 1}` };
    const { focus } = await focusOf(query).catch(() => ({ focus: 0 }));
    Object.assign(frames.start, { focus, aperture: 1 });
    return frames;
  }

  /** @param {any} stream */
  constructor(stream) {
    this.facts = stream;
    this.start = middleCamera(stream);
    const [nearest, farthest] = stream.disparity ?? [-4, 4];
    const reach = Math.max(1, (farthest - nearest) / 2);
    this.depths = /** @type {[number, number]} */ ([
      Math.max(-256, Math.floor(nearest - reach)), Math.min(256, Math.ceil(farthest + reach))]);
    this.canvas = canvas("frame");
    this.part = document.createElement("canvas");
    this.coarseUntil = 0;
  }

  /**
   * The query for a frame, which has a whole aperture.
   * @param {Camera} camera
   */
  query(camera, half = false) {
    const [width, height] = [this.canvas.width, this.canvas.height].map((side) => (half ? Math.ceil(side / 2) : side));
    return cameraQuery(camera, width, height);
  }

  /**
   * An aperture between two whole ones shows a part of the frame of each.
   * @param {Camera} camera @param {boolean} moving @returns {Promise<ServerShown>}
   */
  async draw(camera, moving) {
    const begin = performance.now();
    const half = moving && begin < this.coarseUntil;
    const less = Math.floor(camera.aperture);
    const query = this.query({ ...camera, aperture: less }, half);
    const { pixels, cost } = await askPicture("frame", query);
    const part = camera.aperture - less;
    const more = part > 0 ? await askPicture("frame", this.query({ ...camera, aperture: less + 1 }, half)) : null;
    this.show(pixels, 1);
    if (more) this.show(more.pixels, part);
    const took = performance.now() - begin;
    if (moving && !half && took > SLOW) this.coarseUntil = begin + COARSE * took;
    const exact = !half && part === 0;
    Object.assign(this.canvas.dataset, { exact: String(exact), query: address("", query) });
    return { half, exact, cost, query };
  }

  /**
   * Over what is there, by `part` of it.
   * @param {ImageData} pixels @param {number} part
   */
  show(pixels, part) {
    const { width, height } = this.canvas;
    const draw = context(this.canvas);
    if (part === 1 && pixels.width === width && pixels.height === height) return draw.putImageData(pixels, 0, 0);
    Object.assign(this.part, { width: pixels.width, height: pixels.height });
    context(this.part).putImageData(pixels, 0, 0);
    draw.globalAlpha = part;
    draw.drawImage(this.part, 0, 0, width, height);
    draw.globalAlpha = 1;
  }

  /**
   * Null where the pixel shows nothing, or nothing that is known.
   * @param {Camera} camera @param {number} x @param {number} y @returns {Promise<number | null>}
   */
  async focusOf(camera, x, y) {
    const asked = focusOf({ ...this.query(camera), "focus-at": `${x},${y}` });
    return (await asked.catch((error) => {
      if (error.message.includes("focus at")) return { focus: null };
      throw error;
    })).focus;
  }
}
