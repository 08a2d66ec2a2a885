// Shows the pixels of a frame, as render.comp leaves them, on a canvas of the same size: nothing where none was drawn.
// A part of what is shown may be another frame, kept before.

const CODE = `
@group(0) @binding(0) var<storage, read> drawn: array<u32>;
@group(0) @binding(1) var<storage, read> kept: array<u32>;
@group(0) @binding(2) var<uniform> size: vec4<u32>; // width, height, depth, 2^16 times the part of the kept frame

@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
  return vec4(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn colour(first: u32, last: u32) -> vec4<f32> {
  if (size.z == 8u) { return unpack4x8unorm(first); }
  return vec4<f32>(vec4(first & 0xFFFFu, first >> 16u, last & 0xFFFFu, last >> 16u)) / f32((1u << size.z) - 1u);
}

@fragment fn texel(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
  let words = select(2u, 1u, size.z == 8u);
  let first = words * (u32(at.y) * size.x + u32(at.x));
  let last = first + words - 1u;
  let now = colour(drawn[first], drawn[last]);
  if (size.w == 0u) { return now; }
  return mix(now, colour(kept[first], kept[last]), f32(size.w) / 65536.0);
}`;

export class Picture {
  /** @param {any} device @param {number} depth */
  constructor(device, depth) {
    this.device = device;
    this.depth = depth;
    this.format = /** @type {any} */ (navigator).gpu.getPreferredCanvasFormat();
    const module = device.createShaderModule({code: CODE});
    this.pipeline = device.createRenderPipeline({
      layout: "auto", vertex: {module}, fragment: {module, targets: [{format: this.format}]}});
    this.size = device.createBuffer({size: 16, usage: 64 | 8});
    /** @type {any} */
    this.group = undefined;
    /** @type {any[]} */
    this.frames = []; // buffers in the group
  }

  /**
   * @param {any} encoder @param {import("./device_buffers.js").DeviceBuffers} buffers @param {any} target
   * @param {number} width @param {number} height @param {number} kept in [0, 1]
   */
  show(encoder, buffers, target, width, height, kept) {
    const frames = [buffers.get("drawn"), buffers.get(kept > 0 ? "kept" : "drawn")];
    if (frames.some((frame, i) => frame !== this.frames[i])) {
      const entries = [...frames, this.size].map((buffer, binding) => ({binding, resource: {buffer}}));
      this.group = this.device.createBindGroup({layout: this.pipeline.getBindGroupLayout(0), entries});
      this.frames = frames;
    }
    this.device.queue.writeBuffer(this.size, 0, Uint32Array.of(width, height, this.depth, Math.round(kept * 65536)));
    const pass = encoder.beginRenderPass({colorAttachments: [
      {view: target.getCurrentTexture().createView(), loadOp: "clear", storeOp: "store"}]});
    pass.setPipeline(this.pipeline);
    pass.setBindGroup(0, this.group);
    pass.draw(3);
    pass.end();
  }
}
