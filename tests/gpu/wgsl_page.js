// What tests/gpu/wgsl_test.py runs in a browser: streams decoded by hmlfc_gpu.js and compared.

const OUTSIDE = 0x7fff; // tests/gpu/reference_areas.cpp

const CRC_TABLE = Uint32Array.from({length: 256}, (_, byte) => {
  for (let k = 0; k < 8; ++k) byte = byte & 1 ? (byte >>> 1) ^ 0x82f63b78 : byte >>> 1;
  return byte;
});

function crc32c(bytes) {
  let crc = ~0;
  for (const byte of bytes) crc = (crc >>> 8) ^ CRC_TABLE[(crc ^ byte) & 255];
  return (~crc >>> 0).toString(16).padStart(8, "0");
}

async function bytesOf(address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
  return new Uint8Array(await answer.arrayBuffer());
}

/** A line of the blocks file (vectors/README.md) of one view. */
function sumsOf({width, height, texels, statuses}, {blockSize, blocksX}) {
  return Array.from(statuses, (status, number) => {
    if (status !== 0) return "--------";
    const x = (number % blocksX) * blockSize;
    const y = Math.floor(number / blocksX) * blockSize;
    const samples = [];
    for (let row = y; row < Math.min(y + blockSize, height); ++row) {
      for (let col = x; col < Math.min(x + blockSize, width); ++col) {
        const at = 4 * (row * width + col);
        samples.push(texels[at], texels[at + 1], texels[at + 2]);
      }
    }
    return crc32c(new Uint8Array(texels.constructor.from(samples).buffer));
  }).join(" ");
}

async function sha256(text) {
  const sum = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text));
  return Array.from(new Uint8Array(sum), byte => byte.toString(16).padStart(2, "0")).join("");
}

/** All blocks of `view` at a stop level, plane by plane. */
function areasOf({chromaHalved, blockSize, width, height}, view, stopLevel) {
  return [0, 1, 2].map(plane => {
    const side = blockSize << (plane === 0 ? 0 : chromaHalved);
    return {...view, plane, bx: 0, by: 0, columns: Math.ceil(width / side), rows: Math.ceil(height / side), stopLevel};
  });
}

/** What is wrong with the blocks of tests/gpu/reference_areas.cpp. */
async function wrongBlocks(decoder, expected) {
  const {blockSize, rows, cols, levels} = decoder.header;
  const areas = Array.from({length: levels}, (_, level) => areasOf(decoder.header, {row: 0, col: 0}, level)).flat();
  areas.push(...areasOf(decoder.header, {row: rows - 1, col: cols - 1}, 0));
  const {statuses, samples} = await decoder.decode(areas);
  const count = blockSize * blockSize;
  if (expected.length !== statuses.length * (count + 1)) return `${statuses.length} blocks`;
  for (let block = 0; block < statuses.length; ++block) {
    const own = expected.subarray(block * (count + 1), (block + 1) * (count + 1));
    if (statuses[block] !== own[0]) return `block ${block}: error ${statuses[block]} instead of ${own[0]}`;
    for (let i = 0; i < count; ++i) {
      const sample = samples[block * count + i];
      if (own[1 + i] !== OUTSIDE && sample !== own[1 + i]) {
        return `block ${block}, sample ${i}: ${sample} instead of ${own[1 + i]}`;
      }
    }
  }
  return "";
}

async function check(HmlfcGpu, device, kernels, {number, file, sha256: sum, blocks, error}) {
  const [stream, area, words] = await Promise.all(
      [bytesOf(`/suite/${file}`), bytesOf(`/areas/${number}.area`), bytesOf(`/areas/${number}.blocks`)]);
  const decoder = await HmlfcGpu.open(device, stream, area, new URL(kernels, location.href));
  try {
    const {rows, cols, blocksX, blocksY} = decoder.header;
    const whole = {bx: 0, by: 0, columns: blocksX, rows: blocksY};
    const views = Array.from({length: rows * cols}, (_, i) => ({row: Math.floor(i / cols), col: i % cols, ...whole}));
    const pictures = await decoder.decodePixels(views);
    const lines = views.map(({row, col}, i) => `${row} ${col}\n${sumsOf(pictures[i], decoder.header)}\n`);
    if (await sha256(lines.join("")) !== sum) return "wrong pixels";
    const failing = blocks.map(({view_row: row, view_col: col, plane, block_x: bx, block_y: by}) => (
      {row, col, plane: ["Y", "Co", "Cg"].indexOf(plane), bx, by, columns: 1, rows: 1}));
    const {statuses} = await decoder.decode(failing);
    const other = statuses.find(status => status !== error);
    if (other !== undefined) return `error ${other} instead of ${error}`;
    return await wrongBlocks(decoder, new Int16Array(words.buffer));
  } finally {
    decoder.close();
  }
}

