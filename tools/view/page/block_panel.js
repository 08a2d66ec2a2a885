// The pinned block: every field and every stage, as `hmlfc inspect` has them.
import { any, make } from "./dom.js";
import { clauseButton } from "./clauses.js";

/** @typedef {(row: number, col: number) => void} Visit */

/**
 * The fields of a level that another block has not with this value, in the same kind of tile and as often before.
 * @param {any} page @param {any} other @returns {Set<any>}
 */
function differing(page, other) {
  const kinds = (/** @type {any} */ { walks }) => walks.map((/** @type {any} */ { title, rows }) => [title.replace(/\d+/g, ""), rows]);
  const there = new Map(kinds(other));
  return new Set(kinds(page).flatMap((/** @type {[string, any[]]} */ [kind, rows]) => rows.filter(({ name, value }, at) => {
    const before = rows.slice(0, at).filter((row) => row.name === name).length;
    return there.get(kind)?.filter((/** @type {any} */ row) => row.name === name)[before]?.value !== value;
  })));
}

/**
 * @param {any[]} rows @param {Set<any>} marked
 */
function fieldTable(rows, marked) {
  const names = ["section", "byte.bit", "bits", "field", "raw bits", "value", "clause"];
  const head = make("tr", {}, ...names.map((name) => make("th", { scope: "col" }, name)));
  const lines = rows.map((row) => {
    const texts = [row.section, row.address, row.bits, row.name, row.raw, row.value];
    return make("tr", marked.has(row) ? { class: "differs" } : {}, ...texts.map((text) => make("td", {}, text)), make("td", {}, clauseButton(row.clause)));
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
 * @param {any} level of levelsOf() @param {Visit} visit @param {boolean} open @param {any} other the level beside it, if there is one
 */
function levelSection(level, visit, open, other) {
  const { row, col } = level.image;
  const title = make("summary", {}, `Level ${level.level}, image row ${row}, column ${col}, ${level.title}`);
  const section = make("details", open ? { open: "" } : {}, title);
  const marked = other ? differing(level, other) : new Set();
  for (const walk of level.walks) section.append(make("h4", {}, walk.title), fieldTable(walk.rows, marked));
  if (level.formulas) section.append(make("pre", {}, level.formulas.replace(/\n$/, "")));
  const stages = Object.entries(level.stages).map(([name, { clause, values }]) =>
    matrix(`${name} ${clause}`, values, other?.stages[name]?.values));
  section.append(make("div", { class: "matrices" }, ...codedValues(level), ...stages));
  if (level.level !== 0) return section;
  const images = new Set(level.vectors.map((/** @type {any} */ v) => `${v.image.row},${v.image.col}`));
  const links = [...images].map((image) => {
    const link = make("button", { type: "button" }, `The same block of reference image ${image}`);
    const [imageRow, imageCol] = String(image).split(",").map(Number);
    link.addEventListener("click", () => visit(imageRow, imageCol));
    return link;
  });
  section.append(make("div", { class: "buttons" }, ...links));
  return section;
}

/**
 * Each level of the report with its texts.
 * @param {any} answer @returns {any[]}
 */
const levelsOf = ({ report, levels }) => report.levels.map((/** @type {any} */ level, /** @type {number} */ at) => ({ ...level, ...levels[at] }));

/**
 * @param {string} name of the stream, if there are two @param {any} answer @param {Visit} visit @param {any} other the block beside it, or null
 */
function blockSection(name, answer, visit, other) {
  const { view, plane, block, levels: { length }, cost } = answer.report;
  const section = make("section", {},
    make("h2", {}, `${name}Block x ${block[0]}, y ${block[1]} of plane ${plane} of view row ${view.row}, column ${view.col}`));
  if (name && !other) section.append(make("p", { class: "help" }, "Of another size than the block beside it, so that nothing is compared"));
  if (answer.error) section.append(make("p", { class: "error" }, answer.error));
  section.append(...levelsOf(answer).map((level, at) =>
    levelSection(level, visit, at === length - 1, other && levelsOf(other).find((one) => one.level === level.level))));
  section.append(make("p", { class: "help" },
    `Cost: ${cost.walks} walks, ${cost.fields} fields of ${cost.bits} bits = ${cost.bytes} bytes, ${cost.steps} serial steps`));
  return section;
}

/**
 * @param {any} answer of the server, or null for no block
 * @param {Visit} visit called for a reference image of level 0
 * @param {any} other the block of the stream beside it, or null @param {string[]} names of both streams
 * @param {boolean} same both blocks have the same pixels, and what differs is marked
 */
export function showBlock(answer, visit, other, names, same) {
  const [right, left] = same ? [other, answer] : [null, null];
  const pair = other ? [[`${names[0]}: `, answer, right], [`${names[1]}: `, other, left]] : answer ? [["", answer, null]] : [];
  any("block").replaceChildren(...pair.map(([name, one, beside]) => blockSection(name, one, visit, beside)));
}
