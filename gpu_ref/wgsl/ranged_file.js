// A file at an address, whose bytes come when they are needed.

export const CHUNK = 1 << 12; // bytes that come at once; ChunkedFile of gpu_ref/wasm has as many
const FIRST = 8 * CHUNK; // of the first answer
const GAP = 4; // chunks between two that are fetched with them
const MOST = 2 ** 31; // bytes of a file
const MAGIC = [0x89, 0x48, 0x4d, 0x4c, 0x46, 0x43, 0x0d, 0x0a]; // FIL-1

/** @typedef {[number, number]} Range offset and bytes */

const TOO_LARGE = "limit_exceeded: the file has more than 2 GiB";

/**
 * Before room is made for as many bytes as the host says.
 * @param {Uint8Array} bytes
 */
function checkMagic(bytes) {
  if (!MAGIC.every((byte, i) => bytes[i] === byte)) throw new Error("what the host sends is no .hmlfc stream");
}

/** The bytes of the file, 0 where they have not come. */
export class RangedFile {
  /**
   * Begins to load the file. Without ranges the host sends the whole: then this waits for it.
   * @param {string} address
   */
  static async open(address) {
    const answer = await fetch(address, {headers: {Range: `bytes=0-${FIRST - 1}`}});
    if (answer.status !== 206) return RangedFile.#whole(address, answer);
    const size = Number(/^bytes 0-\d+\/(\d+)$/i.exec(answer.headers.get("Content-Range") ?? "")?.[1]);
    if (!Number.isSafeInteger(size)) return RangedFile.#whole(address, await fetch(address));
    const bytes = new Uint8Array(await answer.arrayBuffer());
    checkMagic(bytes);
    const file = new RangedFile(address, size, answer.headers.get("ETag"));
    file.#put(0, bytes);
    return file;
  }

  /** @param {string} address @param {Response} answer */
  static async #whole(address, answer) {
    if (!answer.ok) throw new Error(`${address}: the host answers with status ${answer.status}`);
    if (Number(answer.headers.get("Content-Length")) > MOST) throw new Error(TOO_LARGE);
    const bytes = new Uint8Array(await answer.arrayBuffer());
    checkMagic(bytes);
    const file = new RangedFile(address, bytes.length, null);
    file.#put(0, bytes);
    return file;
  }

  /** @param {string} address @param {number} size @param {string | null} version */
  constructor(address, size, version) {
    if (size > MOST) throw new Error(TOO_LARGE);
    this.address = address;
    this.size = size;
    this.received = 0; // bytes
    this.bytes = new Uint8Array(size);
    /**
     * Told of bytes that have come.
     * @type {(begin: number, end: number) => void}
     */
    this.came = () => {};
    this.#version = version;
    this.#chunks = new Array(Math.ceil(size / CHUNK));
  }

  /**
   * The chunks that hold `ranges`, by number.
   * @param {Range[]} ranges
   */
  chunksOf(ranges) {
    /** @type {Set<number>} */
    const chunks = new Set();
    for (const [offset, bytes] of ranges) {
      if (bytes <= 0 || offset + bytes > this.size) continue;
      for (let k = Math.floor(offset / CHUNK); k * CHUNK < offset + bytes; ++k) chunks.add(k);
    }
    return [...chunks].sort((a, b) => a - b);
  }

  /**
   * Waits until the ranges have come.
   * @param {Range[]} ranges
   */
  async load(ranges) {
    const chunks = this.chunksOf(ranges);
    const missing = chunks.filter(k => !this.#chunks[k]);
    for (let i = 0; i < missing.length;) {
      let end = i + 1;
      while (end < missing.length && missing[end] - missing[end - 1] <= GAP) ++end;
      const [first, last] = [missing[i], missing[end - 1]];
      const coming = this.#fetch(first * CHUNK, Math.min(this.size, (last + 1) * CHUNK));
      coming.catch(() => {
        for (let k = first; k <= last; ++k) if (this.#chunks[k] === coming) this.#chunks[k] = undefined;
      });
      for (let k = first; k <= last; ++k) this.#chunks[k] ??= coming;
      i = end;
    }
    await Promise.all(chunks.map(k => this.#chunks[k]));
  }

  /**
   * By number: the promise of each chunk that has come or comes.
   * @type {(Promise<void> | undefined)[]}
   */
  #chunks;
  /** @type {string | null} */
  #version;

  /** @param {number} begin @param {number} end */
  async #fetch(begin, end) {
    const answer = await fetch(this.address, {headers: {Range: `bytes=${begin}-${end - 1}`}});
    if (!answer.ok) throw new Error(`${this.address}: the host answers with status ${answer.status}`);
    if (answer.headers.get("ETag") !== this.#version) throw new Error("the file has changed: load the page again");
    const bytes = new Uint8Array(await answer.arrayBuffer());
    const whole = answer.status !== 206;
    if (bytes.length !== (whole ? this.size : end - begin)) throw new Error("the host sends other bytes than it says");
    this.#put(whole ? 0 : begin, bytes);
  }

  /** @param {number} begin @param {Uint8Array} bytes */
  #put(begin, bytes) {
    const end = Math.min(this.size, begin + bytes.length);
    this.bytes.set(bytes.subarray(0, end - begin), begin);
    for (let k = Math.ceil(begin / CHUNK); k * CHUNK < end; ++k) {
      if (Math.min((k + 1) * CHUNK, this.size) <= end) this.#chunks[k] = Promise.resolve();
    }
    this.received += bytes.length;
    this.came(begin, end);
  }
}
