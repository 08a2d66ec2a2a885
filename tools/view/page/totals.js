// What the stream's bytes and blocks are.
import { askJson } from "./ask.js";
import { any, context, grouped, make } from "./dom.js";
import { heat } from "./overlays.js";

const WIDEST = 208; // pixels of a rate map

/** @param {[string, string][]} rows */
function list(rows) {
  const made = make("dl", { class: "numbers" });
  for (const [name, text] of rows) made.append(make("dt", {}, name), make("dd", {}, text));
  return made;
}

/**
 * Bars as long as their numbers.
 * @param {string} title @param {[string, number][]} rows
 */
function histogram(title, rows) {
  const most = Math.max(1, ...rows.map(([, count]) => count));
  const lines = rows.map(([name, count]) => {
    const bar = make("span", { class: "bar" });
    bar.style.width = `${(100 * count) / most}%`;
    return make("tr", {}, make("th", { scope: "row" }, name), make("td", {}, bar), make("td", {}, grouped(count)));
  });
  return make("table", { class: "histogram" }, make("caption", {}, title), make("tbody", {}, ...lines));
}

/**
 * The images of a level, brighter the more bytes they have.
 * @param {any} level
 */
function rateMap({ level, rows, cols, images }) {
  const [least, most] = [Math.min(...images), Math.max(...images)];
  const said = `Level ${level}: ${grouped(least)} to ${grouped(most)} bytes an image`;
  const step = Math.max(1, Math.min(16, Math.floor(WIDEST / cols)));
  const target = /** @type {HTMLCanvasElement} */ (make("canvas", { class: "rates", role: "img", "aria-label": said }));
  Object.assign(target, { width: cols * step, height: rows * step });
  const draw = context(target);
  images.forEach((/** @type {number} */ bytes, /** @type {number} */ at) => {
    draw.fillStyle = heat((bytes - least) / Math.max(1, most - least));
    draw.fillRect((at % cols) * step, Math.floor(at / cols) * step, step, step);
  });
  target.addEventListener("pointermove", (event) => {
    const [row, col] = [event.offsetY, event.offsetX].map((at) => Math.floor(at / step));
    const bytes = images[row * cols + col];
    if (bytes !== undefined) target.title = `image ${row},${col}: ${grouped(bytes)} bytes`;
  });
  return make("figure", {}, target, make("figcaption", {}, said));
}

/** @param {any} level @returns {[string, string][]} */
function levelRows(level) {
  const parts = [["Y", level.planes[0]], ["Co", level.planes[1]], ["Cg", level.planes[2]], ["motion tiles", level.motion_tiles],
    ["key images Y", level.key_planes[0]], ["key images Co", level.key_planes[1]], ["key images Cg", level.key_planes[2]]];
  return parts.filter(([, bytes]) => bytes > 0).map(([name, bytes]) => [`level ${level.level}: ${name}`, `${grouped(bytes)} bytes`]);
}

/** @param {Record<string, number>} counts @returns {[string, number][]} */
const byNumber = (counts) => Object.entries(counts).sort(([a], [b]) => Number(a) - Number(b));

export async function showTotals() {
  const body = any("totals-body");
  body.textContent = "…";
  try {
    const { sections, states, images } = await askJson("totals");
    body.replaceChildren(
      list(Object.entries(sections).map(([name, bytes]) => [name, `${grouped(bytes)} bytes`])),
      list(images.levels.flatMap(levelRows)),
      ...images.levels.filter((/** @type {any} */ level) => level.images).map(rateMap),
      histogram("Blocks by state", Object.entries(states).map(([name, count]) => [name.replaceAll("_", " and "), count])),
      histogram("Blocks by levels of their values", byNumber(images.level_counts)),
      histogram("Blocks by step", byNumber(images.steps)));
  } catch (error) {
    body.textContent = /** @type {Error} */ (error).message;
  }
}
