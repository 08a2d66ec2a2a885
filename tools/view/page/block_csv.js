// The blocks of a plane as comma-separated values, a row for each block.
import { STATES } from "./overlays.js";

/**
 * What the server says of the plane's blocks; values that a block has not are empty.
 * @param {any} blocks
 */
function blockCsv(blocks) {
  const numbers = ["bits", "read", "level_counts", "steps", "disparities", "psnr", "worst"].filter((name) => blocks[name]);
  const errors = new Map(blocks.errors);
  const vectors = new Map();
  for (const [at, row, col, x, y] of blocks.vectors) vectors.set(at, [...(vectors.get(at) ?? []), `${row} ${col} ${x} ${y}`]);
  const quoted = (/** @type {unknown} */ value) => /[",\n]/.test(String(value ?? "")) ? `"${String(value).replaceAll('"', '""')}"` : String(value ?? "");
  const rows = blocks.states.map((/** @type {number} */ state, /** @type {number} */ at) => [
    at % blocks.columns, Math.floor(at / blocks.columns), STATES[state], ...numbers.map((name) => blocks[name][at]),
    (vectors.get(at) ?? []).join("; "), errors.get(at)]);
  return [["x", "y", "state", ...numbers, "vectors", "error"], ...rows].map((row) => `${row.map(quoted).join(",")}\r\n`).join("");
}

/**
 * Gives the link that is being followed the plane's blocks.
 * @param {HTMLAnchorElement} link @param {any} blocks
 */
export function offerCsv(link, blocks) {
  URL.revokeObjectURL(link.href);
  link.href = URL.createObjectURL(new Blob([blockCsv(blocks)], { type: "text/csv" }));
}
