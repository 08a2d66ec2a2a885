// The renderer of HMLFC on WebGPU: frames of docs/rendering.md, the same bytes as `hmlfc render`. What
// gpu_ref/render does on Vulkan: one submission a frame, which reads back nothing but the counters; buffers and
// bindings are made again only where a frame of another form or with more blocks comes.

import {DeviceBuffers, INDIRECT, MAP_READ, COPY_TARGET, UNIFORM, workgroupsOf} from "./device_buffers.js";
import {kernelsOf, REFERENCE_KERNELS, FRAME_KERNELS, GEOMETRY_KERNELS, PLANE_KERNELS} from "./kernels.js";
import {Picture} from "./picture.js";

/** @typedef {any} GPUDevice */
/** @typedef {any} GPUBuffer */
/** @typedef {import("./stream_client.js").Facts} Facts */

// Of shared_numbers.glsl.
const COUNTERS = 13;
const COUNT = {needed: 0, mode: 4, decoded: 5, pages: 6, firstError: 9, status: 10, lookedUp: 12};
const NO_ERROR = 0xffffffff;
const NO_ROOM = 0;
const NOTHING_HELD = 0xffffffff;

const KEPT_BYTES = 1 << 27; // of decoded blocks, between frames
const FIRST_CAPACITY = 1 << 19; // blocks, at most: a frame beyond it is drawn twice
const SLOTS = 32; // of a page
const FRAME_WORDS = 50; // of the numbers of Frame (frame.glsl), from the pool's address on
const UNDER_WAY = 3;
const GROUP = 8; // pixels, each way
const MOST_DISPARITY_BYTES = 1 << 28;

// Places in the shape (stream_shape.glsl).
const LEVELS_AT = 28, LEVEL_WORDS = 16, PLANES_AT = 284, PLANE_WORDS = 16;

/** @type {(a: number, b: number) => number} */
const ceilDiv = (a, b) => Math.ceil(a / b);
/** @type {(record: Uint32Array, stopLevel: number) => boolean} */
const isGeometry = (record, stopLevel) => record[37] === 1 && stopLevel === 0;

/**
 * `error`: of annex A, 0 for none; then the frame is black.
 * @typedef {{error: number, blocksNeeded: number, blocksDecoded: number, disparitiesLookedUp: number}} FrameResult
 */

/** Kernels are compiled when they are first needed, or before by compileFrames(). */
export class FrameRenderer {
  /**
   * @param {GPUDevice} device @param {URL} folder of the kernels
   * @param {Facts} facts @param {Uint32Array} shape of the stream
   */
  constructor(device, folder, facts, shape) {
    if (facts.blocks >= NO_ERROR) throw new Error("limit_exceeded: the views have 2^32 - 1 blocks or more");
    this.device = device;
    this.folder = folder;
    this.facts = facts;
    this.shape = shape;
    this.buffers = new DeviceBuffers(device, {});
    const {buffers} = this;
    this.#sampleWords = 1 << (2 * facts.blockLog2 - 1);
    const words = this.#wordsOfLevel(0);
    this.#keptPages = Math.min(words, Math.floor(KEPT_BYTES / (4 * SLOTS * this.#sampleWords)));
    buffers.write("shape", shape, UNIFORM | COPY_TARGET);
    buffers.write("damage", [0]);
    buffers.make("stream", facts.codedBytes + 4);
    buffers.make("references", facts.areaBytes);
    for (const name of ["needed", "held", "pages", "looked_up"]) buffers.make(name, 4 * words);
    buffers.make("counters", 4 * COUNTERS);
    buffers.make("results", 4 * COUNTERS);
    buffers.make("frame", 4 * FRAME_WORDS);
    buffers.make("dispatches", 24, INDIRECT);
    this.#makeRoom(Math.min(FIRST_CAPACITY, 32 * words), 1);
    this.#picture = new Picture(device, facts.depth);
  }

