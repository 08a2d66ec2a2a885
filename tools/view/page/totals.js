// What the stream's bytes and blocks are.
import { askJson } from "./ask.js";
import { any, grouped, make } from "./dom.js";

export async function showTotals() {
  const body = any("totals-body");
  body.textContent = "…";
  try {
    const totals = await askJson("totals");
    const rows = [...Object.entries(totals.sections).map(([name, bytes]) => [name, `${grouped(bytes)} bytes`]),
      ...Object.entries(totals.states).map(([name, count]) => [`blocks: ${name.replaceAll("_", " and ")}`, grouped(count)])];
    const list = make("dl", { class: "numbers" });
    for (const [name, text] of rows) list.append(make("dt", {}, name), make("dd", {}, text));
    body.replaceChildren(list);
  } catch (error) {
    body.textContent = /** @type {Error} */ (error).message;
  }
}
