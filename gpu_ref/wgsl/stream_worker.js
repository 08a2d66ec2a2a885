// Runs the module in WebAssembly (gpu_ref/wasm) on one stream, for stream_client.js.

/** @type {any} */
let module;
const EBADF = 8;

let room = 0; // where the file is in the module's memory

/**
 * What the module imports of WASI: it has no files, and ends where it cannot go on.
 * @param {WebAssembly.Module} code
 */
function imports(code) {
  /** @type {Record<string, Record<string, Function>>} */
  const all = {};
  const ends = () => {
    throw new Error("the light field takes more memory than there is");
  };
  for (const {module: from, name} of WebAssembly.Module.imports(code)) {
    (all[from] ??= {})[name] = name === "proc_exit" ? ends : () => (name.startsWith("environ") ? 0 : EBADF);
  }
  return /** @type {any} */ (all);
}

/** @param {any} job */
async function answer({code, size, chunks, camera, call, numbers}) {
  if (code) {
    module = (await WebAssembly.instantiate(/** @type {WebAssembly.Module} */ (code), imports(code))).exports;
    module._initialize();
    room = module.reserve(size) >>> 0;
    if (room === 0) throw new Error("limit_exceeded: there is no memory for its file");
  }
  for (const [offset, bytes] of chunks) {
    new Uint8Array(module.memory.buffer, room + offset, bytes.length).set(bytes);
    module.set_loaded(offset);
  }
  if (camera) new Float64Array(module.memory.buffer, module.camera_inputs() >>> 0, camera.length).set(camera);
  const status = module[call](...numbers);
  const words = new Uint32Array(module.memory.buffer, module.answer() >>> 0, module.answer_words()).slice();
  return {status, words};
}

onmessage = async ({data}) => {
  try {
    const {status, words} = await answer(data);
    postMessage({status, words}, {transfer: [words.buffer]});
  } catch (error) {
    postMessage({failure: error instanceof WebAssembly.RuntimeError ? `the decoder has ended: ${error.message}` :
        /** @type {Error} */ (error).message});
  }
};
