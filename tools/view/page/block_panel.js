// The pinned block: every field and every stage, as `hmlfc inspect` has them.
import { any, make } from "./dom.js";
import { clauseButton } from "./clauses.js";

/** @typedef {(row: number, col: number) => void} Visit */

/**
 * @param {any[]} rows
 */
function fieldTable(rows) {
  const names = ["section", "byte.bit", "bits", "field", "raw bits", "value", "clause"];
  const head = make("tr", {}, ...names.map((name) => make("th", { scope: "col" }, name)));
  const lines = rows.map((row) => {
    const texts = [row.section, row.address, row.bits, row.name, row.raw, row.value];
    return make("tr", {}, ...texts.map((text) => make("td", {}, text)), make("td", {}, clauseButton(row.clause)));
  });
  const table = make("table", { class: "fields" }, make("thead", {}, head), make("tbody", {}, ...lines));
  return make("div", { class: "scroll" }, table);
}

/**
 * @param {string} title @param {any[][]} rows
 * @param {any[][]} right what they should be; others are marked
 */
function matrix(title, rows, right = rows) {
  const lines = rows.map((row, y) => make("tr", {}, ...row.map((value, x) =>
    make("td", String(value) === String(right[y]?.[x]) ? {} : { class: "wrong" }, String(value)))));
  return make("table", { class: "matrix" }, make("caption", {}, title), make("tbody", {}, ...lines));
}

/**
 * Puts what a decoder under test makes of the pinned block beside it: its stages below those of their level, or its
 * pixels; wrong values are marked.
 * @param {any} other what the server says of it @param {any} answer the pinned block
 */
export function addOther(other, answer) {
  const panel = any("block");
  const place = make("section", { id: "other", "aria-label": `The block by ${other.name}` }, make("h3", {}, `By ${other.name}`));
  panel.querySelector("h2")?.after(place);
  if (other.error) place.append(make("p", { class: "error" }, other.error));
  const matrices = make("div", { class: "matrices" });
  let wrong = 0;
  for (const { level, image, stage, values } of other.stages) {
    const golden = answer.report.levels.find((/** @type {any} */ one) =>
      one.level === level && one.image.row === image.row && one.image.col === image.col)?.stages[stage];
    if (golden && String(golden.values) === String(values)) continue;
    wrong += 1;
    if (golden) matrices.append(matrix(`level ${level}: ${stage}, right`, golden.values));
    matrices.append(matrix(`level ${level}: ${stage}, ${other.name}`, values, golden?.values ?? []));
  }
  if (other.stages.length > 0) {
    place.append(make("p", {}, wrong === 0 ? `All ${other.stages.length} stages that it reports are right` : `${wrong} of ${other.stages.length} stages differ`));
  }
  if (other.pixels) matrices.append(matrix("R,G,B of the golden model", other.golden), matrix(`R,G,B, ${other.name}`, other.pixels, other.golden));
  place.append(matrices);
}

/**
 * The values as they stand in the stream, before TIL-10.
 * @param {any} level
 */
function codedValues(level) {
  const values = level.fields.filter((/** @type {any} */ field) => field.name === "value");
  const side = Math.sqrt(values.length);
  if (values.length === 0 || !Number.isInteger(side)) return [];
  const rows = Array.from({ length: side }, (_, y) =>
    values.slice(y * side, (y + 1) * side).map((/** @type {any} */ field) => field.value));
  return [matrix("value TIL-9", rows)];
}

/**
 * @param {any} level of the report @param {any} page its texts @param {Visit} visit @param {boolean} open
 */
function levelSection(level, page, visit, open) {
  const { row, col } = level.image;
  const title = make("summary", {}, `Level ${level.level}, image row ${row}, column ${col}, ${page.title}`);
  const section = make("details", open ? { open: "" } : {}, title);
  for (const walk of page.walks) section.append(make("h4", {}, walk.title), fieldTable(walk.rows));
  if (page.formulas) section.append(make("pre", {}, page.formulas.replace(/\n$/, "")));
  const stages = Object.entries(level.stages).map(([name, stage]) =>
    matrix(`${name} ${/** @type {any} */ (stage).clause}`, /** @type {any} */ (stage).values));
  section.append(make("div", { class: "matrices" }, ...codedValues(level), ...stages));
  if (level.level !== 0) return section;
  const images = new Set(level.vectors.map((/** @type {any} */ v) => `${v.image.row},${v.image.col}`));
  const links = [...images].map((image) => {
    const link = make("button", { type: "button" }, `The same block of reference image ${image}`);
    const [imageRow, imageCol] = String(image).split(",").map(Number);
    link.addEventListener("click", () => visit(imageRow, imageCol));
    return link;
  });
  section.append(make("div", { class: "links" }, ...links));
  return section;
}

/**
 * @param {any} answer of the server, or null for no block
 * @param {Visit} visit called for a reference image of level 0
 */
export function showBlock(answer, visit) {
  const panel = any("block");
  panel.replaceChildren();
  if (answer === null) return;
  const { view, plane, block, levels, cost } = answer.report;
  panel.append(make("h2", {}, `Block x ${block[0]}, y ${block[1]} of plane ${plane} of view row ${view.row}, column ${view.col}`));
  if (answer.error) panel.append(make("p", { class: "error" }, answer.error));
  levels.forEach((/** @type {any} */ level, /** @type {number} */ at) =>
    panel.append(levelSection(level, answer.levels[at], visit, at === levels.length - 1)));
  panel.append(make("p", { class: "help" },
    `Cost: ${cost.walks} walks, ${cost.fields} fields of ${cost.bits} bits = ${cost.bytes} bytes, ${cost.steps} serial steps`));
}
