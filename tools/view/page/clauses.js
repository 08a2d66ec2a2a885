// Clauses of the specification and of docs/rendering.md, which the program has in it.
import { askText } from "./ask.js";
import { any, element, make } from "./dom.js";

/** @type {Promise<string> | null} */
let documents = null;

/**
 * The paragraphs of a clause, from its name to the next clause or heading; empty where there is none.
 * @param {string} text @param {string} clause
 */
export function clauseText(text, clause) {
  const begin = text.indexOf(`**[${clause}]**`);
  if (begin < 0) return "";
  const rest = text.slice(begin);
  const end = rest.slice(2).search(/\n(\*\*\[|#)/);
  return (end < 0 ? rest : rest.slice(0, end + 2)).trim();
}

/**
 * Elements for a line of Markdown: code, strong, emphasis, and the words of links.
 * @param {string} line @returns {(Node | string)[]}
 */
function inline(line) {
  const kinds = { "`": "code", "**": "strong", "*": "em" };
  const parts = line.replace(/\[([^\]]+)\]\([^)]*\)/g, "$1").split(/(`[^`]+`|\*\*[^*]+\*\*|\*\w[^*]*\*)/);
  return parts.map((part, at) => {
    if (at % 2 === 0) return part;
    const mark = /** @type {"`" | "**" | "*"} */ (/^(`|\*\*|\*)/.exec(part)?.[0]);
    return make(kinds[mark], {}, part.slice(mark.length, -mark.length));
  });
}

/** @param {string[]} lines of a table */
function table(lines) {
  const cells = lines.map((line) => line.slice(1, line.trimEnd().lastIndexOf("|")).split("|").map((cell) => inline(cell.trim())));
  const rows = cells.filter((_, at) => at !== 1).map((row, at) =>
    make("tr", {}, ...row.map((cell) => make(at === 0 ? "th" : "td", {}, ...cell))));
  return make("div", { class: "scroll" }, make("table", { class: "fields" }, make("tbody", {}, ...rows)));
}

/**
 * A clause as elements: what the two documents have of Markdown.
 * @param {string} text
 */
export function rendered(text) {
  const blocks = text.split(/(^```[^]*?^```$)|\n\s*\n/m).filter((block) => block?.trim());
  return blocks.map((block) => {
    const lines = block.replace(/^\n+/, "").split("\n");
    if (lines[0].startsWith("```")) return make("pre", {}, lines.slice(1, -1).join("\n"));
    if (lines[0].startsWith("    ")) return make("pre", {}, lines.map((line) => line.slice(4)).join("\n"));
    if (lines[0].startsWith("|")) return table(lines);
    if (/^(-|\d+\.) /.test(lines[0])) {
      const items = lines.join("\n").split(/^(?:-|\d+\.) /m).slice(1);
      return make(lines[0].startsWith("-") ? "ul" : "ol", {}, ...items.map((item) => make("li", {}, ...inline(item))));
    }
    return make("p", {}, ...inline(lines.join("\n")));
  });
}

/**
 * Shows the clause, and says whether there is one.
 * @param {string} clause
 */
export async function showClause(clause) {
  documents ??= Promise.all(["specification.md", "rendering.md"].map(askText)).then((texts) => texts.join("\n"));
  const text = clauseText(await documents, clause);
  if (text === "") return false;
  any("clause-text").replaceChildren(...rendered(text));
  element("clause", HTMLDialogElement).showModal();
  return true;
}

/** @param {string} clause */
export function clauseButton(clause) {
  const button = make("button", { type: "button", title: `Show ${clause}` }, clause);
  button.addEventListener("click", () => void showClause(clause));
  return button;
}
