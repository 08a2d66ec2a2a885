// Shows the pixels of a frame, as render.comp leaves them, on a canvas of the same size: nothing where none was drawn.

const CODE = `
@group(0) @binding(0) var<storage, read> drawn: array<u32>;
@group(0) @binding(1) var<uniform> size: vec4<u32>; // width, height, depth

@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
  return vec4(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment fn texel(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
  let k = u32(at.y) * size.x + u32(at.x);
  if (size.z == 8u) { return unpack4x8unorm(drawn[k]); }
  let words = vec2(drawn[2u * k], drawn[2u * k + 1u]);
  return vec4<f32>(vec4(words.x & 0xFFFFu, words.x >> 16u, words.y & 0xFFFFu, words.y >> 16u)) / f32((1u << size.z) - 1u);
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
    /** @type {any} */
    this.drawn = undefined;
  }

  /**
   * @param {any} encoder @param {import("./device_buffers.js").DeviceBuffers} buffers @param {any} target
   * @param {number} width @param {number} height
   */
  show(encoder, buffers, target, width, height) {
    const drawn = buffers.get("drawn");
    if (this.drawn !== drawn) {
      const entries = [drawn, this.size].map((buffer, binding) => ({binding, resource: {buffer}}));
      this.group = this.device.createBindGroup({layout: this.pipeline.getBindGroupLayout(0), entries});
      this.drawn = drawn;
    }
    this.device.queue.writeBuffer(this.size, 0, Uint32Array.of(width, height, this.depth, 0));
    const pass = encoder.beginRenderPass({colorAttachments: [
      {view: target.getCurrentTexture().createView(), loadOp: "clear", storeOp: "store"}]});
    pass.setPipeline(this.pipeline);
    pass.setBindGroup(0, this.group);
    pass.draw(3);
    pass.end();
  }
}
