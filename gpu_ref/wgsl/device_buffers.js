// The buffers of a renderer by the names that kernels have for them, and dispatches of kernels on them.

/** @typedef {any} GPUDevice */
/** @typedef {any} GPUBuffer */
/** @typedef {any} GPUComputePassEncoder */

export const MAP_READ = 1, COPY_TARGET = 8, UNIFORM = 64, INDIRECT = 256;
const COPY_SOURCE = 4, STORAGE = 128;
const WORKGROUP = 64;
const MOST_WORKGROUPS = 65535;
const MOST_BYTES = 2 ** 31; // of all buffers

/**
 * Workgroups, columns and rows, of a kernel with so many invocations.
 * @param {number} invocations
 */
export function workgroupsOf(invocations) {
  const workgroups = Math.max(1, Math.ceil(invocations / WORKGROUP));
  const columns = Math.min(workgroups, MOST_WORKGROUPS);
  return [columns, Math.ceil(workgroups / columns)];
}

export class DeviceBuffers {
  /** @param {GPUDevice} device @param {Object<string, import("./kernels.js").Kernel>} kernels */
  constructor(device, kernels) {
    this.device = device;
    this.kernels = kernels;
  }

  close() {
    for (const buffer of this.#buffers.values()) buffer.destroy();
    this.#buffers.clear();
  }

  /** @param {string} name */
  has(name) {
    return this.#buffers.has(name);
  }

  /** @param {string} name @returns {GPUBuffer} */
  get(name) {
    return this.#buffers.get(name);
  }

  /**
   * The buffer of that name, with room for `bytes` bytes: a new one of zeros where there was less room.
   * @param {string} name @param {number} bytes
   */
  make(name, bytes, usage = 0) {
    const size = Math.max(16, 4 * Math.ceil(bytes / 4));
    let buffer = this.#buffers.get(name);
    if (buffer && buffer.size >= size) return buffer;
    const {maxStorageBufferBindingSize, maxBufferSize} = this.device.limits;
    const most = Math.min(maxStorageBufferBindingSize, maxBufferSize);
    if (size > most) throw new Error(`limit_exceeded: ${name} takes ${size} bytes, this device binds ${most}`);
    this.#bytes += size - (buffer?.size ?? 0);
    if (this.#bytes > MOST_BYTES) throw new Error("limit_exceeded: the buffers take more than 2 GiB");
    buffer?.destroy();
    const own = usage & UNIFORM ? usage : usage | STORAGE | COPY_SOURCE | COPY_TARGET;
    buffer = this.device.createBuffer({label: name, size, usage: own});
    this.#buffers.set(name, buffer);
    this.#groups.clear();
    return buffer;
  }

  /** @param {string} name @param {ArrayLike<number>} words */
  write(name, words, usage = 0) {
    const data = Uint32Array.from(words);
    this.device.queue.writeBuffer(this.make(name, data.byteLength, usage), 0, data);
  }

  /** @param {GPUComputePassEncoder} pass @param {string} kernel @param {number[]} workgroups */
  dispatch(pass, kernel, [columns, rows]) {
    this.#set(pass, kernel);
    pass.dispatchWorkgroups(columns, rows);
  }

  /**
   * With the workgroups that `dispatches` has.
   * @param {GPUComputePassEncoder} pass @param {string} kernel @param {number} at
   */
  dispatchCounted(pass, kernel, at) {
    this.#set(pass, kernel);
    pass.dispatchWorkgroupsIndirect(this.get("dispatches"), at);
  }

  /** @type {Map<string, GPUBuffer>} */
  #buffers = new Map();
  #bytes = 0;
  /**
   * Bindings by kernel, until a buffer is made anew.
   * @type {Map<string, any>}
   */
  #groups = new Map();

  /** @param {GPUComputePassEncoder} pass @param {string} kernel */
  #set(pass, kernel) {
    const {pipeline, bindings} = this.kernels[kernel];
    let group = this.#groups.get(kernel);
    if (!group) {
      const entries = bindings.map(one => ({binding: one.binding, resource: {buffer: this.get(one.name)}}));
      group = this.device.createBindGroup({layout: pipeline.getBindGroupLayout(0), entries});
      this.#groups.set(kernel, group);
    }
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
  }
}
