// A light field at an address, drawn on a device: loads of the stream what frames need, and draws them.

import {FrameRenderer} from "./frame_renderer.js";
import {compileFrames} from "./kernels.js";
import {StreamClient} from "./stream_client.js";

/** @typedef {import("./stream_client.js").TreeImage} TreeImage */

const nameOf = (/** @type {TreeImage} */ {level, row, col}) => `${level},${row},${col}`;

export class LightField {
  /**
   * @param {any} device GPUDevice @param {string} address of the stream
   * @param {URL} folder of the kernels and the module
   */
  static async open(device, address, folder = new URL("./", import.meta.url), threads = undefined) {
    const opening = StreamClient.open(address, folder, threads);
    compileFrames(device, folder); // after the stream's first bytes were asked for: hosts answer few requests at once
    const client = await opening;
    try {
      return new LightField(client, new FrameRenderer(device, folder, client.facts, client.shape));
    } catch (error) {
      client.close();
      throw error;
    }
  }

  /** @param {StreamClient} client @param {FrameRenderer} renderer */
  constructor(client, renderer) {
    this.client = client;
    this.renderer = renderer;
    this.facts = client.facts;
    const {file} = client;
    file.came = (begin, end) => renderer.writeStream(file.bytes, begin, end);
    file.came(0, file.size);
  }

  close() {
    this.client.close();
    this.renderer.close();
  }

  /**
   * Loads all that frames of views need, first and last row, first and last column.
   * @param {number[]} views @param {number} stopLevel @param {boolean} geometry
   */
  load(views, stopLevel, geometry) {
    return this.#once(`${views} ${stopLevel} ${geometry}`, async () => {
      const {client, renderer} = this;
      const needs = await client.needs(views, stopLevel);
      /** @type {Promise<any>[]} */
      const parts = [client.file.load(needs.ranges)];
      for (const key of needs.keys) {
        for (const plane of [0, 1, 2]) {
          parts.push(this.#once(`key ${nameOf(key)} ${plane}`, async () =>
              renderer.writeKeyPlane(await client.keyPlane(key, plane))));
        }
      }
      await Promise.all(parts);
      const missing = needs.references.filter(image => !this.#done.has(nameOf(image)));
      for (const image of missing) this.#done.add(nameOf(image));
      this.#decoded = this.#decoded.then(() => renderer.decodeReferences(missing));
      await this.#decoded;
      if (!geometry) return;
      const [row0, row1, col0, col1] = views;
      const maps = [];
      for (let row = row0; row <= row1; ++row) {
        for (let col = col0; col <= col1; ++col) {
          maps.push(this.#once(`map ${row},${col}`, async () =>
              renderer.writeDisparities(row, col, await client.disparities(row, col))));
        }
      }
      await Promise.all(maps);
    });
  }

  /**
   * Draws the frame of `camera` once what it needs has come, into `target`, a canvas of its size. An aperture between
   * two whole ones shows a part of the frame of each.
   * @param {import("./stream_client.js").FrameCamera} camera @param {number} stopLevel @param {any} target
   */
  async draw(camera, stopLevel, target) {
    const less = Math.floor(camera.aperture);
    const part = camera.aperture - less;
    if (part === 0) return this.#drawWhole(camera, stopLevel, target, 0);
    await this.#drawWhole({...camera, aperture: less}, stopLevel, undefined, 0);
    this.renderer.keep();
    return this.#drawWhole({...camera, aperture: less + 1}, stopLevel, target, 1 - part);
  }

  /** @param {import("./stream_client.js").FrameCamera} camera @param {number} stopLevel @param {any} target @param {number} kept */
  async #drawWhole(camera, stopLevel, target, kept) {
    const {record, views} = await this.client.record(camera);
    await this.load(views, stopLevel, record[37] === 1 && stopLevel === 0);
    const begin = performance.now();
    const drawn = await this.renderer.draw(record, stopLevel, target, kept);
    return {views, took: performance.now() - begin, ...drawn};
  }

  /** @type {Map<string, Promise<void>>} */
  #under = new Map();
  /**
   * Reference images in the reference area.
   * @type {Set<string>}
   */
  #done = new Set();
  /**
   * Whether those have been decoded: the next ones wait for it.
   * @type {Promise<void>}
   */
  #decoded = Promise.resolve();

  /**
   * The promise of what is made once; after a failure the next call tries again.
   * @param {string} name @param {() => Promise<void>} make
   */
  #once(name, make) {
    const begun = this.#under.get(name);
    if (begun) return begun;
    const made = make();
    this.#under.set(name, made);
    made.catch(() => this.#under.delete(name));
    return made;
  }
}
