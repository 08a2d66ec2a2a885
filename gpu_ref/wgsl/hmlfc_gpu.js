// The decoder of HMLFC on WebGPU: blocks and pixels of a stream, bit-exact to the golden model. A plain module; the
// kernels, *.wgsl, lie next to it.
//
//   const device = await (await navigator.gpu.requestAdapter()).requestDevice();
//   const decoder = await HmlfcGpu.open(device, streamBytes, areaBytes);  // hmlfc reference-area STREAM -o AREA
//   const {width, height, texels, statuses} = await decoder.decodeView(0, 0);

import {Batch, groups} from "./batch.js";
import {DECODER_KERNELS, kernelsOf} from "./kernels.js";

// WebGPU has no types yet.
/** @typedef {any} GPUDevice */
/** @typedef {any} GPUBuffer */
/** @typedef {any} GPUCommandEncoder */
/** @typedef {Object<string, number>} Header */
/** @typedef {import("./kernels.js").Kernel} Kernel */
/** @typedef {import("./batch.js").BlockArea} BlockArea */
/** @typedef {import("./batch.js").PixelArea} PixelArea */

// The numbers at the beginning of a file of `hmlfc reference-area` (gpu_ref/decode/reference_area.cpp).
const HEADER = [
  "magic", "version", "headerBytes", "headerCrc", "codedOffset", "codedBytes", "areaWords", "damaged", "shapeWords",
  "batches", "runs", "rows", "cols", "width", "height", "depth", "blockLog2", "levels", "chromaHalved", "blocksX",
  "blocksY",
];
const MAGIC = 0x41524c48;
const VERSION = 1;

const USE = {mapRead: 1, copySource: 4, copyTarget: 8, uniform: 64, storage: 128};
const ALL = USE.storage | USE.copySource | USE.copyTarget;
const WORKGROUP = 64;
const MOST_WORKGROUPS = 65535;
const AREA_WORDS = 12; // of Area and ColourArea
const SAMPLES_OF_LANE = 8;
const MOST_BYTES = 1 << 28; // of a buffer of one submission

/** @type {(a: number, b: number) => number} */
const ceilDiv = (a, b) => Math.ceil(a / b);

/**
 * The words of a byte array, the last one filled up with 0.
 * @param {Uint8Array} bytes
 */
function wholeWords(bytes) {
  if (bytes.byteLength % 4 === 0) return bytes;
  const padded = new Uint8Array(4 * ceilDiv(bytes.byteLength, 4));
  padded.set(bytes);
  return padded;
}

/** A stream on a device. Calls may overlap; each gets its own results. */
export class HmlfcGpu {
  /**
   * Uploads the stream and decodes its reference images (DEC-4).
   * Errors: the two files do not belong together; limit_exceeded, the device binds smaller buffers only.
   * @param {GPUDevice} device
   * @param {Uint8Array} stream the whole file
   * @param {Uint8Array} area what `hmlfc reference-area` wrote for it
   */
  static async open(device, stream, area, folder = new URL("./", import.meta.url)) {
    const words = new Uint32Array(area.slice(0, area.byteLength & ~3).buffer);
    /** @type {Header} */
    const header = Object.fromEntries(HEADER.map((name, i) => [name, words[i]]));
    if (header.magic !== MAGIC || header.version !== VERSION) {
      throw new Error("this is no file of hmlfc reference-area, or of another version of it");
    }
    const {headerBytes, codedOffset, codedBytes} = header;
    const view = new DataView(stream.buffer, stream.byteOffset, stream.byteLength);
    if (stream.byteLength < codedOffset + codedBytes || view.getUint32(headerBytes - 4, true) !== header.headerCrc) {
      throw new Error("the reference area belongs to another stream");
    }
    const decoder = new HmlfcGpu(device, header, await kernelsOf(device, folder, DECODER_KERNELS));
    try {
      decoder.#upload(stream.subarray(codedOffset, codedOffset + codedBytes), words);
    } catch (error) {
      decoder.close();
      throw error;
    }
    return decoder;
  }

  /** @param {GPUDevice} device @param {Header} header @param {Object<string, Kernel>} kernels */
  constructor(device, header, kernels) {
    this.#device = device;
    this.#kernels = kernels;
    const {rows, cols, width, height, depth, blockLog2, levels, chromaHalved, blocksX, blocksY} = header;
    /** Of the stream; `levels`: tree_height + 1. */
    this.header = {rows, cols, width, height, depth, blockSize: 1 << blockLog2, levels, chromaHalved, blocksX, blocksY};
    this.#file = header;
    this.#sampleWords = 1 << (2 * blockLog2 - 1);
    const most = Math.min(MOST_BYTES, device.limits.maxStorageBufferBindingSize, device.limits.maxBufferSize);
    this.#limit = Math.floor(most / Math.max(32 * levels, 8 * this.#sampleWords));
  }

