// Pictures of a plane of a view, and what else the server knows of it, each asked for once.
import { askPicture, askSamples } from "./ask.js";
import { context } from "./dom.js";
import { stagePicture } from "./stage_picture.js";

/** @typedef {import("./ask.js").Query} Query */
/** @typedef {{shown: HTMLCanvasElement, samples: Int16Array | null}} Picture samples where it has one a pixel */

const KEPT = 16; // answers

/** @param {ImageData} pixels */
function picture(pixels) {
  const made = document.createElement("canvas");
  made.width = pixels.width;
  made.height = pixels.height;
  context(made).putImageData(pixels, 0, 0);
  return made;
}

export class PlanePictures {
  /** @param {number} depth bits of a sample */
  constructor(depth) {
    this.depth = depth;
    /** @type {Map<string, Promise<any>>} */
    this.kept = new Map();
  }

  /**
   * The answer to a question, asked once; the last ones are kept.
   * @template T @param {string} name @param {Query} query @param {(query: Query) => Promise<T>} ask @returns {Promise<T>}
   */
  once(name, query, ask) {
    const key = name + JSON.stringify(query);
    const made = this.kept.get(key) ?? ask(query);
    this.kept.delete(key);
    this.kept.set(key, made);
    made.catch(() => this.kept.delete(key));
    if (this.kept.size > KEPT) this.kept.delete([...this.kept.keys()][0]);
    return made;
  }

  /**
   * A picture in RGB from the address `name`.
   * @param {string} name @param {Query} query @returns {Promise<HTMLCanvasElement>}
   */
  rgb(name, query) {
    return this.once(name, query, (asked) => askPicture(name, asked).then(({ pixels }) => picture(pixels)));
  }

  /**
   * The picture of a stage.
   * @param {string} stage "picture", "original", a stage of inspect, or a difference; "twin-..." of the stream beside it
   * @param {Query} plane with the plane @param {any} blocks what the server says of it @returns {Promise<Picture>}
   */
  async stage(stage, plane, blocks) {
    const { plane: name, ...view } = plane;
    if (stage.endsWith("picture") || stage === "original") return { shown: await this.rgb(stage, view), samples: null };
    if (stage.endsWith("difference")) return { shown: await this.rgb(stage, { ...view, gain: 4 }), samples: null };
    const [twin, own] = stage.startsWith("twin-") ? ["twin-", stage.slice(5)] : ["", stage];
    const samples = await this.once(`${twin}stage`, { ...plane, stage: own }, (asked) => askSamples(`${twin}stage`, asked));
    const signed = name !== "Y" || own === "residual";
    return { shown: picture(stagePicture(samples, blocks.width, blocks.height, signed, this.depth)), samples };
  }
}
