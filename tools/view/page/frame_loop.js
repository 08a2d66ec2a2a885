// Asks for one frame at a time: the newest that is wanted, never a queue. While the camera moves and
// whole frames take long, frames have half the size; once it is still, the whole frame is drawn.
import { askPicture } from "./ask.js";

/** @typedef {import("./ask.js").Query} Query */
/** @typedef {{pixels: ImageData, cost: any, exact: boolean, query: Query}} Drawn */

const STILL = 120; // milliseconds without input
const SLOW = 24; // milliseconds for a whole frame, above which moving ones are coarse
const COARSE = 40; // times as long as that frame took

export class FrameLoop {
  /**
   * @param {(half: boolean) => Query} wanted the frame that is wanted now
   * @param {(frame: Drawn) => void} draw
   * @param {(error: Error) => void} fail
   */
  constructor(wanted, draw, fail) {
    this.wanted = wanted;
    this.draw = draw;
    this.fail = fail;
    this.running = false;
    this.dirty = false;
    this.inputAt = 0;
    this.coarseUntil = 0;
    this.timer = 0;
    /** @type {number[]} */
    this.drawnAt = [];
  }

  /**
   * Another frame is wanted.
   * @param {boolean} moving whether by a movement that may go on
   */
  want(moving = false) {
    this.dirty = true;
    const now = performance.now();
    if (moving) this.inputAt = now;
    this.pending = this.pending ?? now;
    clearTimeout(this.timer);
    if (!this.running) void this.run();
  }

  async run() {
    this.running = true;
    while (this.dirty) {
      const begin = performance.now();
      const moving = begin - this.inputAt < STILL;
      const half = moving && begin < this.coarseUntil;
      const input = this.pending ?? performance.now();
      this.dirty = false;
      this.pending = undefined;
      await this.frame(half, input);
      const took = performance.now() - begin;
      if (moving && !half && took > SLOW) this.coarseUntil = begin + COARSE * took;
      if (half && !this.dirty) this.timer = setTimeout(() => this.want(), STILL);
    }
    this.running = false;
  }

  /** @param {boolean} half @param {number} input when its input came */
  async frame(half, input) {
    const query = this.wanted(half);
    let cost;
    try {
      const { pixels, cost: told } = await askPicture("frame", query);
      cost = told;
      this.draw({ pixels, cost, exact: !half, query });
    } catch (error) {
      this.fail(/** @type {Error} */ (error));
      return;
    }
    const end = performance.now();
    performance.measure("input to picture", { start: input, end, detail: { half, keySamples: cost.key_samples } });
    this.drawnAt = [...this.drawnAt.filter((at) => end - at < 1000), end];
  }

  /** Frames drawn a second, over the last one. */
  rate() {
    const [first] = this.drawnAt;
    const span = performance.now() - first;
    return this.drawnAt.length < 3 || span < 200 ? null : ((this.drawnAt.length - 1) * 1000) / span;
  }
}
