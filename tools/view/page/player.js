// A published light field: it is decoded and drawn here, by WebGPU, and moves until somebody touches it. Where that
// cannot be, a recording of it moves.
import { any, canvas, say } from "./dom.js";
import { GpuFrames } from "./gpu_frames.js";
import { LiveView } from "./live_view.js";
import { control } from "./look_controls.js";

const SLOW = 3000; // milliseconds without a frame, until the page says that it loads
const NO_WEBGPU = "this browser has no WebGPU. In one that has, you move the camera";

let lost = false; // the device

/** A device that binds as large buffers as it can, or why there is none. */
async function openDevice() {
  const adapter = await /** @type {any} */ (navigator).gpu?.requestAdapter({ powerPreference: "high-performance" });
  if (!adapter) return null;
  const { maxStorageBufferBindingSize, maxBufferSize } = adapter.limits;
  return adapter.requestDevice({ requiredLimits: { maxStorageBufferBindingSize, maxBufferSize } });
}

/**
 * The recording, and why.
 * @param {string} why
 */
function record(why) {
  const reduced = matchMedia("(prefers-reduced-motion: reduce)").matches;
  /** @type {HTMLImageElement} */ (any("still")).src = reduced ? "still.png" : "loop.png";
  canvas("frame").hidden = true;
  any("controls").hidden = true;
  any("fold").hidden = true;
  any("progress").hidden = true;
  document.body.classList.remove("live");
  document.body.classList.add("recorded");
  say("notice", `This is a recording: ${why}.`);
}

/** @param {Error} error */
function fail(error) {
  console.warn(error);
  if (lost) return;
  const limit = error instanceof RangeError || error.message.startsWith("limit_exceeded");
  record(limit ? `this device is too small for the light field (${error.message})` : error.message);
}

async function begin() {
  say("notice", "");
  any("notice").classList.remove("late");
  const device = await openDevice().catch(() => null);
  if (!device) return record(NO_WEBGPU);
  const slow = setTimeout(() => say("notice", "Loading…"), SLOW);
  try {
    // It comes from another folder of the sources (gpu_ref/wgsl).
    const { LightField } = await import(new URL("light_field.js", import.meta.url).href);
    const field = await LightField.open(device, document.body.dataset.stream ?? "");
    const frames = new GpuFrames(device, field);
    const view = new LiveView(frames);
    view.camera.aperture = 0; // the first frame is sharp: it needs the fewest bytes
    const stop = (/** @type {Error} */ error) => {
      view.end();
      fail(error);
    };
    device.lost.then((/** @type {any} */ { message }) => {
      stop(new Error(`the graphics device was lost (${message || "no reason given"}). Load the page again`));
      lost = true;
    });
    device.addEventListener("uncapturederror", (/** @type {any} */ { error }) => stop(error));
    view.failed = stop;
    control(view);
    await view.first;
    performance.mark("first frame", { detail: field.client.file.received });
    view.slideTo({ aperture: frames.start.aperture });
    void frames.ahead();
    return view;
  } finally {
    clearTimeout(slow);
  }
}

export const player = begin().catch(fail);
