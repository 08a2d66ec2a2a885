// Colours of blocks, and what they mean.
import { any, make } from "./dom.js";

/**
 * @typedef {object} Overlay
 * @property {(string | null)[]} colours of each block; null: none
 * @property {[string, string][]} [words] colour and meaning
 * @property {[number, number, string]} [ramp] least, greatest, unit
 */

export const STATES = ["zero", "motion only", "motion and residual", "residual only", "key image", "error"];
const STATE_COLOURS = ["#5b6473", "#3f8fd6", "#9a6fd0", "#e09a3e", "#d8c23f", "#ff3b30"];
const IMAGE_COLOURS = ["#3f8fd6", "#e09a3e", "#49a86b", "#c95d8d", "#9a6fd0", "#d8c23f", "#45b5b0", "#b0663c"];
// From dark violet over red to light yellow: brighter is more.
const HEAT = [[30, 12, 70], [120, 28, 109], [196, 62, 75], [242, 130, 32], [250, 235, 140]];

/**
 * A colour for `part` in [0, 1].
 * @param {number} part
 */
export function heat(part) {
  const place = Math.max(0, Math.min(1, part)) * (HEAT.length - 1);
  const first = Math.min(HEAT.length - 2, Math.floor(place));
  const mixed = HEAT[first].map((low, k) => Math.round(low + (HEAT[first + 1][k] - low) * (place - first)));
  return `rgb(${mixed.join(", ")})`;
}

/**
 * @param {(number | null)[]} values
 * @param {string} unit
 * @param {Overlay} first whose ramp it takes, if there is one
 * @param {(value: number) => boolean} shown
 * @returns {Overlay}
 */
function heatMap(values, unit, first, shown = () => true) {
  const counted = values.flatMap((value) => (value !== null && shown(value) ? [value] : []));
  const [least, greatest] = first.ramp ?? [Math.min, Math.max].map((end) => counted.reduce((a, b) => end(a, b), counted[0]));
  const part = (/** @type {number} */ value) => (greatest > least ? (value - least) / (greatest - least) : 1);
  const colours = values.map((value) => (value === null || !shown(value) ? null : heat(part(value))));
  return greatest === undefined ? { colours, words: [] } : { colours, ramp: [least, greatest, unit] };
}

/**
 * @param {any} blocks @param {Overlay} first whose images keep their colours @returns {Overlay}
 */
function referenceImages(blocks, first) {
  const colourOf = new Map((first.words ?? []).map(([colour, image]) => [image, colour]));
  const colours = new Array(blocks.states.length).fill(null);
  for (const [block, row, col] of blocks.vectors) {
    const image = `image ${row},${col}`;
    if (!colourOf.has(image)) colourOf.set(image, IMAGE_COLOURS[colourOf.size % IMAGE_COLOURS.length]);
    colours[block] ??= colourOf.get(image) ?? null;
  }
  return { colours, words: [...colourOf].map(([image, colour]) => [colour, image]) };
}

/**
 * Tiles of 8 x 8 blocks, 64 consecutive ones a group (IDX-3).
 * @param {any} blocks @returns {Overlay}
 */
function tileGroups(blocks) {
  const across = Math.ceil(blocks.columns / 8);
  const groups = blocks.states.map((/** @type {number} */ _, /** @type {number} */ at) => {
    const [x, y] = [at % blocks.columns, Math.floor(at / blocks.columns)];
    return Math.floor((blocks.first_tile + Math.floor(y / 8) * across + Math.floor(x / 8)) / 64);
  });
  const colourOf = (/** @type {number} */ group) => IMAGE_COLOURS[group % IMAGE_COLOURS.length];
  const words = [...new Set(groups)].map((group) => /** @type {[string, string]} */ ([colourOf(group), `group ${group}`]));
  return { colours: groups.map(colourOf), words };
}

/**
 * The overlay of this name.
 * @param {string} name @param {any} blocks what the server says of the plane
 * @param {Overlay} first of the stream beside this one, whose colours mean the same @returns {Overlay}
 */
export function overlayOf(name, blocks, first = { colours: [] }) {
  const positive = (/** @type {number} */ value) => value > 0;
  const notKey = (/** @type {number[]} */ values) =>
    values.map((value, at) => (blocks.states[at] >= 4 ? null : value));
  switch (name) {
    case "state": {
      const colours = blocks.states.map((/** @type {number} */ state) => STATE_COLOURS[state]);
      const found = [...new Set(blocks.states)].sort();
      return { colours, words: found.map((state) => [STATE_COLOURS[state], STATES[state]]) };
    }
    case "bits": return heatMap(notKey(blocks.bits), "bits", first);
    case "read": return heatMap(notKey(blocks.read), "bits", first);
    case "level_counts": return heatMap(blocks.level_counts, "levels", first, positive);
    case "steps": return heatMap(blocks.steps, "", first, positive);
    case "disparities": return heatMap(blocks.disparities ?? [], "pixels a column", first);
    case "psnr": return heatMap(blocks.psnr ?? [], "dB", first);
    case "references": return referenceImages(blocks, first);
    case "groups": return tileGroups(blocks);
    case "dut": return heatMap(blocks.worst ?? [], "the largest difference", first, positive);
    default: return { colours: [] };
  }
}

/**
 * @param {Overlay} overlay @param {Overlay} second the one beside it, or the same
 */
export function showLegend(overlay, second) {
  const legend = any("legend");
  legend.replaceChildren();
  for (const [word, colour] of new Map([overlay, second].flatMap(({ words }) => words ?? []).map(([colour, word]) => [word, colour]))) {
    const swatch = make("span", { class: "swatch" });
    swatch.style.background = colour;
    legend.append(swatch, make("span", {}, word));
  }
  if (!overlay.ramp) return;
  const [least, greatest, unit] = overlay.ramp;
  const ramp = make("span", { class: "ramp" });
  ramp.style.background = `linear-gradient(to right, ${[0, 0.25, 0.5, 0.75, 1].map(heat).join(", ")})`;
  legend.append(ramp, make("span", { class: "ends" }, make("span", {}, `${least}`), make("span", {}, `${greatest} ${unit}`)));
}
