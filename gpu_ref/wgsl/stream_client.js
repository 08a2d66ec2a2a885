// What a page knows of a stream: asked of workers that run the module in WebAssembly.

import {ask, CHUNK, RangedFile} from "./ranged_file.js";

// stream_module.cpp gives the facts in this order, then the shape.
const FACTS = [
  "rows", "cols", "width", "height", "depth", "blockLog2", "levels", "chromaHalved", "blocksX", "blocksY", "codedOffset",
  "codedBytes", "rootBytes", "areaBytes", "blocks", "geometry",
];
const MISSING = -1;
const BAD_CAMERA = -2;
const RECORD_WORDS = 41;

/** @typedef {Record<string, number>} Facts */
/** @typedef {{level: number, row: number, col: number}} TreeImage */
/** @typedef {{keys: TreeImage[], references: TreeImage[], ranges: import("./ranged_file.js").Range[]}} Needs */
/**
 * A camera as `hmlfc render` takes it: places in columns and rows of views, `at` it looks at; filter 2: quadrilinear.
 * @typedef {{width: number, height: number, u: number, v: number, z: number, atU: number, atV: number, atZ: number,
 *            focus: number, aperture: number, filter: number, geometry: number}} FrameCamera
 */

/** @param {FrameCamera} camera */
const inputsOf = ({width, height, u, v, z, atU, atV, atZ, focus, aperture, filter, geometry}) =>
    [width, height, u, v, z, atU, atV, atZ, focus, aperture, filter, geometry];

/** One worker: a job after the other. */
class StreamWorker {
  /** @param {RangedFile} file @param {WebAssembly.Module} code */
  constructor(file, code) {
    this.file = file;
    /** @type {WebAssembly.Module | undefined} */
    this.code = code;
    this.worker = new Worker(new URL("./stream_worker.js", import.meta.url));
    /** @type {Set<number>} */
    this.has = new Set();
    /** @type {Promise<any>} */
    this.last = Promise.resolve();
    this.waiting = 0;
  }

  /**
   * The words of the answer.
   * @param {string} call @param {number[]} numbers @param {number[]} [camera]
   */
  ask(call, numbers = [], camera) {
    ++this.waiting;
    const answer = this.last.then(() => this.#run(call, numbers, camera)).finally(() => --this.waiting);
    this.last = answer.catch(() => {});
    return answer;
  }

  /** @param {string} call @param {number[]} numbers @param {number[] | undefined} camera */
  async #run(call, numbers, camera) {
    /** @type {import("./ranged_file.js").Range[]} */
    let ranges = [];
    for (;;) {
      await this.file.load(ranges);
      const {status, words} = await this.#post(call, numbers, camera, ranges);
      if (status === 0) return words;
      if (status === BAD_CAMERA) throw new Error(String.fromCharCode(...words));
      if (status !== MISSING) throw new Error(`the file of this light field is damaged or cut (error ${status})`);
      ranges = [];
      for (let i = 0; i < words.length; i += 2) ranges.push([words[i], words[i + 1]]);
      const lacks = this.file.chunksOf(ranges).some(k => !this.has.has(k));
      if (!lacks) throw new Error("the file of this light field is damaged: it says what no file has");
    }
  }

  /**
   * @param {string} call @param {number[]} numbers @param {number[] | undefined} camera
   * @param {import("./ranged_file.js").Range[]} ranges that it lacks
   * @returns {Promise<{status: number, words: Uint32Array}>}
   */
  #post(call, numbers, camera, ranges) {
    const chunks = this.file.chunksOf(ranges).filter(k => !this.has.has(k));
    for (const k of chunks) this.has.add(k);
    return new Promise((resolve, reject) => {
      this.worker.onerror = event => reject(new Error(event.message ?? "stream_worker.js has not come from the host"));
      this.worker.onmessage = ({data}) => (data.failure ? reject(new Error(data.failure)) : resolve(data));
      this.worker.postMessage({
        code: this.code, size: this.file.size, camera, call, numbers,
        chunks: chunks.map(k => [k * CHUNK, this.file.bytes.slice(k * CHUNK, (k + 1) * CHUNK)]),
      });
      this.code = undefined;
    });
  }
}