  /** Gives back the memory of the device. */
  close() {
    this.buffers.close();
    for (const {readback} of this.#ring) readback.destroy();
  }

  /**
   * Bytes of the file have come.
   * @param {Uint8Array} file @param {number} begin @param {number} end in the file
   */
  writeStream(file, begin, end) {
    const {codedOffset, codedBytes} = this.facts;
    const first = Math.max(0, begin - codedOffset) & ~3;
    const last = Math.min(codedBytes, end - codedOffset);
    if (first >= last) return;
    const words = new Uint8Array(4 * ceilDiv(last - first, 4));
    words.set(file.subarray(codedOffset + first, Math.min(codedOffset + codedBytes, codedOffset + first + words.length)));
    this.device.queue.writeBuffer(this.buffers.get("stream"), first, words);
  }

  /**
   * A plane of a key image.
   * @param {{error: number, first: number, words: Uint32Array}} plane
   */
  writeKeyPlane({error, first, words}) {
    this.device.queue.writeBuffer(this.buffers.get("references"), 4 * first, words);
    if (error !== 0) this.buffers.write("damage", [1]);
  }

  /**
   * The disparities of a view.
   * @param {number} row @param {number} col @param {Uint32Array} words
   */
  writeDisparities(row, col, words) {
    const {rows, cols, blocksX, blocksY} = this.facts;
    const bytes = 4 * blocksX * blocksY;
    if (bytes * rows * cols > MOST_DISPARITY_BYTES) throw new Error("limit_exceeded: the disparities of all views");
    const buffer = this.buffers.has("disparities") ? this.buffers.get("disparities") :
        this.buffers.make("disparities", bytes * rows * cols);
    this.device.queue.writeBuffer(buffer, bytes * (row * cols + col), words);
  }

  /**
   * Decodes the residuals of reference images whose tiles have come (DEC-4).
   * @param {import("./stream_client.js").TreeImage[]} images
   */
  async decodeReferences(images) {
    if (images.length === 0) return;
    const {buffers} = this;
    await this.#compiled(REFERENCE_KERNELS);
    for (const {level, row, col} of images) {
      for (let plane = 0; plane < 3; ++plane) {
        const [columns, rows] = this.shape.subarray(PLANES_AT + PLANE_WORDS * plane + 2);
        const most = Math.max(1, Math.floor(this.#capacity / columns));
        for (let by = 0; by < rows; by += most) {
          const requests = columns * Math.min(most, rows - by);
          this.#reserve(requests);
          buffers.write("areas", [0, row, col, plane, level, 0, by, columns, 1, 0, 0, 0]);
          buffers.write("arguments", [1, requests, 0, 0], UNIFORM | COPY_TARGET);
          const encoder = this.device.createCommandEncoder();
          const pass = encoder.beginComputePass();
          buffers.dispatch(pass, "expand", workgroupsOf(requests));
          buffers.dispatch(pass, "reference_walk", workgroupsOf(requests));
          buffers.dispatch(pass, "residuals", workgroupsOf(requests * this.#lanes()));
          pass.end();
          this.device.queue.submit([encoder.finish()]);
        }
      }
    }
  }

  /** What frames before have decoded is not used: it may lack bytes that have come since. */
  forget() {
    this.#forget = 1;
  }

  /**
   * Draws a frame into `target`, a canvas of its size, if there is one. All that it needs has come. `kept`: the part
   * that the frame of keep() has in what is shown.
   * @param {Uint32Array} record the frame record @param {number} stopLevel @param {any} [target] GPUCanvasContext
   * @returns {Promise<FrameResult>}
   */
  async draw(record, stopLevel, target, kept = 0) {
    await this.#compiled(FRAME_KERNELS);
    await this.#compiled(isGeometry(record, stopLevel) ? GEOMETRY_KERNELS : PLANE_KERNELS);
    for (let tries = 0;; ++tries) {
      const counters = await this.#submit(record, stopLevel, target, kept);
      if (counters[COUNT.mode] !== NO_ROOM) {
        return {
          error: counters[COUNT.firstError] === NO_ERROR ? 0 : counters[COUNT.status],
          blocksNeeded: counters[COUNT.needed], blocksDecoded: counters[COUNT.decoded],
          disparitiesLookedUp: counters[COUNT.lookedUp],
        };
      }
      if (tries > 0) throw new Error("the device counts other blocks for the same frame");
      this.#makeRoom(counters[COUNT.decoded], counters[COUNT.pages]);
    }
  }

  /** Keeps the frame drawn last, to be shown with the next one. */
  keep() {
    const {size} = this.buffers.get("drawn");
    const encoder = this.device.createCommandEncoder();
    encoder.copyBufferToBuffer(this.buffers.get("drawn"), 0, this.buffers.make("kept", size), 0, size);
    this.device.queue.submit([encoder.finish()]);
  }

  /** R, G, B and A of the frame drawn last, for tests: 8 bits each at depth 8, else 16. */
  async pixels() {
    const [width, height] = this.#form;
    const size = width * height * (this.facts.depth === 8 ? 4 : 8);
    const readback = this.device.createBuffer({size, usage: MAP_READ | COPY_TARGET});
    const encoder = this.device.createCommandEncoder();
    encoder.copyBufferToBuffer(this.buffers.get("drawn"), 0, readback, 0, size);
    this.device.queue.submit([encoder.finish()]);
    await readback.mapAsync(1);
    const bytes = readback.getMappedRange().slice(0);
    readback.destroy();
    return this.facts.depth === 8 ? new Uint8Array(bytes) : new Uint16Array(bytes);
  }

  #sampleWords = 0; // of a block
  #keptPages = 0;
  #pages = 0; // of the pool
  #capacity = 0; // requests
  #forget = 0;
  #form = [0, 0];
  #frame = new Uint32Array(FRAME_WORDS);
  #firstCounters = Uint32Array.from({length: COUNTERS}, (_, i) => (i === COUNT.firstError ? NO_ERROR : 0));
  /** @type {{readback: GPUBuffer, free: boolean}[]} */
  #ring = [];
  /** @type {Picture} */
  #picture;

  /** @param {string[]} names */
  async #compiled(names) {
    const {kernels} = this.buffers;
    if (!names.every(name => kernels[name])) Object.assign(kernels, await kernelsOf(this.device, this.folder, names));
  }

  /**
   * Words of one bit for each block of a level.
   * @param {number} level
   */
  #wordsOfLevel(level) {
    const {rows, cols, blocks} = this.facts;
    const [levelRows, levelCols] = this.shape.subarray(LEVELS_AT + LEVEL_WORDS * level);
    return ceilDiv((blocks / (rows * cols)) * levelRows * levelCols, 32);
  }

  /** Invocations of a block (block_lanes.glsl). */
  #lanes() {
    return ceilDiv(2 * this.#sampleWords, 8);
  }

  /**
   * Room for so many requests of one submission.
   * @param {number} requests
   */
  #reserve(requests) {
    this.buffers.make("requests", 12 * requests);
    this.buffers.make("entries", 32 * this.facts.levels * requests);
    this.buffers.make("slots", 8 * requests);
  }

  /** @param {number} requests @param {number} pages */
  #makeRoom(requests, pages) {
    if (requests > this.#capacity) {
      this.#capacity = Math.max(requests, Math.min(2 * this.#capacity, this.#wordsOfLevel(0) * 32));
      this.#reserve(this.#capacity);
    }
    if (pages <= this.#pages) return;
    this.#pages = Math.max(pages, this.#keptPages, Math.min(2 * this.#pages, this.#wordsOfLevel(0)));
    this.buffers.make("pool", 4 * SLOTS * this.#sampleWords * this.#pages);
    this.buffers.write("used_pages", [NOTHING_HELD, 0]);
  }

  /** @param {Uint32Array} record @param {number} stopLevel */
  #writeFrame(record, stopLevel) {
    const numbers = [0, 0, 0, this.#pages, this.#keptPages, stopLevel, this.#capacity, this.#wordsOfLevel(stopLevel),
      this.#forget];
    this.#forget = 0;
    this.#frame.set(numbers);
    this.#frame.set(record, numbers.length);
    this.device.queue.writeBuffer(this.buffers.get("frame"), 0, this.#frame);
    this.device.queue.writeBuffer(this.buffers.get("counters"), 0, this.#firstCounters);
  }

  /** @param {number} width @param {number} height */
  #prepare(width, height) {
    const groups = ceilDiv(width, GROUP) * ceilDiv(height, GROUP);
    this.buffers.make("rays", 16 * groups * GROUP * GROUP);
    this.buffers.make("displacements", 4 * ceilDiv(width, 4) * ceilDiv(height, 4));
    this.buffers.make("drawn", width * height * (this.facts.depth === 8 ? 4 : 8));
    this.#form = [width, height];
  }

  /** A buffer that the host reads counters from. */
  #readback() {
    let found = this.#ring.find(one => one.free);
    if (!found) {
      if (this.#ring.length === UNDER_WAY) throw new Error(`${UNDER_WAY} frames are under way`);
      const readback = this.device.createBuffer({size: 4 * COUNTERS, usage: MAP_READ | COPY_TARGET});
      found = {readback, free: true};
      this.#ring.push(found);
    }
    found.free = false;
    return found;
  }

  /**
   * The counters of the frame.
   * @param {Uint32Array} record @param {number} stopLevel @param {any} target @param {number} kept
   */
  async #submit(record, stopLevel, target, kept) {
    const {device, buffers} = this;
    const [width, height] = record;
    const geometry = isGeometry(record, stopLevel);
    const variant = geometry ? "_geometry" : "";
    const slot = this.#readback();
    try {
      this.#prepare(width, height);
      this.#writeFrame(record, stopLevel);
      const groups = [ceilDiv(width, GROUP), ceilDiv(height, GROUP)];
      const encoder = device.createCommandEncoder();
      const pass = encoder.beginComputePass();
      if (geometry) buffers.dispatch(pass, "surface", workgroupsOf(ceilDiv(width, 4) * ceilDiv(height, 4)));
      buffers.dispatch(pass, `mark${variant}`, groups);
      buffers.dispatch(pass, "plan", [1, 1]);
      buffers.dispatch(pass, "compact", workgroupsOf(this.#wordsOfLevel(stopLevel)));
      buffers.dispatchCounted(pass, "frame_walk", 0);
      buffers.dispatchCounted(pass, "frame_samples", 12);
      buffers.dispatch(pass, `render${variant}`, groups);
      pass.end();
      if (target) this.#picture.show(encoder, buffers, target, width, height, kept);
      encoder.copyBufferToBuffer(buffers.get("results"), 0, slot.readback, 0, 4 * COUNTERS);
      device.queue.submit([encoder.finish()]);
      await slot.readback.mapAsync(1);
      const counters = new Uint32Array(slot.readback.getMappedRange().slice(0));
      slot.readback.unmap();
      return counters;
    } finally {
      slot.free = true;
    }
  }
}
