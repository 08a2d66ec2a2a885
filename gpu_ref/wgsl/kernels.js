// The kernels of hmlfc_gpu.js, compiled.

/** @typedef {any} GPUDevice */

/**
 * `bindings`: the buffers that the kernel uses, by their names in it.
 * @typedef {{pipeline: any, bindings: {binding: number, name: string}[]}} Kernel
 */

const KERNELS = ["expand", "walk", "reference_walk", "residuals", "samples", "colour"];

/**
 * By device and folder.
 * @type {WeakMap<GPUDevice, Map<string, Promise<Object<string, Kernel>>>>}
 */
const compiled = new WeakMap();

/**
 * The kernels of `folder`, compiled once for a device.
 * @param {GPUDevice} device
 * @param {URL} folder
 */
export function kernelsOf(device, folder) {
  const folders = compiled.get(device) ?? new Map();
  compiled.set(device, folders);
  if (!folders.has(folder.href)) {
    folders.set(folder.href, compile(device, folder));
    folders.get(folder.href).catch(() => folders.delete(folder.href));
  }
  return folders.get(folder.href);
}

/**
 * @param {GPUDevice} device
 * @param {URL} folder
 */
async function compile(device, folder) {
  /** @type {Object<string, Kernel>} */
  const kernels = {};
  await Promise.all(KERNELS.map(async name => {
    const answer = await fetch(new URL(`${name}.wgsl`, folder));
    if (!answer.ok) throw new Error(`${answer.url}: ${answer.status} ${answer.statusText}`);
    const code = await answer.text();
    const module = device.createShaderModule({code, label: name});
    const pipeline = await device.createComputePipelineAsync(
        {label: name, layout: "auto", compute: {module, entryPoint: "main"}});
    const bindings = [...code.matchAll(/@binding\((\d+)\) var<[^>]*> (\w+)/g)].map(
        ([, binding, buffer]) => ({binding: Number(binding), name: buffer}));
    kernels[name] = {pipeline, bindings};
  }));
  return kernels;
}
