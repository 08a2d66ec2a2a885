// What tests/gpu/wgsl_frames_test.py runs in a browser: frames of the conformance suite, drawn from their streams.

import {LightField} from "/wgsl/light_field.js";
import {StreamClient} from "/wgsl/stream_client.js";

/** The raw form of the samples: R, G, B, of one byte each at depth 8, else of two, the low one first. */
async function sumOf(texels) {
  const samples = texels.filter((_, i) => i % 4 !== 3);
  const sum = await crypto.subtle.digest("SHA-256", samples.buffer);
  return Array.from(new Uint8Array(sum), byte => byte.toString(16).padStart(2, "0")).join("");
}

/** What is wrong with the frames of one stream. */
export async function wrongFrames(address, frames) {
  const field = await LightField.open(window.device, address, new URL("/wgsl/", location.href), 2);
  const found = [];
  try {
    const {rows, cols} = field.facts;
    await field.load([0, rows - 1, 0, cols - 1], 0, frames.some(frame => frame.record[37] === 1));
    for (const {id, record, stopLevel, error, sha256, needed, lookedUp} of frames) {
      const drawn = await field.renderer.draw(Uint32Array.from(record), stopLevel);
      const say = text => found.push(`${id}: ${text}`);
      if (drawn.error !== error) say(`error ${drawn.error} instead of ${error}`);
      if (drawn.blocksNeeded !== needed) say(`${drawn.blocksNeeded} blocks instead of ${needed}`);
      if (drawn.disparitiesLookedUp !== lookedUp) say(`${drawn.disparitiesLookedUp} disparities instead of ${lookedUp}`);
      if (!error && await sumOf(await field.renderer.pixels()) !== sha256) say("wrong pixels");
      if (window.deviceErrors.length) say(window.deviceErrors.shift());
    }
  } finally {
    field.close();
  }
  return found;
}

/** The record of each camera, as words. */
export async function records(address, cameras) {
  const client = await StreamClient.open(address, new URL("/wgsl/", location.href), 1);
  const answers = [];
  for (const camera of cameras) {
    answers.push(await client.record(camera).then(({record}) => Array.from(record, word => word | 0), error => error.message));
  }
  client.close();
  return answers;
}
