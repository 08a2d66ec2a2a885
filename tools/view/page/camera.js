// The camera of the page: the same words and numbers as the options of `hmlfc render`.

/** @typedef {Required<import("./live_view.js").Camera>} Camera */
/** @typedef {import("./ask.js").Query} Query */

const AHEAD = 16; // columns from the camera to the point that it looks at

/** @param {number} x */
const rounded = (x) => Number(x.toFixed(4)) + 0;

/** @param {any} stream what the server says of the stream @returns {Camera} */
export function middleCamera(stream) {
  return {
    u: (stream.cols - 1) / 2, v: (stream.rows - 1) / 2, z: 0, turnX: 0, turnY: 0, focus: 0, aperture: 0,
    geometry: stream.geometry, filter: "quadrilinear", levels: 0, fov: null,
  };
}

/**
 * The frame of `camera`, `width` x `height` pixels, at the nearest whole aperture.
 * @param {Camera} camera @param {number} width @param {number} height @returns {Query}
 */
export function cameraQuery(camera, width, height) {
  const aperture = Math.round(camera.aperture);
  const geometry = aperture > 0 ? "plane" : camera.geometry;
  return { ...placeQuery({ ...camera, aperture, geometry }), size: `${width}x${height}` };
}

/**
 * What a link has to say.
 * @param {Camera} camera @returns {Query}
 */
export function placeQuery(camera) {
  const [u, v, z] = [camera.u, camera.v, camera.z].map(rounded);
  /** @type {Query} */
  const query = { camera: `${u},${v},${z}` };
  if (camera.turnX !== 0 || camera.turnY !== 0) {
    const at = [u + AHEAD * camera.turnX, v + AHEAD * camera.turnY, z + AHEAD].map(rounded);
    query["look-at"] = at.join(",");
  }
  query.focus = rounded(camera.focus);
  query.aperture = rounded(camera.aperture);
  query.geometry = camera.geometry;
  query.filter = camera.filter;
  if (camera.levels > 0) query.levels = camera.levels;
  if (camera.fov !== null) query.fov = rounded(camera.fov);
  return query;
}

/**
 * The link in the page's own address to what is shown.
 * @param {Query} query
 */
export const linkTo = (query) => `#${Object.entries(query).map(([name, value]) => `${name}=${value}`).join("&")}`;

/**
 * Sets what `query` says; what it leaves out stays.
 * @param {Camera} camera @param {URLSearchParams} query
 */
export function readCamera(camera, query) {
  const numbers = (/** @type {string} */ name) => (query.get(name) ?? "").split(",").map(Number);
  const [u, v, z = 0] = numbers("camera");
  if (query.has("camera") && [u, v, z].every(Number.isFinite)) Object.assign(camera, { u, v, z });
  const [atU, atV, atZ = 0] = numbers("look-at");
  const ahead = atZ - camera.z;
  camera.turnX = camera.turnY = 0;
  if (query.has("look-at") && [atU, atV, atZ].every(Number.isFinite) && ahead > 0) {
    camera.turnX = (atU - camera.u) / ahead;
    camera.turnY = (atV - camera.v) / ahead;
  }
  for (const name of /** @type {const} */ (["focus", "aperture", "levels", "fov"])) {
    const value = Number(query.get(name));
    if (query.has(name) && Number.isFinite(value)) camera[name] = value;
  }
  for (const name of /** @type {const} */ (["geometry", "filter"])) {
    camera[name] = query.get(name) ?? camera[name];
  }
}

/**
 * The command that gives the same frame.
 * @param {string} file @param {Query} query
 */
export function renderCommand(file, query) {
  const options = Object.entries(query).map(([name, value]) => `--${name} ${value}`);
  return `hmlfc render ${file} ${options.join(" ")} -o frame.png`;
}
