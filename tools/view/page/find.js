// Finds what is typed: a clause, an error, or an address among the fields of the pinned block.
import { showClause } from "./clauses.js";
import { any, input, say } from "./dom.js";

/**
 * The bits [first, end) of a row of fields, from "0x12.3" and "4 x 8".
 * @param {Element} row
 */
function bitsOf(row) {
  const [, address, bits] = [...row.querySelectorAll("td")].map((cell) => cell.textContent ?? "");
  const [byte, bit] = (address ?? "").split(".").map(Number);
  const count = (bits ?? "").split("x").map(Number).reduce((product, factor) => product * factor, 1);
  return [8 * byte + bit, 8 * byte + bit + count];
}

/**
 * Shows the row of the pinned block's fields that `fits`, and says whether there is one.
 * @param {(row: Element) => boolean} fits
 */
function showField(fits) {
  const rows = [...any("block").querySelectorAll(".fields tbody tr")];
  for (const row of rows) row.classList.remove("found");
  const row = rows.find(fits);
  row?.classList.add("found");
  row?.closest("details")?.setAttribute("open", "");
  row?.scrollIntoView({ block: "center" });
  return row !== undefined;
}

/** @param {(words: string) => boolean} showError goes to the next block whose error has these words */
export function prepareFind(showError) {
  const find = async () => {
    const words = input("find").value.trim();
    if (words === "") return "";
    if (/^[a-z]{3}-\d+$/i.test(words)) return (await showClause(words.toUpperCase())) ? "" : `There is no clause ${words.toUpperCase()}`;
    if (/^0x[0-9a-f]+(\.[0-7])?$/i.test(words)) {
      const [byte, bit] = words.split(".").map(Number);
      const [first, end] = bit === undefined ? [8 * byte, 8 * byte + 8] : [8 * byte + bit, 8 * byte + bit + 1];
      const reads = (/** @type {Element} */ row) => bitsOf(row)[0] < end && bitsOf(row)[1] > first;
      return showField(reads) ? "" : "The pinned block reads nothing there";
    }
    if (showError(words) || showField((row) => [...row.children].some((cell) => cell.textContent === words))) return "";
    return "No error and no field of the pinned block has this";
  };
  input("find").addEventListener("keydown", (event) => {
    if (event.key === "Enter") void find().then((text) => say("find-error", text)).catch((error) => say("find-error", error.message));
  });
}
