// A published light field: it is decoded and drawn here, by WebGPU, and moves until somebody touches it. Where that
// cannot be, a recording of it moves.
import { linkTo, middleCamera, placeQuery, readCamera } from "./camera.js";
import { any, canvas, say } from "./dom.js";
import { GpuFrames } from "./gpu_frames.js";
import { LiveView, mayHelp, within } from "./live_view.js";
import { control } from "./look_controls.js";

const SLOW = 3000; // milliseconds without a frame, until the page says that it loads
const SETTLED = 500; // milliseconds: browsers take few changes of the address
const TRIES = 5; // to open the stream of a host that is busy or silent
const NO_WEBGPU = isSecureContext ? "this browser has no WebGPU. In one that has, you move the camera"
  : "browsers draw light fields on https:// alone, and this address is not secure";

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

/** @param {any} device */
async function openField(device) {
  // It comes from another folder of the sources (gpu_ref/wgsl).
  const { LightField } = await import(new URL("light_field.js", import.meta.url).href);
  for (let tries = 1; ; ++tries) {
    try {
      return await LightField.open(device, document.body.dataset.stream ?? "");
    } catch (error) {
      if (tries === TRIES || !(await mayHelp(/** @type {Error} */ (error)))) throw error;
    }
  }
}

/** @param {Error} error */
function fail(error) {
  console.warn(error);
  if (lost) return;
  const limit = error instanceof RangeError || error.message.startsWith("limit_exceeded");
  const again = error.name === "NetworkError" ? ": load the page again later" : "";
  record(limit ? `this device is too small for the light field (${error.message})` : error.message + again);
}

/**
 * The camera of the link in the address, as far as the controls go; without one it stays where it is.
 * @param {LiveView} view
 */
function open(view) {
  const link = new URLSearchParams(location.hash.slice(1));
  if (!link.has("camera")) return false;
  const camera = { ...middleCamera(view.facts), ...view.camera };
  readCamera(camera, link);
  const { u, v, z, turnX, turnY, focus, aperture } = camera;
  const reach = view.reach();
  view.change({
    u: within(u, 0, view.facts.cols - 1), v: within(v, 0, view.facts.rows - 1), z: within(z, -reach, reach),
    turnX: within(turnX, -0.5, 0.5), turnY: within(turnY, -0.5, 0.5), focus: within(focus, -256, 256), aperture: within(aperture, 0, 3),
  });
  return true;
}

/**
 * The link to what is shown, which `view` takes too.
 * @param {LiveView} view
 */
function keep(view) {
  if (view.moving || view.wanted || view.glide) return;
  const camera = { ...middleCamera(view.facts), ...view.camera };
  history.replaceState(null, "", linkTo(placeQuery(camera)));
}

async function begin() {
  say("notice", "");
  any("notice").classList.remove("late");
  const device = await openDevice().catch(() => null);
  if (!device) return record(NO_WEBGPU);
  const slow = setTimeout(() => say("notice", "Loading…"), SLOW);
  try {
    const field = await openField(device);
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
    const linked = open(view);
    addEventListener("hashchange", () => open(view));
    let kept = 0;
    view.shown = () => {
      clearTimeout(kept);
      kept = setTimeout(() => keep(view), SETTLED);
    };
    await view.first;
    performance.mark("first frame", { detail: field.client.file.received });
    if (!linked) view.slideTo({ aperture: frames.start.aperture });
    void frames.ahead();
    return view;
  } finally {
    clearTimeout(slow);
  }
}

export const player = begin().catch(fail);