/** The device of this browser, or why there is none. */
export async function openDevice() {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) return "this browser has no WebGPU";
  window.device = await adapter.requestDevice();
  window.deviceErrors = [];
  window.device.addEventListener("uncapturederror", event => window.deviceErrors.push(event.error.message));
  return "";
}

/** What the compiler says about kernels. */
export async function messages(folder, names) {
  const found = [];
  for (const name of names) {
    const module = window.device.createShaderModule({code: await (await fetch(`${folder}${name}.wgsl`)).text()});
    const {messages: all} = await module.getCompilationInfo();
    found.push(...all.map(one => `${name}.wgsl:${one.lineNum}: ${one.type}: ${one.message}`));
  }
  return found;
}

/** What is wrong, vector by vector, until `most` are; kernels come from folder `kernels`. */
export async function checkAll(kernels, vectors, most) {
  const {HmlfcGpu} = await import("/wgsl/hmlfc_gpu.js");
  const found = [];
  for (const vector of vectors) {
    const wrong = await check(HmlfcGpu, window.device, kernels, vector).catch(error => String(error));
    if (wrong) found.push(`${vector.id}: ${wrong}`);
    if (window.deviceErrors.length) found.push(`${vector.id}: ${window.deviceErrors.shift()}`);
    if (found.length >= most) break;
  }
  return found;
}

/** How opening with wrong files or a small device ends. */
export async function refusals(number, file, otherNumber) {
  const {HmlfcGpu} = await import("/wgsl/hmlfc_gpu.js");
  const [stream, area, other] = await Promise.all(
      [bytesOf(`/suite/${file}`), bytesOf(`/areas/${number}.area`), bytesOf(`/areas/${otherNumber}.area`)]);
  const small = new Proxy(window.device, {
    get(target, name) {
      if (name === "limits") return {maxStorageBufferBindingSize: 64, maxBufferSize: 1 << 20};
      const value = target[name];
      return typeof value === "function" ? value.bind(target) : value;
    },
  });
  const kernels = new URL("/wgsl/", location.href);
  const ends = (device, streamBytes, areaBytes) => HmlfcGpu.open(device, streamBytes, areaBytes, kernels).then(
      () => "opened", error => error.message);
  return [
    await ends(window.device, stream, other), await ends(window.device, stream, stream),
    await ends(window.device, stream.subarray(0, stream.length - 1), area), await ends(small, stream, area),
  ];
}

/** The functions of two words `pairs` on all pairs of `operands`: product, sum, difference, signed product; two words each. */
export async function pairResults(pairs, operands) {
  const {device} = window;
  const n = operands.length;
  const code = `struct Pair { m0: u32, m1: u32 }
struct IntPair { m0: i32, m1: i32 }
${pairs}
@group(0) @binding(0) var<storage, read> operands: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;
@compute @workgroup_size(1)
fn main(@builtin(workgroup_id) at: vec3<u32>) {
  let a = operands[at.x];
  let b = operands[at.y];
  let last = signed_product(i32(a), i32(b));
  let all = array<Pair, 4>(product(a, b), sum(a, b), difference(a, b), Pair(u32(last.m0), u32(last.m1)));
  for (var i = 0u; i < 4u; i++) {
    results[8u * (at.x * ${n}u + at.y) + 2u * i] = all[i].m0;
    results[8u * (at.x * ${n}u + at.y) + 2u * i + 1u] = all[i].m1;
  }
}`;
  const pipeline = device.createComputePipeline(
      {layout: "auto", compute: {module: device.createShaderModule({code}), entryPoint: "main"}});
  const [input, output, readback] = [[4 * n, 128 | 8], [32 * n * n, 128 | 4], [32 * n * n, 1 | 8]].map(
      ([size, usage]) => device.createBuffer({size, usage}));
  device.queue.writeBuffer(input, 0, Uint32Array.from(operands));
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  const entries = [input, output].map((buffer, binding) => ({binding, resource: {buffer}}));
  pass.setBindGroup(0, device.createBindGroup({layout: pipeline.getBindGroupLayout(0), entries}));
  pass.dispatchWorkgroups(n, n);
  pass.end();
  encoder.copyBufferToBuffer(output, 0, readback, 0, 32 * n * n);
  device.queue.submit([encoder.finish()]);
  await readback.mapAsync(1);
  return Array.from(new Uint32Array(readback.getMappedRange()));
}
