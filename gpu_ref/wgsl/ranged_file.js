// A file at an address, whose bytes come when they are needed.

export const CHUNK = 1 << 12; // bytes that come at once; ChunkedFile of gpu_ref/wasm has as many
const FIRST = 8 * CHUNK; // of the first answer
const GAP = 4; // chunks between two that are fetched with them
const MOST = 2 ** 31; // bytes of a file
const MAGIC = [0x89, 0x48, 0x4d, 0x4c, 0x46, 0x43, 0x0d, 0x0a]; // FIL-1

/** @typedef {[number, number]} Range offset and bytes */

const TOO_LARGE = "the file of this light field has more than 2 GiB";
const OTHER_BYTES = "the host sends other bytes than it says";
const CHANGED = "the file has changed: load the page again";

/**
 * Another try may help.
 * @param {string} what the host does @returns {never}
 */
function silent(what) {
  throw Object.assign(new Error(`the host ${what}`), {name: "NetworkError"});
}

/**
 * What the host answers.
 * @param {string} address @param {Record<string, string>} [headers]
 */
export async function ask(address, headers) {
  const answer = await fetch(address, {headers}).catch(() => silent("does not answer"));
  if (answer.status === 429 || answer.status >= 500) silent(`is busy (HTTP ${answer.status})`);
  const name = address.split("/").pop();
  if (answer.status === 416) throw new Error(`${name} is empty on the host, or shorter than it was`);
  if (!answer.ok) throw new Error(`the host does not give ${name} (HTTP ${answer.status})`);
  return answer;
}

/**
 * The bytes of an answer, `most` of them at most.
 * @param {Response} answer @param {number} most @param {string} tooMany
 */
async function bytesOf(answer, most, tooMany) {
  /** @type {Uint8Array[]} */
  const parts = [];
  let size = 0;
  const reader = /** @type {ReadableStream<Uint8Array>} */ (answer.body).getReader();
  for (;;) {
    const {done, value} = await reader.read().catch(() => silent("does not answer"));
    if (done) break;
    size += value.length;
    if (size > most) {
      void reader.cancel();
      throw new Error(tooMany);
    }
    parts.push(value);
  }
  const bytes = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/**
 * What a host says of the version of its file.
 * @param {Response} answer
 */
const versionOf = ({headers}) => headers.get("ETag") ?? headers.get("Last-Modified");

/**
 * First byte, last byte and size of the file in an answer with a part of it: NaN where it does not say.
 * @param {Response} answer
 */
const partOf = answer =>
    (/^bytes (\d+)-(\d+)\/(\d+)$/i.exec(answer.headers.get("Content-Range") ?? "") ?? [0, NaN, NaN, NaN]).slice(1).map(Number);

/**
 * Before room is made for as many bytes as the host says.
 * @param {Uint8Array} bytes
 */
function checkMagic(bytes) {
  if (!MAGIC.every((byte, i) => bytes[i] === byte)) throw new Error("what the host sends is no light field (.hmlfc)");
}

/** The bytes of the file, 0 where they have not come. */
export class RangedFile {
  /**
   * Begins to load the file. Without ranges the host sends the whole: then this waits for it.
   * @param {string} address
   */
  static async open(address) {
    const answer = await ask(address, {Range: `bytes=0-${FIRST - 1}`});
    if (answer.status !== 206) return RangedFile.#whole(address, answer);
    const [begin, , size] = partOf(answer);
    if (begin !== 0 || !Number.isSafeInteger(size)) return RangedFile.#whole(address, await ask(address));
    const bytes = await bytesOf(answer, FIRST, OTHER_BYTES);
    checkMagic(bytes);
    const file = new RangedFile(address, size, versionOf(answer));
    file.#put(0, bytes);
    return file;
  }

  /** @param {string} address @param {Response} answer */
  static async #whole(address, answer) {
    if (Number(answer.headers.get("Content-Length")) > MOST) throw new Error(TOO_LARGE);
    const bytes = await bytesOf(answer, MOST, TOO_LARGE);
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
    const answer = await ask(this.address, {Range: `bytes=${begin}-${end - 1}`});
    if (versionOf(answer) !== this.#version) throw new Error(CHANGED);
    const whole = answer.status !== 206;
    const [first, , size] = whole ? [begin, 0, this.size] : partOf(answer);
    if (size !== this.size) throw new Error(CHANGED);
    const most = whole ? size : end - begin;
    const bytes = await bytesOf(answer, most, whole ? CHANGED : OTHER_BYTES);
    if (first !== begin || bytes.length !== most) throw new Error(OTHER_BYTES);
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
