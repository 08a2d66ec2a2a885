// The kernels of hmlfc_gpu.js and frame_renderer.js, compiled.

import {ask} from "./ranged_file.js";

/** @typedef {any} GPUDevice */

/**
 * `bindings`: the buffers that the kernel uses, by their names in it.
 * @typedef {{pipeline: any, bindings: {binding: number, name: string}[]}} Kernel
 */

export const DECODER_KERNELS = ["expand", "walk", "reference_walk", "residuals", "samples", "colour"];
// Those of frames: of reference images, of all frames, of frames with geometry and without.
export const REFERENCE_KERNELS = ["expand", "reference_walk", "residuals"];
export const FRAME_KERNELS = ["plan", "compact", "frame_walk", "frame_samples"];
export const GEOMETRY_KERNELS = ["surface", "mark_geometry", "render_geometry"];
export const PLANE_KERNELS = ["mark", "render"];

/**
 * Begins to compile those of frames; what fails is told where they are used.
 * @param {GPUDevice} device @param {URL} folder
 */
export function compileFrames(device, folder) {
  for (const names of [FRAME_KERNELS, GEOMETRY_KERNELS, PLANE_KERNELS, REFERENCE_KERNELS]) {
    kernelsOf(device, folder, names).catch(() => {});
  }
}

/**
 * By device and address.
 * @type {WeakMap<GPUDevice, Map<string, Promise<Kernel>>>}
 */
const compiled = new WeakMap();

/**
 * The kernels `names` of `folder`, each compiled once for a device.
 * @param {GPUDevice} device
 * @param {URL} folder
 * @param {string[]} names
 * @returns {Promise<Object<string, Kernel>>}
 */
export async function kernelsOf(device, folder, names) {
  const kernels = compiled.get(device) ?? new Map();
  compiled.set(device, kernels);
  return Object.fromEntries(await Promise.all(names.map(async name => {
    const {href} = new URL(`${name}.wgsl`, folder);
    if (!kernels.has(href)) {
      kernels.set(href, compile(device, name, href));
      kernels.get(href).catch(() => kernels.delete(href));
    }
    return [name, await kernels.get(href)];
  })));
}

/**
 * @param {GPUDevice} device @param {string} name @param {string} address
 * @returns {Promise<Kernel>}
 */
async function compile(device, name, address) {
  const code = await (await ask(address)).text();
  const module = device.createShaderModule({code, label: name});
  const pipeline = await device.createComputePipelineAsync(
      {label: name, layout: "auto", compute: {module, entryPoint: "main"}});
  const bindings = [...code.matchAll(/@binding\((\d+)\) var<[^>]*> (\w+)/g)].map(
      ([, binding, buffer]) => ({binding: Number(binding), name: buffer}));
  return {pipeline, bindings};
}