  /** Gives back the memory of the device. */
  close() {
    for (const buffer of this.#buffers.values()) buffer.destroy();
    this.#buffers.clear();
  }

  /**
   * Decodes the blocks of all areas: errors of annex A, one a block, 0 for none; B * B samples a block, all 0 with an
   * error.
   * @param {BlockArea[]} areas
   */
  async decode(areas) {
    const blocks = areas.reduce((sum, {columns, rows}) => sum + columns * rows, 0);
    const statuses = new Uint32Array(blocks);
    const samples = new Int16Array(2 * this.#sampleWords * blocks);
    let done = 0;
    for (const group of groups(areas, this.#limit)) {
      const batch = new Batch();
      for (const {part} of group) batch.add(part);
      const [errors, words] = await this.#run(batch);
      statuses.set(new Uint32Array(errors), done);
      samples.set(new Int16Array(words), 2 * this.#sampleWords * done);
      done += batch.requests;
    }
    return {statuses, samples};
  }

  /**
   * Decodes pixels. Of each area: R, G, B and A = 2^depth - 1, row by row, of 8 bits at depth 8, else of 16; and one
   * error a block, as above, in place of whose pixels all four are 0. What is outside the view is left out.
   * @param {PixelArea[]} areas
   */
  async decodePixels(areas) {
    const {depth, chromaHalved} = this.header;
    const Texels = depth === 8 ? Uint8Array : Uint16Array;
    const pictures = new Map(areas.map(area => {
      const [width, height] = this.#inside(area);
      const statuses = new Uint32Array(area.columns * area.rows);
      return [area, {width, height, texels: new Texels(4 * width * height), statuses, done: 0, blocks: 0}];
    }));
    for (const group of groups(areas, Math.floor(this.#limit / 3))) {
      const batch = new Batch();
      for (const {part} of group) {
        const [width, height] = this.#inside(part);
        batch.addPixels(part, chromaHalved, width * height);
      }
      const [errors, words] = await this.#run(batch);
      let texel = 0;
      let block = 0;
      for (const {area, part} of group) {
        const [width, height] = this.#inside(part);
        const picture = pictures.get(area);
        if (!picture) continue;
        const own = new Texels(words, texel * 4 * Texels.BYTES_PER_ELEMENT, 4 * width * height);
        picture.texels.set(own, 4 * picture.done);
        picture.statuses.set(new Uint32Array(errors, 4 * block, part.columns * part.rows), picture.blocks);
        picture.done += width * height;
        picture.blocks += part.columns * part.rows;
        texel += width * height;
        block += part.columns * part.rows;
      }
    }
    return areas.map(area => {
      const {width, height, texels, statuses} = /** @type {any} */ (pictures.get(area));
      return {width, height, texels, statuses};
    });
  }

  /**
   * Pixels of a whole view.
   * @param {number} row
   * @param {number} col
   */
  async decodeView(row, col, stopLevel = 0) {
    const {blocksX, blocksY} = this.header;
    return (await this.decodePixels([{row, col, bx: 0, by: 0, columns: blocksX, rows: blocksY, stopLevel}]))[0];
  }

  /** @type {GPUDevice} */
  #device;
  /** @type {Object<string, Kernel>} */
  #kernels;
  /** @type {Header} */
  #file;
  #sampleWords = 0; // of a block
  #limit = 0; // requests of a submission
  /** @type {Map<string, GPUBuffer>} */
  #buffers = new Map();

  /**
   * Columns and rows of pixels of an area inside the view.
   * @param {PixelArea} area
   */
  #inside(area) {
    const {width, height, blockSize} = this.header;
    const within = (/** @type {number} */ first, /** @type {number} */ blocks, /** @type {number} */ size) =>
        Math.max(0, Math.min(blocks * blockSize, size - first * blockSize));
    return [within(area.bx, area.columns, width), within(area.by, area.rows, height)];
  }

  /**
   * The buffer of that name, with room for `bytes` bytes; what it held may be lost.
   * @param {string} name
   * @param {number} bytes
   */
  #buffer(name, bytes, usage = ALL) {
    const size = Math.max(16, 4 * ceilDiv(bytes, 4));
    const {maxStorageBufferBindingSize, maxBufferSize} = this.#device.limits;
    const most = Math.min(maxStorageBufferBindingSize, maxBufferSize);
    if (size > most) throw new Error(`limit_exceeded: ${name} takes ${size} bytes, this device binds ${most}`);
    let buffer = this.#buffers.get(name);
    if (!buffer || buffer.size < size) {
      buffer?.destroy();
      buffer = this.#device.createBuffer({label: name, size, usage});
      this.#buffers.set(name, buffer);
    }
    return buffer;
  }

  /** @param {string} name @param {ArrayLike<number>} words */
  #write(name, words, usage = ALL) {
    const data = Uint32Array.from(words);
    this.#device.queue.writeBuffer(this.#buffer(name, data.byteLength, usage), 0, data);
  }

  /** @param {Uint8Array} coded ROOT, GROUP and TILE @param {Uint32Array} words of the file of reference-area */
  #upload(coded, words) {
    const {areaWords, shapeWords, batches, runs, damaged} = this.#file;
    this.#device.queue.writeBuffer(this.#buffer("stream", coded.byteLength), 0, wholeWords(coded));
    const area = this.#buffer("references", 4 * areaWords);
    let at = HEADER.length;
    const next = (/** @type {number} */ count) => words.subarray(at, at += count);
    this.#write("shape", next(shapeWords), USE.uniform | USE.copyTarget);
    this.#write("damage", [damaged]);
    const reference = [];
    for (let i = 0; i < batches; ++i) {
      const [count, requests] = next(2);
      reference.push({areas: next(AREA_WORDS * count), requests, colourAreas: [], pixels: 0});
    }
    for (let i = 0; i < runs; ++i) {
      const [first, count] = next(2);
      this.#device.queue.writeBuffer(area, 4 * first, next(count));
    }
    for (const batch of reference) {
      this.#prepare(batch, 1);
      const encoder = this.#device.createCommandEncoder();
      this.#dispatch(encoder, "expand", batch.requests);
      this.#dispatch(encoder, "reference_walk", batch.requests);
      this.#dispatch(encoder, "residuals", batch.requests * this.#lanes());
      this.#device.queue.submit([encoder.finish()]);
    }
  }

  /** Invocations of a block (block_lanes.glsl). */
  #lanes() {
    return ceilDiv(2 * this.#sampleWords, SAMPLES_OF_LANE);
  }

  /**
   * @param {{areas: ArrayLike<number>, requests: number, colourAreas: number[], pixels: number}} batch
   * @param {number} levels entries of a request
   */
  #prepare({areas, requests, colourAreas, pixels}, levels) {
    this.#write("areas", areas);
    this.#write("colour_areas", colourAreas);
    this.#buffer("requests", 12 * requests);
    this.#buffer("entries", 32 * levels * requests);
    const counts = [areas.length / AREA_WORDS, requests, colourAreas.length / AREA_WORDS, pixels];
    this.#write("arguments", counts, USE.uniform | USE.copyTarget);
  }

  /** @param {GPUCommandEncoder} encoder @param {string} name @param {number} invocations */
  #dispatch(encoder, name, invocations) {
    const {pipeline, bindings} = this.#kernels[name];
    const entries = bindings.map(one => ({binding: one.binding, resource: {buffer: this.#buffers.get(one.name)}}));
    const workgroups = ceilDiv(invocations, WORKGROUP);
    const columns = Math.min(workgroups, MOST_WORKGROUPS);
    const pass = encoder.beginComputePass({label: name});
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, this.#device.createBindGroup({layout: pipeline.getBindGroupLayout(0), entries}));
    pass.dispatchWorkgroups(columns, ceilDiv(workgroups, columns));
    pass.end();
  }

  /**
   * One submission. The errors and samples of its requests, or of its pixels if it has any.
   * @param {Batch} batch
   * @returns {Promise<ArrayBuffer[]>}
   */
  async #run(batch) {
    const {levels, depth} = this.header;
    const {requests, pixels, texels} = batch;
    this.#prepare(batch, levels);
    /** @type {[GPUBuffer, number][]} */
    let wanted = [
      [this.#buffer("statuses", 4 * requests), 4 * requests],
      [this.#buffer("samples", 4 * this.#sampleWords * requests), 4 * this.#sampleWords * requests],
    ];
    const encoder = this.#device.createCommandEncoder();
    this.#dispatch(encoder, "expand", requests);
    this.#dispatch(encoder, "walk", requests * levels);
    this.#dispatch(encoder, "samples", requests * this.#lanes());
    if (pixels) {
      const bytes = texels * (depth === 8 ? 4 : 8);
      wanted = [[this.#buffer("pixel_statuses", 4 * pixels), 4 * pixels], [this.#buffer("pixels", bytes), bytes]];
      this.#dispatch(encoder, "colour", pixels * this.#lanes());
    }
    const size = wanted.reduce((sum, [, bytes]) => sum + bytes, 0);
    const readback = this.#device.createBuffer({size, usage: USE.mapRead | USE.copyTarget});
    let at = 0;
    for (const [buffer, bytes] of wanted) {
      encoder.copyBufferToBuffer(buffer, 0, readback, at, bytes);
      at += bytes;
    }
    this.#device.queue.submit([encoder.finish()]);
    await readback.mapAsync(1);
    const all = readback.getMappedRange();
    at = 0;
    const results = wanted.map(([, bytes]) => all.slice(at, at += bytes));
    readback.destroy();
    return results;
  }
}
