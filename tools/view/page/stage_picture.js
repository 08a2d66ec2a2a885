// Samples of a stage as grey pixels.

const NONE = -32768; // the block does not have this stage

/**
 * Luma from black to white; chroma and residuals around middle grey; dark blue where there is none.
 * @param {Int16Array} samples @param {number} width @param {number} height
 * @param {boolean} signed @param {number} depth
 */
export function stagePicture(samples, width, height, signed, depth) {
  const pixels = new ImageData(width, height);
  const out = new Uint32Array(pixels.data.buffer);
  for (let at = 0; at < samples.length; ++at) {
    const sample = samples[at];
    const grey = (signed ? 128 : 0) + (sample >> (depth - 8));
    const shown = Math.max(0, Math.min(255, grey));
    out[at] = sample === NONE ? 0xff2c1a16 : 0xff000000 | (shown << 16) | (shown << 8) | shown;
  }
  return pixels;
}

/**
 * The sample, or null.
 * @param {Int16Array} samples @param {number} at
 */
export const sampleAt = (samples, at) => (samples[at] === NONE ? null : samples[at]);