/** A stream that is open. */
export class StreamClient {
  /**
   * @param {string} address of the stream
   * @param {URL} folder of the module, hmlfc_stream.wasm
   */
  static async open(address, folder, threads = Math.max(2, Math.min(4, navigator.hardwareConcurrency))) {
    // Not compileStreaming(), which takes it only as application/wasm: many hosts do not know that type.
    const code = ask(new URL("hmlfc_stream.wasm", folder).href).then(answer => answer.arrayBuffer()).then(WebAssembly.compile);
    code.catch(() => {});
    const file = await RangedFile.open(address);
    const compiled = await code;
    const client = new StreamClient(file, Array.from({length: threads}, () => new StreamWorker(file, compiled)));
    await client.#begin();
    return client;
  }

  /** @param {RangedFile} file @param {StreamWorker[]} workers */
  constructor(file, workers) {
    this.file = file;
    /** @type {Facts} */
    this.facts = {};
    this.shape = new Uint32Array(0); // StreamShape of stream_shape.glsl
    this.#workers = workers;
  }

  /** Ends the workers. */
  close() {
    for (const {worker} of this.#workers) worker.terminate();
  }

  /**
   * The frame record, and the views that it uses: first and last row, first and last column.
   * @param {FrameCamera} camera
   */
  async record(camera) {
    const words = await this.#workers[0].ask("frame_record", [], inputsOf(camera));
    return {record: words.subarray(0, RECORD_WORDS), views: [...words.subarray(RECORD_WORDS)]};
  }

  /**
   * What frames of these views need.
   * @param {number[]} views @param {number} stopLevel @returns {Promise<Needs>}
   */
  async needs(views, stopLevel) {
    const words = await this.#workers[0].ask("frame_needs", [...views, stopLevel]);
    let at = 0;
    const images = () => Array.from({length: words[at++]}, () => (
      {level: words[at++], row: words[at++], col: words[at++]}));
    const [keys, references] = [images(), images()];
    /** @type {import("./ranged_file.js").Range[]} */
    const ranges = [];
    for (; at < words.length; at += 2) ranges.push([words[at], words[at + 1]]);
    return {keys, references, ranges};
  }

  /**
   * A plane of a key image for the reference area.
   * @param {TreeImage} image @param {number} plane
   */
  async keyPlane({level, row, col}, plane) {
    const words = await this.#work("key_plane", [level, row, col, plane]);
    return {error: words[0], first: words[1], words: words.subarray(2)};
  }

  /**
   * The disparities of a view, for the device.
   * @param {number} row @param {number} col
   */
  disparities(row, col) {
    return this.#work("disparities", [row, col]);
  }

  /**
   * The focus of what pixel (x, y) shows, or null.
   * @param {FrameCamera} camera @param {number} x @param {number} y
   */
  async focus(camera, x, y) {
    const [sight, disparity] = await this.#workers[0].ask("focus", [x, y], inputsOf(camera));
    return sight === 0 ? (disparity | 0) / 256 : null;
  }

  /** @type {StreamWorker[]} */
  #workers;
  /** @type {Map<StreamWorker, Promise<any>>} */
  #openings = new Map();

  /**
   * Asks the worker with the least to do; the first one has to answer at once.
   * @param {string} call @param {number[]} numbers
   */
  async #work(call, numbers) {
    const workers = this.#workers.length > 1 ? this.#workers.slice(1) : this.#workers;
    const worker = workers.reduce((least, one) => (one.waiting < least.waiting ? one : least));
    await this.#opened(worker);
    return worker.ask(call, numbers);
  }

  /** @param {StreamWorker} worker */
  #opened(worker) {
    if (!this.#openings.has(worker)) this.#openings.set(worker, worker.ask("open"));
    return /** @type {Promise<Uint32Array>} */ (this.#openings.get(worker));
  }

  async #begin() {
    const words = await this.#opened(this.#workers[0]);
    this.facts = Object.fromEntries(FACTS.map((name, i) => [name, words[i]]));
    this.shape = words.subarray(FACTS.length);
  }
}
